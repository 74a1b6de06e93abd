#include "scene/quantity.hpp"

#include <doctest/doctest.h>

#include "base/types.hpp"

using namespace nsframe;

TEST_CASE("a quantity with a unit has the bits of the number in SI") {
  CHECK(parse_quantity("2.5 cm", dimension::length) == 0.025);
  CHECK(parse_quantity("5.5 cm", dimension::length) == 0.055);
  CHECK(parse_quantity("2.3cm", dimension::length) == 0.023);
  CHECK(parse_quantity("1 ms", dimension::time) == 1e-3);
  CHECK(parse_quantity("235 MPa", dimension::stress) == 235e6);
  CHECK(parse_quantity("210 GPa", dimension::stress) == 210e9);
  CHECK(parse_quantity("9200 kg", dimension::mass) == 9200);
  CHECK(parse_quantity("3 t", dimension::mass) == 3000);
  CHECK(parse_quantity("100 Hz", dimension::frequency) == 100);
  CHECK(parse_quantity("5 kN", dimension::force) == 5000);
  CHECK(parse_quantity("0.5 %", dimension::none) == 0.005);
  CHECK(parse_quantity("-1.5e-3", dimension::none) == -1.5e-3);
}

TEST_CASE("g is the standard acceleration of gravity") {
  CHECK(parse_quantity("0.25 g", dimension::acceleration) == 0.25 * 9.80665);
}

TEST_CASE("units multiply, divide and have powers") {
  const auto close = [](double value) { return doctest::Approx(value).epsilon(1e-15); };  // one or two roundings
  CHECK(parse_quantity("3 N/m", dimension::stiffness) == 3);
  CHECK(parse_quantity("3 kN/mm", dimension::stiffness) == 3e6);
  CHECK(parse_quantity("2.2e7 N m/rad", dimension::rotational_stiffness) == 2.2e7);
  CHECK(parse_quantity("2 kN*m/rad", dimension::rotational_stiffness) == 2000);
  CHECK(parse_quantity("588.573 kg m2", dimension::inertia) == 588.573);
  CHECK(parse_quantity("21.2 cm2", dimension::area) == close(21.2e-4));
  CHECK(parse_quantity("349.2 cm4", dimension::fourth_power_of_length) == close(349.2e-8));
  CHECK(parse_quantity("9.81 m/s2", dimension::acceleration) == 9.81);
  CHECK(parse_quantity("9.81 m/s^2", dimension::acceleration) == 9.81);
  CHECK(parse_quantity("9.81 m/s/s", dimension::acceleration) == 9.81);
  CHECK(parse_quantity("9.81 m s^-2", dimension::acceleration) == 9.81);
  CHECK(parse_quantity("4 N s/m", dimension::dashpot) == 4);
  CHECK(parse_quantity("30 deg", dimension::angle) == close(pi / 6));
}

TEST_CASE("radians may be left out, but not put in") {
  CHECK(parse_quantity("7 N m", dimension::rotational_stiffness) == 7);
  CHECK_THROWS_WITH_AS(parse_quantity("7 rad", dimension::none), " is an angle, must be a plain number", QuantityError);
}

TEST_CASE("a quantity of another dimension is an error that names both") {
  CHECK_THROWS_WITH_AS(parse_quantity("5 cm", dimension::time), " is a length, must be a time (s)", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("5 kg m/s", dimension::time), " is in m kg s-1, must be a time (s)",
                       QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("5", dimension::time), " has no unit; write a time in s, or a bare number",
                       QuantityError);
}

TEST_CASE("an unknown unit is an error with the nearest one") {
  CHECK_THROWS_WITH_AS(parse_quantity("5 sec", dimension::time), ": unknown unit 'sec'; did you mean 's'?",
                       QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("5 Mpa", dimension::stress), ": unknown unit 'Mpa'; did you mean 'MPa'?",
                       QuantityError);
}

TEST_CASE("text that is no quantity is an error") {
  CHECK_THROWS_WITH_AS(parse_quantity("cm"), ": not a number with a unit", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity(""), ": not a number with a unit", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("2,5 cm"), ": not a number with a unit (write decimals with a point)",
                       QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("nan cm"), ", must be a finite number", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("inf"), ", must be a finite number", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("1e400 m"), ": the number is too large or too small", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("1 m/"), ": the unit ends with '/'", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("1 m//s"), ": two '/' in a row", QuantityError);
  CHECK_THROWS_WITH_AS(parse_quantity("1 m2-"), ": 'm2-' is not a power of a unit", QuantityError);
}
