// Single fibers of an element, for the output.
#pragma once

#include <string_view>

namespace nsframe {

// Where a fiber is: constants.
struct FiberPlace {
  int point = 0;              // integration point of the element, from 0
  double position = 0;        // of that point along the element, in [0, 1]
  double y = 0, z = 0;        // [m]
  double area = 0;            // [m2]
  std::string_view material;  // its name in the scene
};

struct FiberState {
  double strain = 0;     // [-]
  double stress = 0;     // [Pa]
  bool yielded = false;  // its plastic strain |e - s/E| exceeds a tenth of the yield strain
};

}  // namespace nsframe
