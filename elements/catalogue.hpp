// Rolled I shapes by name (EN 10365: HEA, HEB, IPE): dimensions, tabulated section properties, fibers and outline.
// Local axes: depth along y, so the strong axis is z.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "elements/sections.hpp"

namespace nsframe {

struct CatalogueShape {
  std::string_view name;       // "HEA100"
  double h, b, tw, tf, r;      // depth, width, web, flange, root radius [m]
  double A;                    // tabulated area [m2]
  double I_strong, I_weak;     // tabulated second moments [m4]
  double J;                    // tabulated torsion constant [m4]
};

// The shape of that name ("HEA 100", "hea100" or "HE 100 A": case and blanks ignored), or nullptr.
const CatalogueShape* find_shape(std::string_view name);
std::vector<std::string> shape_names();

// Number of fibers: each flange across its width and its thickness, web along its depth; root fillets as one fiber each.
struct ShapeMesh {
  int flange_width = 10;
  int flange_layers = 2;
  int web = 8;
  bool fillets = true;
};

std::vector<FiberDescription> shape_fibers(const CatalogueShape& shape, const ShapeMesh& mesh, const Reference& material);
SectionOutline shape_outline(const CatalogueShape& shape);

}  // namespace nsframe
