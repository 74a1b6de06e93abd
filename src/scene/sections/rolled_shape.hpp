// [section.NAME] with `shape`: a shape of the catalogue, by its name.
#pragma once

#include <fmt/format.h>

#include "elements/aisc_names.hpp"
#include "elements/channel.hpp"
#include "scene/sections/angle.hpp"
#include "scene/sections/pipe.hpp"
#include "scene/sections/section_kind.hpp"
#include "scene/sections/tube.hpp"

namespace nsframe {

struct ShapeSection {
  Reference shape;  // of the catalogue
  Reference material;
  ShapeMesh mesh;
  bool principal_axes = false;
  TorsionKeys torsion;

  static constexpr std::array<std::string_view, 1> chosen_by{"shape"};
  static constexpr std::string_view title = "a rolled shape",
                                    note = "Depth along local y. I shapes and channels are tables; HSS, of the design wall "
                                           "thickness 0.93 t, and L are computed from the dimensions in the name. Channels and "
                                           "angles have axes through the centroid, and members take the shear centre as "
                                           "lying there.";
};

template <class Archive>
void visit(Archive& ar, ShapeSection& s) {
  ar(required("shape", "HEA, HEB, HEM, IPE, W or C and its numbers, or HSS or L and its inches: `HEA100`, `W14X90`, `C10X20`, "
                       "`HSS6X6X1/4`, `HSS5X0.25` (round), `L4X3-1/2X1/2`"),
     s.shape);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"flange_width", "fibers across a flange's width, along each wall across the depth or each leg; a quarter of those "
                           "around a pipe", {}, fiber_count}, s.mesh.flange_width);
  ar(Field{"flange_layers", "fibers through a flange's, wall's or leg's thickness", {}, fiber_count}, s.mesh.flange_layers);
  ar(Field{"web", "fibers along the web, or along each wall along the depth", {}, fiber_count}, s.mesh.web);
  ar(Field{"fillets", "root fillets of I shapes, one fiber each"}, s.mesh.fillets);
  ar(Field{"exact_moments", "I shapes: fibers placed so that area and both second moments are those of the drawn shape (of the "
                            "others they always are exact)"},
     s.mesh.exact_moments);
  ar(Field{"principal_axes", "L: turned until y and z are the principal axes, z the strong one (elastic members need it)"},
     s.principal_axes);
  visit_torsion(ar, s.torsion, "of the catalogue, or as for a tube, pipe or angle");
}

// The hollow section or angle that a name stands for.
inline std::optional<TubeSection> named_tube(const ShapeSection& s) {
  const auto hollow = hollow_dimensions(catalogue_name(s.shape.name));
  if (!hollow || hollow->round) return {};
  return TubeSection{{hollow->depth, hollow->width, hollow->thickness, {}}, TubeForming::hss, s.material, s.mesh.web,
                     s.mesh.flange_width, s.mesh.flange_layers, 2, s.torsion};
}
inline std::optional<PipeSection> named_pipe(const ShapeSection& s) {
  const auto hollow = hollow_dimensions(catalogue_name(s.shape.name));
  if (!hollow || !hollow->round) return {};
  return PipeSection{{hollow->depth, hollow->thickness}, s.material, 4 * s.mesh.flange_width, s.mesh.flange_layers, s.torsion};
}
// With sharp corners: root and toes, which the names don't say, balance to within a percent of the area.
inline std::optional<AngleSection> named_angle(const ShapeSection& s) {
  const auto angle = angle_dimensions(catalogue_name(s.shape.name));
  if (!angle) return {};
  return AngleSection{{angle->depth, angle->width, angle->thickness, 0, {}}, s.principal_axes, s.material, s.mesh.flange_width,
                      s.mesh.flange_layers, s.torsion};
}

inline SectionFaults faults(const ShapeSection& section) {
  SectionFaults out;
  const auto add = [&out](const SectionFaults& found) {
    for (const SectionFault& fault : found) out.push_back({"shape", fault.message});
  };
  const auto angle = named_angle(section);
  if (section.principal_axes && !angle) out.push_back({"principal_axes", "principal_axes belongs to angles (L)"});
  if (angle) {
    add(faults(*angle));
  } else if (const auto tube = named_tube(section)) {
    add(faults(*tube));
  } else if (const auto pipe = named_pipe(section)) {
    add(faults(*pipe));
  } else if (const std::string name = catalogue_name(section.shape.name); !find_shape(name) && !find_channel(name)) {
    std::vector<std::string> names = shape_names();
    for (const ChannelShape& channel : channels()) names.emplace_back(channel.name);
    out.push_back({"shape", fmt::format("shape '{}' is not in the catalogue{}", section.shape.name, did_you_mean(section.shape.name, names))});
  }
  return out;
}

inline void describe(const ShapeSection& section, const ElasticModulus& modulus, SectionDescription& out) {
  if (const auto angle = named_angle(section)) return describe(*angle, modulus, out);
  if (const auto tube = named_tube(section)) return describe(*tube, modulus, out);
  if (const auto pipe = named_pipe(section)) return describe(*pipe, modulus, out);
  FiberSectionDescription fibers;
  const std::string name = catalogue_name(section.shape.name);
  if (const CatalogueShape* shape = find_shape(name)) {
    fibers.fibers = shape_fibers(*shape, section.mesh, section.material);
    fibers.torsion_stiffness = section.torsion.stiffness(modulus(section.material), shape->J);
    out.outline = shape_outline(*shape);
  } else if (const ChannelShape* channel = find_channel(name)) {
    fibers.fibers = channel_fibers(*channel, section.mesh, section.material);
    fibers.torsion_stiffness = section.torsion.stiffness(modulus(section.material), channel->J);
    out.outline = channel_outline(*channel);
  }
  add_laws(section.torsion.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
