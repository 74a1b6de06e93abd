// Rolled I shapes by name (EN 10365: HEA, HEB, HEM, IPE; AISC: W): dimensions, tabulated section properties, fibers
// and outline.
// Local axes: depth along y, so the strong axis is z.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "elements/fiber_cutting.hpp"

namespace nsframe {

struct CatalogueShape {
  std::string_view name;       // "HEA100"
  double h, b, tw, tf, r;      // depth, width, web, flange, root radius [m]
  double A;                    // tabulated area [m2]
  double I_strong, I_weak;     // tabulated second moments [m4]
  double J;                    // tabulated torsion constant [m4]
};

// The tables, one a file.
std::span<const CatalogueShape> european_shapes();
std::span<const CatalogueShape> w_shapes();

// The shape of that name ("HEA 100", "hea100" or "HE 100 A": case and blanks ignored), or nullptr.
const CatalogueShape* find_shape(std::string_view name);
std::vector<std::string> shape_names();
// "he 140 a" and "HEA 140" become "HEA140".
std::string catalogue_name(std::string_view text);

// Number of fibers: each flange across its width and its thickness, web along its depth; root fillets as one fiber each.
struct ShapeMesh {
  int flange_width = 10;
  int flange_layers = 2;
  int web = 8;
  bool fillets = true;
  // Fibers spread so that area and second moments are those of the drawn shape (its fillets only if there are any).
  bool exact_moments = false;
};

std::vector<FiberDescription> shape_fibers(const CatalogueShape& shape, const ShapeMesh& mesh, const Reference& material);
// Area and second moments of the drawn shape, exact.
AreaMoments shape_moments(const CatalogueShape& shape, bool fillets);
SectionOutline shape_outline(const CatalogueShape& shape);

}  // namespace nsframe
