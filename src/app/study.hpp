// nsframe study: what its command line says.
#pragma once

#include "app/commands.hpp"

namespace nsframe::app {

struct StudyArguments {
  SceneArguments scene;
  std::vector<std::string> vary;  // "dt=1e-3,5e-4,scheme=moreau-jean,exact"
  int repeat = 1;                 // runs of each combination; the least time counts
};

int study(const StudyArguments& arguments);

}  // namespace nsframe::app
