// [section.NAME] with `circle`: a reinforced-concrete circle, solid or hollow.
#pragma once

#include "scene/sections/reinforced_concrete.hpp"

namespace nsframe {

struct ConcreteCircle {
  double circle = 0, hole = 0;  // [m] outer diameter; diameter of the hole
  ConcreteKeys concrete;
  BarsTable bars;
  double first_bar = 0;  // [rad] from y towards z
  int sectors = 24, rings = 10, cover_layers = 2;

  static constexpr std::array<std::string_view, 1> chosen_by{"circle"};
  static constexpr std::string_view title = "a reinforced-concrete circle", note = "";
};

template <class Archive>
void visit(Archive& ar, ConcreteCircle& s) {
  ar(required("circle", "diameter", dimension::length, range::positive), s.circle);
  ar(Field{"hole", "diameter of a hole in the core", dimension::length, range::non_negative}, s.hole);
  visit_concrete(ar, s.concrete);
  ar(required("bars", "equally spaced on a circle"), s.bars);
  ar(Field{"first_bar", "angle of the first bar, from local y towards z", dimension::angle}, s.first_bar);
  ar(Field{"sectors", "fibers around", {}, Range{3, 1000}}, s.sectors);
  ar(Field{"rings", "fibers along the radius of the core", {}, fiber_count}, s.rings);
  ar(Field{"cover_layers", "fibers through the cover", {}, fiber_count}, s.cover_layers);
  visit_torsion(ar, s.concrete.torsion, "of the uncracked circle");
}

inline SectionFaults faults(const ConcreteCircle& section) {
  SectionFaults out;
  add_concrete_faults(section.concrete, section.circle, out);
  const double depth = std::max(section.concrete.cover, section.concrete.bars_at());
  if (section.hole > 0 && !(section.hole < section.circle - 2 * depth))
    out.push_back({"hole", "the hole reaches the cover or the bars"});
  return out;
}

// Order: core, cover, bars.
inline void describe(const ConcreteCircle& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  Fibers& all = fibers.fibers;
  const ConcreteKeys& c = section.concrete;
  const double outer = section.circle / 2, core = outer - c.cover, inner = section.hole / 2;
  if (outer > 0 && faults(section).empty()) {
    add_ring(all, {Vector2::Zero(), inner, core}, section.rings, section.sectors, c.core);
    if (c.cover > 0)
      add_ring(all, {Vector2::Zero(), core, outer}, section.cover_layers, section.sectors, c.outside());
    const std::size_t first_bar = all.size();
    add_bars(all, Vector2::Zero(), outer - c.bars_at(), section.first_bar, section.first_bar + 2 * pi,
             section.bars.count, section.bars.size.value(), c.steel);
    displace_concrete(all, first_bar, c);
    fibers.torsion_stiffness =
        c.torsion.stiffness(modulus(c.core), pi / 2 * (std::pow(outer, 4) - std::pow(inner, 4)));
    out.outline = circle_outline(Vector2::Zero(), outer);
  }
  add_laws(c.torsion.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
