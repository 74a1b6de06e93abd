// `nsframe section`: what is asked of a section, what it answers, and how that is written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "elements/section_analysis.hpp"

namespace nsframe::app {

// As written on the command line; quantities are texts with units.
struct SectionArguments {
  SceneArguments scene;
  std::string section;
  std::string axial = "0";
  std::string angle = "0";
  std::string curvature;            // empty: one that strains the section's faces to 3 % of its depth apart
  std::vector<std::string> cycles;  // amplitudes of curvature, each to both sides; in place of `curvature`
  int steps = 200;
  bool free_axis = false;
  bool interaction = false;
  int points = 41;
  int surface = 0;  // angles around; 0: `angle` and its opposite
  double shortening = StrainLimit{}.shortening, elongation = StrainLimit{}.elongation;
  std::vector<std::string> limits;  // "material=-0.0035" (shortening) or "material=0.01" (elongation)
};

struct InteractionCurve {
  double angle = 0;  // [rad]
  std::vector<InteractionPoint> points;
};

struct SectionReport {
  AnalysedSection section;
  double axial_force = 0, angle = 0;  // [N], [rad]
  bool free_axis = false, cyclic = false;
  MomentCurvature curve;
  BendingSummary summary;
  std::vector<StrainLimit> limits;  // of the parts, when there are interaction curves
  std::vector<InteractionCurve> interaction;
};

void print_section(const SectionReport& report);
std::string section_json(const SectionReport& report);
std::string moment_curvature_csv(const SectionReport& report);
std::string interaction_csv(const SectionReport& report);

}  // namespace nsframe::app
