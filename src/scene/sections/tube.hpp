// [section.NAME] with `tube`: a square or rectangular hollow section by its dimensions.
#pragma once

#include <utility>

#include "scene/sections/section_kind.hpp"

namespace nsframe {

// What the corner radii follow from: EN 10210 (hot finished: 1.5 t outside, t inside); EN 10219 (cold formed: outside 2 t
// up to 6 mm, 2.5 t up to 10 mm, 3 t above, inside t less); AISC HSS (2 t and t of the design thickness).
enum class TubeForming { hot, cold, hss };
constexpr auto names_of(TubeForming) {
  return std::array<std::pair<std::string_view, TubeForming>, 3>{
      {{"hot", TubeForming::hot}, {"cold", TubeForming::cold}, {"hss", TubeForming::hss}}};
}

struct TubeTable {
  double depth = 0, width = 0, thickness = 0;  // [m]
  std::optional<double> radius;                // [m] outer, of the corners
};

struct TubeSection {
  TubeTable tube;
  TubeForming forming = TubeForming::hot;
  Reference material;
  int along_depth = 8, along_width = 8, across = 2, corner = 2;
  TorsionKeys torsion;

  static constexpr std::array<std::string_view, 1> chosen_by{"tube"};
  static constexpr std::string_view title = "a rectangular tube",
                                    note = "Depth along local y. Area and both second moments of the fibers are exact; "
                                           "a radius of 0 makes sharp corners.";
  double radius() const {
    if (tube.radius) return *tube.radius;
    const double t = tube.thickness;
    if (forming == TubeForming::hss) return 2 * t;
    if (forming == TubeForming::hot) return 1.5 * t;
    return (t <= 0.006 ? 2 : t <= 0.010 ? 2.5 : 3) * t;
  }
  double inner_radius() const {
    if (!tube.radius && forming == TubeForming::hot) return tube.thickness;
    return std::max(radius() - tube.thickness, 0.0);
  }
};

template <class Archive>
void visit(Archive& ar, TubeTable& t) {
  ar(required("depth", "outer, along local y", dimension::length, range::positive), t.depth);
  ar(required("width", "outer, along local z", dimension::length, range::positive), t.width);
  ar(required("thickness", "of the walls", dimension::length, range::positive), t.thickness);
  ar(Field{.key = "radius",
           .text = "outer, of the corners; the inner one is less by the thickness",
           .dimension = dimension::length,
           .range = range::non_negative,
           .default_text = "by `forming`"},
     t.radius);
}
inline constexpr std::string_view tube_row[]{"depth", "width", "thickness", "radius"};
constexpr RowKeys row_keys(const TubeTable*) { return tube_row; }
constexpr std::string_view title_of(const TubeTable*) { return "a tube"; }

template <class Archive>
void visit(Archive& ar, TubeSection& s) {
  ar(required("tube", "dimensions"), s.tube);
  ar(Field{"forming", "corner radius: hot 1.5 t, t inside (EN 10210); cold 2, 2.5 or 3 t up to 6, 10 mm, above (EN 10219); "
                      "hss 2 t (AISC, t the design thickness)"},
     s.forming);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"along_depth", "fibers along the flat part of each wall along y", {}, fiber_count}, s.along_depth);
  ar(Field{"along_width", "of each wall along z", {}, fiber_count}, s.along_width);
  ar(Field{"across", "fibers through the thickness", {}, fiber_count}, s.across);
  ar(Field{"corner", "fibers around each corner", {}, fiber_count}, s.corner);
  visit_torsion(ar, s.torsion, "EN 10210-2");
}

inline SectionFaults faults(const TubeSection& section) {
  const TubeTable& t = section.tube;
  const double least = std::min(t.depth, t.width), radius = section.radius();
  if (!(2 * t.thickness < least)) return {{"tube", "the walls of the tube are thicker than half of it"}};
  if (radius != 0 && (radius < t.thickness || 2 * radius > least))
    return {{"tube", "the tube's outer corner radius must be 0, or lie between its thickness and half its width"}};
  if (2 * (section.inner_radius() + t.thickness) > least)
    return {{"tube", "the walls of the tube are too thick for its inner corners"}};
  return {};
}

// Outer dimensions less the hollow.
inline AreaMoments moments(const TubeSection& section) {
  const auto rounded = [](double depth, double width, double radius) {
    AreaMoments sum = moments(Rectangle{{-depth / 2, depth / 2}, {-width / 2, width / 2}});
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        if (radius > 0) sum.add(spandrel(radius, {y * depth / 2, z * width / 2}, {-y, -z}), -1);
    return sum;
  };
  const auto& [depth, width, t, given] = section.tube;
  AreaMoments sum = rounded(depth, width, section.radius());
  sum.add(rounded(depth - 2 * t, width - 2 * t, section.inner_radius()), -1);
  sum.centroid.setZero();
  sum.second(0, 1) = sum.second(1, 0) = 0;
  return sum;
}

inline void describe(const TubeSection& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  const auto& [depth, width, t, given] = section.tube;
  const double radius = section.radius(), y = depth / 2, z = width / 2;
  if (faults(section).empty() && y > 0 && t > 0) {
    Fibers& all = fibers.fibers;
    const double flat_y = radius > 0 ? y - radius : y - t, flat_z = radius > 0 ? z - radius : z;
    for (const double side : {1.0, -1.0}) {
      if (flat_z > 0)
        add_rectangle(all, {{side * (y - t), side * y}, {-flat_z, flat_z}}, section.across, section.along_width,
                      section.material, Spacing::exact);
      if (flat_y > 0)
        add_rectangle(all, {{-flat_y, flat_y}, {side * (z - t), side * z}}, section.along_depth, section.across,
                      section.material, Spacing::exact);
    }
    for (int quarter = 0; radius > 0 && quarter < 4; ++quarter) {
      const double sy = quarter == 0 || quarter == 3 ? 1 : -1, sz = quarter < 2 ? 1 : -1;
      add_ring(all, {{sy * flat_y, sz * flat_z}, radius - t, radius, quarter * pi / 2, (quarter + 1) * pi / 2},
               section.across, section.corner, section.material);
    }
    match_moments(all, moments(section));
    fibers.torsion_stiffness = section.torsion.stiffness(
        modulus(section.material), tube_torsion(depth, width, t, (radius + section.inner_radius()) / 2));
    for (int i = 0; i < 16; ++i) {  // four points a corner
      const int quarter = i / 4;
      const double sy = quarter == 0 || quarter == 3 ? 1 : -1, sz = quarter < 2 ? 1 : -1;
      const double at = (quarter + (i % 4) / 3.0) * pi / 2;
      if (radius > 0 || i % 4 == 0)
        out.outline.emplace_back(sy * (y - radius) + radius * std::cos(at), sz * (z - radius) + radius * std::sin(at));
    }
  }
  add_laws(section.torsion.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
