// Quantities with units: "2.5 cm", "0.25 g", "235 MPa", "2.2e7 N m/rad", "9.81 m/s2". Inside the program all is SI.
//
// A unit is a product of factors such as `kN`, `m2`, `s^-1`, separated by blanks or `*`; each `/` divides by the one
// factor behind it. "g" is the standard acceleration of gravity (9.80665 m/s2), never the gram.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace nsframe {

// Powers of metre, kilogram, second and radian.
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;
  bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension area{2, 0, 0, 0};
inline constexpr Dimension fourth_power_of_length{4, 0, 0, 0};
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension mass_per_length{-1, 1, 0, 0};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension inertia{2, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension frequency{0, 0, -1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension velocity{1, 0, -1, 0};
inline constexpr Dimension angular_velocity{0, 0, -1, 1};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension moment{2, 1, -2, 0};
inline constexpr Dimension stress{-1, 1, -2, 0};
inline constexpr Dimension stiffness{0, 1, -2, 0};
inline constexpr Dimension rotational_stiffness{2, 1, -2, -1};
inline constexpr Dimension dashpot{0, 1, -1, 0};
inline constexpr Dimension rotational_dashpot{2, 1, -1, -1};
inline constexpr Dimension bending_stiffness{3, 1, -2, 0};  // EI, GJ
}  // namespace dimension

struct Quantity {
  double value = 0;     // SI
  Dimension dimension;  // none for a bare number
};

// Not a quantity: what() says why, ready to stand right behind `key = "text"` (it begins with its own punctuation).
struct QuantityError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Quantity parse_quantity(std::string_view text);

// The SI value of `text` when it is a quantity of the wanted dimension; throws QuantityError otherwise. Radians may be
// left out ("N m" for "N m/rad").
double parse_quantity(std::string_view text, const Dimension& wanted);

std::string si_unit(const Dimension& dimension);         // "m/s2"; empty when dimensionless
std::string dimension_name(const Dimension& dimension);  // "an acceleration"

}  // namespace nsframe
