// A ParaView script that opens the frames of a run with sensible settings.
#pragma once

#include <string>

#include "models/model.hpp"

namespace nsframe {

// What the script shows first.
struct ParaviewView {
  double scale = 1;                 // of the displacements drawn; must make them visible against the size of the model
  double largest_displacement = 0;  // [m], the end of the colour scale; 0: not known yet
  double time = 0;                  // [s] of the frame shown first
};

std::string paraview_script(const Model& model, const ParaviewView& view);

// Scale that draws `largest_displacement` [m] as about 4 % of the model's diagonal, rounded to 1, 2 or 5 times a power
// of ten; at least 1.
double visible_scale(const Model& model, double largest_displacement);

}  // namespace nsframe
