// [section.NAME] by elastic constants.
#pragma once

#include "scene/sections/section_kind.hpp"

namespace nsframe {

struct ConstantsSection {
  ElasticSection constants;          // but for G
  std::optional<double> G, poisson;  // [Pa], [-]: one of them
  double depth = 0, width = 0;       // [m] along local y and z, of the rectangle drawn

  static constexpr std::array<std::string_view, 2> chosen_by{"A", "E"};
  static constexpr std::string_view title = "constants", note = "";
};

template <class Archive>
void visit(Archive& ar, ConstantsSection& s) {
  constexpr Dimension m4 = dimension::fourth_power_of_length;
  ar(required("E", "elastic modulus", dimension::stress, range::positive), s.constants.E);
  ar(Field{.key = "G", .text = "shear modulus", .dimension = dimension::stress, .range = range::non_negative}, s.G);
  ar(Field{"poisson", "Poisson's ratio, in place of G = E/(2(1 + poisson))", {}, {-1, 0.5, true, false}}, s.poisson);
  ar(required("A", "area", dimension::area, range::positive), s.constants.A);
  ar(required("Iz", "second moment for bending in the local x-y plane", m4, range::positive), s.constants.Iz);
  ar(required("Iy", "second moment for bending in the local x-z plane", m4, range::positive), s.constants.Iy);
  ar(required("J", "torsion constant", m4, range::non_negative), s.constants.J);
  ar(Field{"Ay", "shear area for forces along local y, Timoshenko's beam; 0: no shear deformation", dimension::area,
           range::non_negative},
     s.constants.Ay);
  ar(Field{"Az", "the same along local z", dimension::area, range::non_negative}, s.constants.Az);
  ar(Field{"depth", "along local y, of the rectangle drawn; 0: none drawn", dimension::length, range::non_negative},
     s.depth);
  ar(Field{"width", "along local z, of the rectangle drawn", dimension::length, range::non_negative}, s.width);
}

inline SectionFaults faults(const ConstantsSection& section) {
  if (section.G.has_value() != section.poisson.has_value()) return {};
  return {{"G", "a section of constants needs either G or poisson"}};
}

inline void describe(const ConstantsSection& section, const ElasticModulus&, SectionDescription& out) {
  ElasticSection constants = section.constants;
  constants.G = section.G.value_or(constants.E / (2 * (1 + section.poisson.value_or(0))));
  out.kind = constants;
  const double y = section.depth / 2, z = section.width / 2;
  if (y > 0 && z > 0) out.outline = rectangle_outline({{-y, y}, {-z, z}});
}

}  // namespace nsframe
