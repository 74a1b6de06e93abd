// Plain sentences about the numbers of a run that should worry its user. A new one is one function, one line in the
// list of rules in warnings.cpp and two tests: a run that calls for it and one that does not.
#pragma once

#include <string>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Of all rules, in their order; also those of numerical_warnings(), which need no model.
std::vector<std::string> run_warnings(const Model& model, const Summary& summary);

}  // namespace nsframe
