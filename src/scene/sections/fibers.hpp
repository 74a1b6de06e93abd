// [section.NAME] by fibers: patches, rows of bars and single fibers, as section Fiber of OpenSees.
#pragma once

#include "scene/sections/section_kind.hpp"

namespace nsframe {

struct PatchTable {
  Reference material;
  std::array<double, 2> y{}, z{};  // [m] from, to
  int ny = 1, nz = 1;
};

struct QuadTable {
  Reference material;
  std::array<std::array<double, 2>, 4> corners{};  // [m] y, z of I, J, K, L
  int n_ij = 1, n_jk = 1;

  Quadrilateral points() const {
    Quadrilateral out;
    for (std::size_t i = 0; i < 4; ++i) out[i] = Vector2(corners[i][0], corners[i][1]);
    return out;
  }
};

struct RingTable {
  Reference material;
  std::array<double, 2> center{}, radius{};      // [m] y, z; inner, outer
  std::array<double, 2> angle{0, 2 * pi};        // [rad] from, to
  int rings = 1, sectors = 1;

  RingSector sector() const { return {{center[0], center[1]}, radius[0], radius[1], angle[0], angle[1]}; }
};

// One of the two.
struct BarSize {
  std::optional<double> area, diameter;  // [m2], [m]
  double value() const { return area.value_or(pi / 4 * diameter.value_or(0) * diameter.value_or(0)); }
};

struct BarLineTable {
  Reference material;
  std::array<double, 2> from{}, to{};  // [m] y, z
  int count = 1;
  BarSize size;
};

struct BarArcTable {
  Reference material;
  std::array<double, 2> center{};          // [m] y, z
  double radius = 0;                       // [m]
  std::array<double, 2> angle{0, 2 * pi};  // [rad] from, to
  int count = 1;
  BarSize size;
};

struct FiberTable {
  double y = 0, z = 0, area = 0;  // [m], [m2]
  Reference material;
};

struct PatchSection {
  std::vector<PatchTable> patches;
  std::vector<QuadTable> quads;
  std::vector<RingTable> rings;
  std::vector<BarLineTable> layers;
  std::vector<BarArcTable> arcs;
  std::vector<FiberTable> fibers;
  std::optional<double> GJ, G, J;  // [N m2], [Pa], [m4]
  bool centred = false;
  AddedLawKeys added;

