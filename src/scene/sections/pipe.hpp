// [section.NAME] with `pipe`: a circular hollow section or a round bar.
#pragma once

#include "scene/sections/section_kind.hpp"

namespace nsframe {

struct PipeTable {
  double diameter = 0, thickness = 0;  // [m]
};

struct PipeSection {
  PipeTable pipe;
  Reference material;
  int sectors = 24, rings = 2;
  TorsionKeys torsion;

  static constexpr std::array<std::string_view, 1> chosen_by{"pipe"};
  static constexpr std::string_view title = "a pipe",
                                    note = "A thickness of half the diameter makes a solid bar. Area and second moments "
                                           "of the fibers are exact.";
};

template <class Archive>
void visit(Archive& ar, PipeTable& p) {
  ar(required("diameter", "outer", dimension::length, range::positive), p.diameter);
  ar(required("thickness", "of the wall", dimension::length, range::positive), p.thickness);
}
inline constexpr std::string_view pipe_row[]{"diameter", "thickness"};
constexpr RowKeys row_keys(const PipeTable*) { return pipe_row; }
constexpr std::string_view title_of(const PipeTable*) { return "a pipe"; }

template <class Archive>
void visit(Archive& ar, PipeSection& s) {
  ar(required("pipe", "dimensions"), s.pipe);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"sectors", "fibers around", {}, Range{3, 1000}}, s.sectors);
  ar(Field{"rings", "fibers through the thickness", {}, fiber_count}, s.rings);
  visit_torsion(ar, s.torsion, "twice the second moment");
}

inline SectionFaults faults(const PipeSection& section) {
  if (2 * section.pipe.thickness <= section.pipe.diameter) return {};
  return {{"pipe", "the wall of the pipe is thicker than half its diameter"}};
}

inline void describe(const PipeSection& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  const double outer = section.pipe.diameter / 2, inner = outer - section.pipe.thickness;
  if (section.pipe.thickness > 0 && faults(section).empty()) {
    add_ring(fibers.fibers, {Vector2::Zero(), inner, outer}, section.rings, section.sectors, section.material);
    AreaMoments exact{pi * (outer * outer - inner * inner), Vector2::Zero(), {}};
    const double second = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
    exact.second << second, 0, 0, second;
    match_moments(fibers.fibers, exact);
    fibers.torsion_stiffness = section.torsion.stiffness(modulus(section.material), 2 * second);
    out.outline = circle_outline(Vector2::Zero(), outer);
  }
  add_laws(section.torsion.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
