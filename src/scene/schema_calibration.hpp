// The schema of [calibration]; see schema.hpp.
#pragma once

#include "scene/calibration_table.hpp"
#include "scene/schema.hpp"

namespace nsframe {

template <class Archive>
void visit(Archive& ar, CalibrationParameterTable& p) {
  ar(required("name", "unique"), p.name);
  ar(Field{"sets",
           "keys of the scene that get the parameter's value, as `section.beam.Iz`, `structure.left.braces.area[2]`: dotted, [n] for the "
           "nth of a list of numbers, all of a list without; members of a list of tables by their id or node, as "
           "`structure.a.springs.k1.stiffness.ry`"},
     p.sets);
  ar(Field{"scales", "in place of `sets`: keys whose values in the scene are multiplied by the parameter"}, p.scales);
  ar(required("bounds", "least and largest value, in the unit of the keys; both positive: the fit works on the logarithm"), p.bounds);
  ar(Field{.key = "start", .text = "where the fit starts", .default_text = "the scene's value; 1 for `scales`"}, p.start);
}
inline constexpr std::string_view calibration_parameter_row[]{"name", "sets", "bounds", "bounds", "start"};
constexpr RowKeys row_keys(const CalibrationParameterTable*) { return calibration_parameter_row; }
constexpr bool is_map(const CalibrationParameterTable*) { return true; }

template <class Archive>
void visit(Archive& ar, CalibrationShapeTable& s) {
  ar(required("node", "where a sensor was, a node of the structure"), s.node);
  ar(required("dof", "ux, uy, uz, rx, ry or rz"), s.dof);
  ar(required("value", "of the measured shape, with its sign, in any unit common to the shape"), s.value);
}
inline constexpr std::string_view calibration_shape_row[]{"node", "dof", "value"};
constexpr RowKeys row_keys(const CalibrationShapeTable*) { return calibration_shape_row; }

template <class Archive>
void visit(Archive& ar, CalibrationTargetTable& t) {
  ar(required("structure", "structure"), t.structure);
  ar(Field{.key = "mode", .text = "L1, T2, ... as `nsframe modes` names them", .default_text = "**required**, or `shape`"}, t.mode);
  ar(required("frequency", "measured", dimension::frequency, range::positive), t.frequency);
  ar(Field{"weight", "of the squared relative difference", {}, range::positive}, t.weight);
  ar(Field{"shape",
           "measured shape: the mode is the one with the largest modal assurance criterion (MAC) at these DOFs, among those of the letter "
           "of `mode` if that is given"},
     t.shape);
}
inline constexpr std::string_view calibration_target_row[]{"structure", "mode", "frequency", "weight"};
constexpr RowKeys row_keys(const CalibrationTargetTable*) { return calibration_target_row; }

template <class Archive>
void visit(Archive& ar, CalibrationTable& c) {
  ar(required("parameters", "what is fitted"), c.parameters);
  ar(required("targets", "what it is fitted to"), c.targets);
  ar(Field{"accuracy", "standard error of a measured frequency of weight 1, relative: for what it means for the parameters", {},
           {0, 0.5, true, false}},
     c.accuracy);
  ar(Field{"max_iterations", "of the fit", {}, {1, 10000}}, c.max_iterations);
}

}  // namespace nsframe