  static constexpr std::array<std::string_view, 6> chosen_by{"patches", "quads", "rings", "layers", "arcs", "fibers"};
  static constexpr std::string_view title = "fibers", note = "Either `GJ`, or `G` and `J`, or `torsion_law`.";
};

template <class Archive>
void visit(Archive& ar, PatchTable& p) {
  ar(required("material", "of the fibers"), p.material);
  ar(required("y", "from and to along local y", dimension::length), p.y);
  ar(required("z", "from and to along local z", dimension::length), p.z);
  ar(Field{"ny", "fibers along y", {}, fiber_count}, p.ny);
  ar(Field{"nz", "fibers along z", {}, fiber_count}, p.nz);
}
constexpr std::string_view title_of(const PatchTable*) { return "a patch"; }

template <class Archive>
void visit(Archive& ar, QuadTable& q) {
  ar(required("material", "of the fibers"), q.material);
  ar(required("corners", "four points [y, z] in order around a convex area: I, J, K, L", dimension::length), q.corners);
  ar(Field{"n_ij", "fibers from I to J", {}, fiber_count}, q.n_ij);
  ar(Field{"n_jk", "fibers from J to K", {}, fiber_count}, q.n_jk);
}
constexpr std::string_view title_of(const QuadTable*) { return "a quadrilateral"; }

inline SectionFaults faults(const QuadTable& quad) {
  if (is_convex(quad.points())) return {};
  return {{"corners", "corners must go around a convex area"}};
}

template <class Archive>
void visit_angle(Archive& ar, std::array<double, 2>& angle) {
  ar(Field{.key = "angle",
           .text = "from and to, from local y towards z",
           .dimension = dimension::angle,
           .default_text = "full circle"},
     angle);
}

// The arc must turn forwards, once at most (2 pi written in degrees may be off by its rounding).
inline void add_angle_fault(const std::array<double, 2>& angle, SectionFaults& out) {
  if (!(angle[1] > angle[0]) || angle[1] - angle[0] > 2 * pi * (1 + 1e-12))
    out.push_back({"angle", "angle must rise, by a full circle at most"});
}

template <class Archive>
void visit(Archive& ar, RingTable& r) {
  ar(required("material", "of the fibers"), r.material);
  ar(Field{"center", "y, z", dimension::length}, r.center);
  ar(required("radius", "inner and outer", dimension::length, range::non_negative), r.radius);
  visit_angle(ar, r.angle);
  ar(Field{"rings", "fibers along the radius", {}, fiber_count}, r.rings);
  ar(required("sectors", "fibers around", {}, fiber_count), r.sectors);
}
constexpr std::string_view title_of(const RingTable*) { return "a ring or its sector"; }

inline SectionFaults faults(const RingTable& ring) {
  SectionFaults out;
  if (!(ring.radius[1] > ring.radius[0])) out.push_back({"radius", "the outer radius must exceed the inner one"});
  add_angle_fault(ring.angle, out);
  return out;
}

template <class Archive>
void visit_bar_size(Archive& ar, BarSize& size) {
  ar(Field{"diameter", "of a bar, or its area", dimension::length, range::positive}, size.diameter);
  ar(Field{"area", "of a bar", dimension::area, range::positive}, size.area);
}
inline void add_size_fault(const BarSize& size, SectionFaults& out) {
  if (size.area.has_value() == size.diameter.has_value())
    out.push_back({"diameter", "bars need either a diameter or an area"});
}

template <class Archive>
void visit(Archive& ar, BarLineTable& b) {
  ar(required("material", "of the bars"), b.material);
  ar(required("from", "first bar: y, z", dimension::length), b.from);
  ar(required("to", "last bar: y, z", dimension::length), b.to);
  ar(required("count", "bars; one alone lies halfway", {}, fiber_count), b.count);
  visit_bar_size(ar, b.size);
}
constexpr std::string_view title_of(const BarLineTable*) { return "bars in a line"; }
inline SectionFaults faults(const BarLineTable& bars) {
  SectionFaults out;
  add_size_fault(bars.size, out);
  return out;
}

template <class Archive>
void visit(Archive& ar, BarArcTable& b) {
  ar(required("material", "of the bars"), b.material);
  ar(Field{"center", "y, z", dimension::length}, b.center);
  ar(required("radius", "radius", dimension::length, range::positive), b.radius);
  visit_angle(ar, b.angle);
  ar(required("count", "bars; one alone on an arc lies halfway", {}, fiber_count), b.count);
  visit_bar_size(ar, b.size);
}
constexpr std::string_view title_of(const BarArcTable*) { return "bars on an arc"; }
inline SectionFaults faults(const BarArcTable& bars) {
  SectionFaults out;
  add_size_fault(bars.size, out);
  add_angle_fault(bars.angle, out);
  return out;
}

template <class Archive>
void visit(Archive& ar, FiberTable& f) {
  ar(required("y", "place along local y", dimension::length), f.y);
  ar(required("z", "place along local z", dimension::length), f.z);
  ar(required("area", "area", dimension::area, range::positive), f.area);
  ar(required("material", "of the fiber"), f.material);
}
inline constexpr std::string_view fiber_row[]{"y", "z", "area", "material"};
constexpr RowKeys row_keys(const FiberTable*) { return fiber_row; }
constexpr std::string_view title_of(const FiberTable*) { return "a fiber"; }

template <class Archive>
void visit(Archive& ar, PatchSection& s) {
  ar(Field{"patches", "rectangles cut into fibers"}, s.patches);
  ar(Field{"quads", "quadrilaterals cut into fibers"}, s.quads);
  ar(Field{"rings", "discs, rings and their sectors cut into fibers"}, s.rings);
  ar(Field{"layers", "rows of bars"}, s.layers);
  ar(Field{"arcs", "bars on circles and arcs"}, s.arcs);
  ar(Field{"fibers", "single fibers"}, s.fibers);
  ar(Field{"centred", "axes through the centroid of all areas, whatever their moduli, as in OpenSees; else as written"},
     s.centred);
  ar(Field{"GJ", "torsional stiffness", dimension::bending_stiffness, range::non_negative}, s.GJ);
  ar(Field{"G", "shear modulus, with J in place of GJ", dimension::stress, range::non_negative}, s.G);
  ar(Field{"J", "torsion constant", dimension::fourth_power_of_length, range::non_negative}, s.J);
  visit_added_laws(ar, s.added);
}

inline SectionFaults faults(const PatchSection& section) {
  SectionFaults out;
  const int torsion = section.GJ.has_value() + (section.G && section.J) + section.added.torsion.has_value();
  if (torsion != 1 || section.G.has_value() != section.J.has_value())
    out.push_back({"GJ", "a fiber section needs either GJ, or G and J, or torsion_law"});
  for (const PatchTable& patch : section.patches)
    if (patch.y[0] == patch.y[1] || patch.z[0] == patch.z[1]) out.push_back({"patches", "a patch has no area"});
  return out;
}

// The convex polygon around patches, quadrilaterals and rings.
inline SectionOutline outline(const PatchSection& section) {
  std::vector<Vector2> points;
  for (const PatchTable& p : section.patches)
    for (const Vector2& corner : rectangle_outline({p.y, p.z})) points.push_back(corner);
  for (const QuadTable& quad : section.quads)
    for (const Vector2& corner : quad.points()) points.push_back(corner);
  for (const RingTable& r : section.rings) {
    for (int i = 0; i <= 24; ++i) {
      const double at = r.angle[0] + i * (r.angle[1] - r.angle[0]) / 24;
      for (const double radius : r.radius)
        points.emplace_back(r.center[0] + radius * std::cos(at), r.center[1] + radius * std::sin(at));
    }
  }
  return convex_outline(std::move(points));
}

inline void describe(const PatchSection& section, const ElasticModulus&, SectionDescription& out) {
  FiberSectionDescription fibers;
  Fibers& all = fibers.fibers;
  for (const PatchTable& p : section.patches) add_rectangle(all, {p.y, p.z}, p.ny, p.nz, p.material);
  for (const QuadTable& q : section.quads) add_quadrilateral(all, q.points(), q.n_ij, q.n_jk, q.material);
  for (const RingTable& r : section.rings) add_ring(all, r.sector(), r.rings, r.sectors, r.material);
  for (const BarLineTable& b : section.layers)
    add_bars(all, {b.from[0], b.from[1]}, {b.to[0], b.to[1]}, b.count, b.size.value(), b.material);
  for (const BarArcTable& b : section.arcs)
    add_bars(all, {b.center[0], b.center[1]}, b.radius, b.angle[0], b.angle[1], b.count, b.size.value(), b.material);
  for (const FiberTable& fiber : section.fibers) all.push_back({fiber.y, fiber.z, fiber.area, fiber.material});
  fibers.torsion_stiffness = section.GJ ? *section.GJ : section.G.value_or(0) * section.J.value_or(0);
  out.outline = outline(section);
  if (section.centred && !all.empty()) {
    const Vector2 centroid = moments(all).centroid;
    for (FiberDescription& f : all) {
      f.y -= centroid.x();
      f.z -= centroid.y();
    }
    for (Vector2& point : out.outline) point -= centroid;
  }
  add_laws(section.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
