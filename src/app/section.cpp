#include "app/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "models/build_elements.hpp"
#include "scene/quantity.hpp"

namespace nsframe::app {

namespace {

constexpr Dimension curvature_dimension{-1, 0, 0, 1};

// A quantity of the command line; bare numbers are in `bare` SI units.
double option_value(const std::string& option, const std::string& text, const Dimension& wanted, double bare = 1) {
  try {
    const Quantity read = parse_quantity(text);
    return read.dimension == dimension::none ? read.value * bare : parse_quantity(text, wanted);
  } catch (const QuantityError& problem) {
    throw InputError(fmt::format("error: {} = \"{}\"{}", option, text, problem.what()));
  }
}

// The section with its laws; every fault of materials and sections is reported.
AnalysedSection find_section(const SectionArguments& arguments) {
  Diagnostics diagnostics;
  const Scene scene = read_scene(arguments.scene.scene, arguments.scene.set, diagnostics);
  const Library library = build_library(scene.model, diagnostics);
  diagnostics.throw_if_any();
  const auto found = library.sections.find(arguments.section);
  if (found == library.sections.end()) {
    throw InputError(fmt::format("{}: error: section '{}' is not defined{}", arguments.scene.scene.string(), arguments.section,
                                 did_you_mean(arguments.section, keys(library.sections))));
  }
  const SectionDescription& description = *found->second.description;
  const auto* fibers = std::get_if<FiberSectionDescription>(&description.kind);
  if (!fibers) {
    diagnostics.error(description.at, fmt::format("section '{}' has elastic constants only: there is nothing to analyse",
                                                  arguments.section));
    diagnostics.throw_if_any();
  }
  return analysed_section(arguments.section, *fibers, library.materials);
}

// Extent of the fibers across the axis of bending.
double depth_of(const AnalysedSection& section, double angle) {
  double low = 0, high = 0;
  bool first = true;
  for (const SectionPart& part : section.parts) {
    const auto [a, b] = strain_range(part, Vector3(0, std::cos(angle), std::sin(angle)));
    low = first ? a : std::min(low, a);
    high = first ? b : std::max(high, b);
    first = false;
  }
  return high - low;
}

std::vector<double> curvatures(const SectionArguments& arguments, const AnalysedSection& section, double angle) {
  if (!arguments.cycles.empty() && !arguments.curvature.empty())
    throw InputError("error: --curvature and --cycles exclude each other");
  std::vector<double> out;
  for (const std::string& cycle : arguments.cycles) {
    const double amplitude = option_value("--cycles", cycle, curvature_dimension);
    if (!(amplitude > 0)) throw InputError(fmt::format("error: --cycles = \"{}\", must be positive", cycle));
    out.insert(out.end(), {amplitude, -amplitude});
  }
  if (!out.empty()) {
    out.push_back(0);
    return out;
  }
  if (!arguments.curvature.empty()) {
    out.push_back(option_value("--curvature", arguments.curvature, curvature_dimension));
    if (out.front() == 0) throw InputError("error: --curvature = 0, must not be zero");
    return out;
  }
  const double depth = depth_of(section, angle);
  if (!(depth > 0))
    throw InputError(fmt::format("error: the fibers of section '{}' lie on the axis of bending", section.name));
  return {0.03 / depth};
}

std::vector<StrainLimit> strain_limits(const SectionArguments& arguments, const AnalysedSection& section) {
  for (const auto& [name, value] : {std::pair{"--shortening", arguments.shortening}, {"--elongation", arguments.elongation}})
    if (!(value > 0)) throw InputError(fmt::format("error: {} = {}, must be positive", name, value));
  std::vector<StrainLimit> limits(section.parts.size(), {arguments.shortening, arguments.elongation});
  std::vector<std::string> names;
  for (const SectionPart& part : section.parts) names.push_back(part.material);
  for (const std::string& text : arguments.limits) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("error: --limit = \"{}\", must be MATERIAL=STRAIN", text));
    const std::string name = text.substr(0, equals);
    const auto part = std::find(names.begin(), names.end(), name);
    if (part == names.end())
      throw InputError(fmt::format("error: --limit: the section has no material '{}'{}", name, did_you_mean(name, names)));
    const double strain = option_value("--limit", text.substr(equals + 1), dimension::none);
    if (strain == 0) throw InputError(fmt::format("error: --limit = \"{}\", must not be zero", text));
    StrainLimit& limit = limits[static_cast<std::size_t>(part - names.begin())];
    (strain < 0 ? limit.shortening : limit.elongation) = std::abs(strain);
  }
  return limits;
}

void add_interaction(const SectionArguments& arguments, SectionReport& report) {
  report.limits = strain_limits(arguments, report.section);
  const int angles = arguments.surface > 0 ? arguments.surface : 2;
  for (int i = 0; i < angles; ++i) {
    InteractionOptions options;
    options.angle = report.angle + 2 * pi * i / angles;
    options.limits = report.limits;
    options.points = arguments.points;
    report.interaction.push_back({options.angle, interaction(report.section, options)});
  }
}

}  // namespace

int section(const SectionArguments& arguments) {
  SectionReport report;
  report.section = find_section(arguments);
  report.axial_force = option_value("--axial", arguments.axial, dimension::force);
  report.angle = option_value("--angle", arguments.angle, dimension::angle, pi / 180);
  report.free_axis = arguments.free_axis;
  report.cyclic = !arguments.cycles.empty();
  MomentCurvatureOptions options;
  options.axial_force = report.axial_force;
  options.angle = report.angle;
  options.curvatures = curvatures(arguments, report.section, report.angle);
  options.steps = arguments.steps;
  options.free_axis = arguments.free_axis;
  report.curve = moment_curvature(report.section, options);
  report.summary = summarize(report.section, report.curve);
  if (arguments.interaction || arguments.surface > 0) add_interaction(arguments, report);
  if (arguments.scene.json) {
    fmt::print("{}\n", section_json(report));
  } else {
    print_section(report);
  }
  if (arguments.scene.output.empty()) return done;
  make_folder(arguments.scene.output);
  write_text(arguments.scene.output / "section.json", section_json(report) + "\n");
  write_text(arguments.scene.output / "moment_curvature.csv", moment_curvature_csv(report));
  if (!report.interaction.empty()) write_text(arguments.scene.output / "interaction.csv", interaction_csv(report));
  if (!arguments.scene.json) {
    fmt::print("written to {}; plot: python3 python/plot_section.py {}\n", arguments.scene.output.string(),
               arguments.scene.output.string());
  }
  return done;
}

}  // namespace nsframe::app
