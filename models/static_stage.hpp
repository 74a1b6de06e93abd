// Static stages: what a scene asks for, and the same with names resolved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/types.hpp"

namespace nsframe {

struct NodalLoadDescription {
  Reference node;    // "structure.node"
  int dof = 0;
  double value = 0;  // [N, N m]
};

enum class ArcKind { spherical, cylindrical };

// How a stage goes on, apart from what it loads.
struct StageOptions {
  std::string control = "load";        // name in the registry of controls (integrators/static_control.hpp)
  Location control_at;
  std::vector<double> targets;         // successive load factors, or displacements of the control DOF [m, rad]
  bool relative = false;               // displacements count from the start of the stage
  double step = 0;                     // largest increment between targets, in their unit; 0: by `steps`
  int steps = 20;                      // increments to each target
  ArcKind arc = ArcKind::spherical;
  int max_points = 2000;               // arc-length only: points after which the target counts as out of reach
  double tolerance = 1e-10;            // residual relative to the largest force
  int max_iterations = 30;             // of Newton's method at a point
};

struct StageDescription {
  std::string name;
  Location at;
  std::vector<NodalLoadDescription> loads;
  std::optional<Vector3> masses;       // a unit acceleration: every mass pulled in this direction [m/s2]
  std::optional<Reference> mode;       // "structure.L1": masses times mode shape, scaled to forces of 1 N in all
  std::optional<Reference> control_node;
  int control_dof = 0;
  StageOptions options;
};

struct StaticStage {
  std::string name;
  Location at;
  VectorX pattern;                     // forces of load factor 1, free DOFs [N, N m]; those of a mode come later
  std::string mode;                    // "structure.L1"; empty: none
  Location mode_at;
  std::string control_name;            // "left.9 ux"; empty when no node is named
  VectorX control_row;                 // control displacement = control_row' q; empty as well
  StageOptions options;
};

struct Model;
struct ModelDescription;

// Resolves the stages of a description that has otherwise been built into `model`.
void build_stages(const ModelDescription& description, Model& model, Diagnostics& diagnostics);

}  // namespace nsframe
