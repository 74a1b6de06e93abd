// [section.NAME] with `angle`: an equal or unequal angle by its dimensions.
#pragma once

#include "scene/sections/section_kind.hpp"

namespace nsframe {

struct AngleTable {
  double depth = 0, width = 0, thickness = 0;  // [m]
  double root = 0;                             // [m] radius between the legs
  std::optional<double> toe;                   // [m] radius at the ends of the legs
};

struct AngleSection {
  AngleTable angle;
  bool principal_axes = false;
  Reference material;
  int along = 10, across = 2;
  TorsionKeys torsion;

  static constexpr std::array<std::string_view, 1> chosen_by{"angle"};
  static constexpr std::string_view title = "an angle",
                                    note = "Legs along local y and z from the heel, which lies at lowest y and z; axes "
                                           "through the centroid. Area, second moments and their product are exact. "
                                           "Members take the shear centre as lying on the centroid.";
};

template <class Archive>
void visit(Archive& ar, AngleTable& a) {
  ar(required("depth", "of the leg along local y", dimension::length, range::positive), a.depth);
  ar(required("width", "of the leg along local z", dimension::length, range::positive), a.width);
  ar(required("thickness", "of the legs", dimension::length, range::positive), a.thickness);
  ar(Field{"root", "radius between the legs", dimension::length, range::non_negative}, a.root);
  ar(Field{.key = "toe",
           .text = "radius at the ends of the legs",
           .dimension = dimension::length,
           .range = range::non_negative,
           .default_text = "half of root"},
     a.toe);
}
inline constexpr std::string_view angle_row[]{"depth", "width", "thickness", "root", "toe"};
constexpr RowKeys row_keys(const AngleTable*) { return angle_row; }
constexpr std::string_view title_of(const AngleTable*) { return "an angle"; }

template <class Archive>
void visit(Archive& ar, AngleSection& s) {
  ar(required("angle", "dimensions"), s.angle);
  ar(Field{"principal_axes", "turned until y and z are the principal axes, z the strong one (elastic members need it)"},
     s.principal_axes);
  ar(required("material", "of the fibers"), s.material);
  ar(Field{"along", "fibers along each leg", {}, fiber_count}, s.along);
  ar(Field{"across", "fibers through the thickness", {}, fiber_count}, s.across);
  visit_torsion(ar, s.torsion, "El Darwish and Johnston");
}

inline SectionFaults faults(const AngleSection& section) {
  const AngleTable& a = section.angle;
  const double least = std::min(a.depth, a.width);
  if (!(a.thickness < least)) return {{"angle", "the legs of the angle are thicker than long"}};
  if (a.root > least - a.thickness) return {{"angle", "the angle's root radius exceeds its legs"}};
  if (a.toe.value_or(a.root / 2) > a.thickness) return {{"angle", "the angle's toe radius exceeds its thickness"}};
  return {};
}

// From the heel.
inline AreaMoments moments(const AngleTable& angle) {
  const auto& [depth, width, t, root, given] = angle;
  const double toe = given.value_or(root / 2);
  AreaMoments sum = moments(Rectangle{{0, depth}, {0, t}});
  sum.add(moments(Rectangle{{0, t}, {t, width}}));
  if (root > 0) sum.add(spandrel(root, {t, t}, {1, 1}));
  if (toe > 0) {
    sum.add(spandrel(toe, {depth, t}, {-1, -1}), -1);
    sum.add(spandrel(toe, {t, width}, {-1, -1}), -1);
  }
  return sum;
}

// Rows: directions of the new y, that of the largest integral of yy, and of the new z in the legs' axes.
inline Matrix2 principal_axes(const Matrix2& second) {
  const double turn = std::atan2(2 * second(0, 1), second(0, 0) - second(1, 1)) / 2;
  return Eigen::Rotation2D<double>(-turn).toRotationMatrix();
}

inline void describe(const AngleSection& section, const ElasticModulus& modulus, SectionDescription& out) {
  FiberSectionDescription fibers;
  const auto& [depth, width, t, root, toe] = section.angle;
  if (t > 0 && faults(section).empty()) {
    Fibers& all = fibers.fibers;
    add_rectangle(all, {{0, depth}, {0, t}}, section.along, section.across, section.material, Spacing::exact);
    add_rectangle(all, {{0, t}, {t, width}}, section.across, section.along, section.material, Spacing::exact);
    if (root > 0) {
      const AreaMoments fillet = spandrel(root, {t, t}, {1, 1});
      all.push_back({fillet.centroid.x(), fillet.centroid.y(), fillet.area, section.material});
    }
    const AreaMoments exact = moments(section.angle);
    match_moments(all, exact);
    const Matrix2 axes = section.principal_axes ? principal_axes(exact.second) : Matrix2(Matrix2::Identity());
    for (FiberDescription& f : all) {
      const Vector2 at = axes * (Vector2(f.y, f.z) - exact.centroid);
      f.y = at.x();
      f.z = at.y();
    }
    for (const Vector2& corner : SectionOutline{{0, 0}, {depth, 0}, {depth, t}, {t, t}, {t, width}, {0, width}})
      out.outline.emplace_back(axes * (corner - exact.centroid));
    fibers.torsion_stiffness =
        section.torsion.stiffness(modulus(section.material), angle_torsion(depth, width, t, root));
  }
  add_laws(section.torsion.added, fibers);
  out.kind = std::move(fibers);
}

}  // namespace nsframe
