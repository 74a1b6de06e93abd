// What rectangular and circular reinforced-concrete sections share: core and cover, bars, the concrete they displace.
#pragma once

#include "scene/sections/fibers.hpp"

namespace nsframe {

struct ConcreteKeys {
  Reference core, cover_material;   // the latter empty: that of the core
  double cover = 0;                 // [m] from the surface to the core
  Reference steel;
  std::optional<double> bar_depth;  // [m] from the surface to the bars' axes
  bool displaced = false;
  TorsionKeys torsion{0.2, {}, {}};

  const Reference& outside() const { return cover_material.name.empty() ? core : cover_material; }
  double bars_at() const { return bar_depth.value_or(cover); }
};

template <class Archive>
void visit_concrete(Archive& ar, ConcreteKeys& c) {
  ar(required("core", "concrete of the core"), c.core);
  ar(Field{.key = "cover_material", .text = "concrete of the cover", .default_text = "that of the core"},
     c.cover_material);
  ar(Field{"cover", "from the surface to the core", dimension::length, range::non_negative}, c.cover);
  ar(required("steel", "of the bars"), c.steel);
  ar(Field{.key = "bar_depth",
           .text = "from the surface to the bars' axes",
           .dimension = dimension::length,
           .range = range::positive,
           .default_text = "cover"},
     c.bar_depth);
  ar(Field{"displaced", "bars displace their concrete: a fiber that takes it out lies on each"}, c.displaced);
}

inline void add_concrete_faults(const ConcreteKeys& c, double least, SectionFaults& out) {
  if (!(2 * c.cover < least)) out.push_back({"cover", "the cover leaves no core"});
  if (c.cover == 0 && !c.cover_material.name.empty())
    out.push_back({"cover_material", "cover_material is given, but no cover"});
  if (c.bars_at() == 0) out.push_back({"bar_depth", "bars need a bar_depth or a cover"});
  if (!(2 * c.bars_at() < least)) out.push_back({"bar_depth", "the bars lie beyond the middle of the section"});
}

// Takes the concrete out from under the bars, which are the fibers from `first` on.
inline void displace_concrete(Fibers& fibers, std::size_t first, const ConcreteKeys& c) {
  if (!c.displaced) return;
  const Reference& concrete = c.bars_at() < c.cover ? c.outside() : c.core;
  for (std::size_t i = first, end = fibers.size(); i < end; ++i)
    fibers.push_back({fibers[i].y, fibers[i].z, fibers[i].area, concrete, true});
}

struct BarsTable {
  int count = 0;
  BarSize size;
};

template <class Archive>
void visit(Archive& ar, BarsTable& b) {
  ar(required("count", "bars", {}, fiber_count), b.count);
  visit_bar_size(ar, b.size);
}
inline constexpr std::string_view bars_row[]{"count", "diameter"};
constexpr RowKeys row_keys(const BarsTable*) { return bars_row; }
constexpr std::string_view title_of(const BarsTable*) { return "bars of one size"; }
inline SectionFaults faults(const BarsTable& bars) {
  SectionFaults out;
  add_size_fault(bars.size, out);
  return out;
}

}  // namespace nsframe
