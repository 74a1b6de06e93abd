// A fiber section alone: moment and curvature under a held axial force, and the axial forces and moments at given
// strains (theory.md, "Sections alone"). Signs and axes are those of fiber sections: tension positive, a positive
// curvature about z shortens +y. The axis of bending lies at `angle` from z towards y: 0 bends about z, 90 deg about y.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "elements/fiber_section.hpp"
#include "elements/sections.hpp"

namespace nsframe {

// The fibers of one material.
struct SectionPart {
  std::string material;
  UniaxialLaw law;
  std::vector<Vector2> points;  // y, z [m]
  double area = 0;              // [m2]
};

struct AnalysedSection {
  std::string name;
  FiberSection fibers;
  std::vector<SectionPart> parts;
};

// Every material of the fibers must be among the laws.
AnalysedSection analysed_section(const std::string& name, const FiberSectionDescription& description,
                                 const std::map<std::string, UniaxialLaw>& laws);

// Smallest and largest strain of a part's fibers.
std::array<double, 2> strain_range(const SectionPart& part, const Vector3& deformation);

struct BendingState {
  double curvature = 0;               // [1/m] about the axis of bending
  double moment = 0;                  // [N m] about it
  double transverse_moment = 0;       // [N m] about the axis across
  Vector3 deformation = Vector3::Zero();  // e0, kz, ky
  Vector3 force = Vector3::Zero();        // N, Mz, My
  std::vector<std::array<double, 2>> strain;  // of every part: smallest, largest
};

struct MomentCurvatureOptions {
  double axial_force = 0;            // [N], held
  double angle = 0;                  // [rad]
  std::vector<double> curvatures;    // [1/m] to reach one after the other, from 0
  int steps = 200;                   // to each of them
  bool free_axis = false;            // the curvature across follows so that no moment acts across; else it is zero
};

struct MomentCurvature {
  std::vector<BendingState> states;  // the first has the axial force alone
  std::string end;                   // why it ended early; empty: every curvature was reached
};

// Throws ConvergenceError when the section cannot carry the axial force without bending.
MomentCurvature moment_curvature(const AnalysedSection& section, const MomentCurvatureOptions& options);

// What a monotonic curve says. Indices of states; a point between two states is interpolated.
struct BendingPoint {
  double curvature = 0, moment = 0;
};
struct BendingSummary {
  std::vector<std::optional<BendingPoint>> first_yield;  // of every part's first fiber
  std::optional<BendingPoint> yield;                     // the first of them
  BendingPoint peak;                                     // largest moment
  BendingPoint ultimate;  // where the moment has fallen to 0.8 of the peak, or the last state
  bool fallen = false;    // to 0.8 of the peak
};
BendingSummary summarize(const AnalysedSection& section, const MomentCurvature& curve);

// Largest strains that the fibers of a part may have.
struct StrainLimit {
  double shortening = 0.0035, elongation = 0.01;  // both positive
};

struct InteractionOptions {
  double angle = 0;                // [rad]
  std::vector<StrainLimit> limits;  // of every part
  int points = 41;                 // from pure shortening to pure elongation
  int steps = 100;                 // of the strains on their way from zero, for laws that remember
};

struct InteractionPoint {
  Vector3 deformation = Vector3::Zero();
  Vector3 force = Vector3::Zero();           // N, Mz, My
  double moment = 0, transverse_moment = 0;  // [N m]
  int governing = -1;                        // part whose limit is reached
};

// Strain planes that just reach a limit; a limit counts only for fibers that carry stress there (cracked or crushed
// concrete doesn't).
std::vector<InteractionPoint> interaction(const AnalysedSection& section, const InteractionOptions& options);

}  // namespace nsframe
