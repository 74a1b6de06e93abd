#include "materials/uniaxial.hpp"
#include <doctest/doctest.h>
TEST_CASE("scaffold") { CHECK(nsframe::history_size(nsframe::Steel02{})==10); }
