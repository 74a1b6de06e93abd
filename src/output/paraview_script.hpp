// A ParaView script that opens the frames of a run with sensible settings.
#pragma once

#include <string>

#include "models/model.hpp"

namespace nsframe {

// `scale` multiplies the displacements drawn; it must make them visible against the size of the model.
std::string paraview_script(const Model& model, const std::string& title, double scale);

// Scale that draws `largest_displacement` [m] as about 4 % of the model's diagonal, rounded to 1, 2 or 5 times a power
// of ten; at least 1.
double visible_scale(const Model& model, double largest_displacement);

}  // namespace nsframe
