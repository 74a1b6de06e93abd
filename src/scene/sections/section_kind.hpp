// What the kinds of sections below this folder share. A kind is one header with a struct of its keys, which has
//   chosen_by   keys, any of which in a scene's table tells the kind
//   title, note for the reference
// and four functions: visit() of the schema, faults(), describe(), and whatever small tables it needs. It is registered
// by its line in sections.hpp.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "elements/fiber_cutting.hpp"
#include "elements/torsion.hpp"
#include "scene/field.hpp"

namespace nsframe {

// A rule that spans several keys, broken; reported at the value of `key`.
struct SectionFault {
  std::string key, message;
};
using SectionFaults = std::vector<SectionFault>;

// Initial modulus of a material of the scene [Pa].
using ElasticModulus = std::function<double(const Reference&)>;

inline constexpr Range fiber_count{1, 1000};

// Laws beside the fibers (FiberSectionDescription).
struct AddedLawKeys {
  std::optional<Reference> torsion, shear_y, shear_z;
};
template <class Archive>
void visit_added_laws(Archive& ar, AddedLawKeys& a) {
  ar(Field{"torsion_law", "material, torsional moment by twist (rad/m), in place of GJ"}, a.torsion);
  ar(Field{"shear_y_law", "material, shear force along local y by shear strain; of force-based beams"}, a.shear_y);
  ar(Field{"shear_z_law", "the same along local z"}, a.shear_z);
}
inline void add_laws(const AddedLawKeys& keys, FiberSectionDescription& out) {
  out.torsion = keys.torsion;
  out.shear_y = keys.shear_y;
  out.shear_z = keys.shear_z;
}

// Shear modulus and torsion constant, where a kind knows good defaults for both.
struct TorsionKeys {
  double poisson = 0.3;
  std::optional<double> G, J;  // [Pa], [m4]
  AddedLawKeys added = {};

  double stiffness(double E, double computed_J) const {
    return G.value_or(E / (2 * (1 + poisson))) * J.value_or(computed_J);
  }
};

// `of_J`: where the default comes from.
template <class Archive>
void visit_torsion(Archive& ar, TorsionKeys& t, std::string_view of_J) {
  ar(Field{"poisson", "Poisson's ratio, for G = E/(2(1 + poisson))", {}, {-1, 0.5, true, false}}, t.poisson);
  ar(Field{"G", "shear modulus, in place of Poisson's ratio", dimension::stress, range::positive}, t.G);
  ar(Field{.key = "J",
           .text = "torsion constant",
           .dimension = dimension::fourth_power_of_length,
           .range = range::positive,
           .default_text = of_J},
     t.J);
  visit_added_laws(ar, t.added);
}

inline SectionOutline rectangle_outline(const Rectangle& r) {
  return {{r.y[0], r.z[0]}, {r.y[1], r.z[0]}, {r.y[1], r.z[1]}, {r.y[0], r.z[1]}};
}

}  // namespace nsframe
