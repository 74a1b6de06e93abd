// [section.NAME] with `shape`: a rolled I shape of the catalogue.
#pragma once

#include <fmt/format.h>

#include "elements/catalogue.hpp"
#include "scene/sections/section_kind.hpp"

namespace nsframe {

struct ShapeSection {
  Reference shape;  // of the catalogue
  Reference material;
  ShapeMesh mesh;
  TorsionKeys torsion;

  static constexpr std::array<std::string_view, 1> chosen_by{"shape"};
  static constexpr std::string_view title = "a rolled shape", note = "Depth along local y.";
};

template <class Archive>
void visit(Archive& ar, ShapeSection& s) {
  ar(required("shape", "rolled I shape: HEA, HEB, HEM, IPE or W and its numbers, as `HEA100`, `W14X90`"), s.shape);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"flange_width", "fibers across a flange's width", {}, fiber_count}, s.mesh.flange_width);
  ar(Field{"flange_layers", "fibers through a flange's thickness", {}, fiber_count}, s.mesh.flange_layers);
  ar(Field{"web", "fibers along the web", {}, fiber_count}, s.mesh.web);
  ar(Field{"fillets", "root fillets, one fiber each"}, s.mesh.fillets);
  ar(Field{"exact_moments", "fibers placed so that area and both second moments are those of the drawn shape"},
     s.mesh.exact_moments);
  visit_torsion(ar, s.torsion, "of the catalogue");
}

inline SectionFaults faults(const ShapeSection& section) {
  if (find_shape(section.shape.name)) return {};
  return {{"shape", fmt::format("shape '{}' is not in the catalogue{}", section.shape.name,
                                did_you_mean(section.shape.name, shape_names()))}};
}

inline void describe(const ShapeSection& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  if (const CatalogueShape* shape = find_shape(section.shape.name)) {
    fibers.fibers = shape_fibers(*shape, section.mesh, section.material);
    fibers.torsion_stiffness = section.torsion.stiffness(modulus(section.material), shape->J);
    out.outline = shape_outline(*shape);
  }
  out.kind = std::move(fibers);
}

}  // namespace nsframe
