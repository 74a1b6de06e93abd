// [section.NAME] with `rectangle`: a reinforced-concrete rectangle.
#pragma once

#include "scene/sections/reinforced_concrete.hpp"

namespace nsframe {

struct ConcreteRectangle {
  std::array<double, 2> rectangle{};  // [m] depth along y, width along z
  ConcreteKeys concrete;
  std::optional<BarsTable> top, bottom, sides;
  int ny = 20, nz = 20, cover_layers = 2;

  static constexpr std::array<std::string_view, 1> chosen_by{"rectangle"};
  static constexpr std::string_view title = "a reinforced-concrete rectangle",
                                    note = "Top is +y. The corner bars belong to top and bottom.";
};

template <class Archive>
void visit(Archive& ar, ConcreteRectangle& s) {
  ar(required("rectangle", "depth along local y, width along z", dimension::length, range::positive), s.rectangle);
  visit_concrete(ar, s.concrete);
  ar(Field{"top", "row of bars at +y"}, s.top);
  ar(Field{"bottom", "row of bars at -y"}, s.bottom);
  ar(Field{"sides", "on each side between the two rows, equally spaced"}, s.sides);
  ar(Field{"ny", "fibers of the core along y", {}, fiber_count}, s.ny);
  ar(Field{"nz", "fibers of the core, and of the cover at top and bottom, along z", {}, fiber_count}, s.nz);
  ar(Field{"cover_layers", "fibers through the cover", {}, fiber_count}, s.cover_layers);
  visit_torsion(ar, s.concrete.torsion, "of the uncracked rectangle");
}

inline SectionFaults faults(const ConcreteRectangle& section) {
  SectionFaults out;
  add_concrete_faults(section.concrete, std::min(section.rectangle[0], section.rectangle[1]), out);
  if (!section.top && !section.bottom && !section.sides)
    out.push_back({"rectangle", "a reinforced-concrete section needs bars: top, bottom or sides"});
  return out;
}

// Order: core, cover at the top, the bottom and the sides, bars at the top, the bottom and the sides.
inline void describe(const ConcreteRectangle& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  Fibers& all = fibers.fibers;
  out.kind = fibers;
  const ConcreteKeys& c = section.concrete;
  if (!faults(section).empty()) return;
  const double y = section.rectangle[0] / 2, z = section.rectangle[1] / 2;
  const double core_y = y - c.cover, core_z = z - c.cover;
  add_rectangle(all, {{-core_y, core_y}, {-core_z, core_z}}, section.ny, section.nz, c.core);
  if (c.cover > 0) {
    for (const double side : {1.0, -1.0})
      add_rectangle(all, {{side * core_y, side * y}, {-z, z}}, section.cover_layers, section.nz, c.outside());
    for (const double side : {1.0, -1.0})
      add_rectangle(all, {{-core_y, core_y}, {side * core_z, side * z}}, section.ny, section.cover_layers, c.outside());
  }
  const std::size_t first_bar = all.size();
  const double bar_y = y - c.bars_at(), bar_z = z - c.bars_at();
  if (section.top)
    add_bars(all, {bar_y, -bar_z}, {bar_y, bar_z}, section.top->count, section.top->size.value(), c.steel);
  if (section.bottom)
    add_bars(all, {-bar_y, -bar_z}, {-bar_y, bar_z}, section.bottom->count, section.bottom->size.value(), c.steel);
  if (section.sides) {
    const int count = section.sides->count;
    const double step = 2 * bar_y / (count + 1);
    for (const double side : {-bar_z, bar_z})
      add_bars(all, {-bar_y + step, side}, {bar_y - step, side}, count, section.sides->size.value(), c.steel);
  }
  displace_concrete(all, first_bar, c);
  fibers.torsion_stiffness = c.torsion.stiffness(modulus(c.core), rectangle_torsion(2 * y, 2 * z));
  add_laws(c.torsion.added, fibers);
  out.kind = std::move(fibers);
  out.outline = rectangle_outline({{-y, y}, {-z, z}});
}

}  // namespace nsframe
