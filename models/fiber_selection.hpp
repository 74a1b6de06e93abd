// Which fibers to keep, by names: "structure.element" for all its integration points, "structure.element:2" for the
// second only.
#pragma once

#include <string>
#include <vector>

#include "models/model.hpp"

namespace nsframe {

struct ChosenFibers {
  std::size_t group = 0;  // index into Model::groups
  int element = 0;
  int point = -1;         // from 0; -1: all
};

// The chosen elements in that order; all with fibers when `names` is empty. A sentence for each name that does not exist
// or has no fibers is added to `faults`.
std::vector<ChosenFibers> choose_fibers(const Model& model, const std::vector<std::string>& names,
                                        std::vector<std::string>& faults);

}  // namespace nsframe
