// nsframe plot: figures of a run as SVG or PNG.
#include "app/plot.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "app/commands.hpp"
#include "app/motion_input.hpp"
#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "output/files.hpp"
#include "plot/picture.hpp"
#include "report/figures.hpp"

namespace nsframe::app {

namespace {

constexpr int default_width = 1000, least_pixels = 100, most_pixels = 20000;

struct PlotArguments {
  std::filesystem::path folder, compare, output;
  std::vector<std::string> quantities, nodes, floors, sections, labels;
  std::string direction, from, to, title;
  int width = default_width, height = 0;
};

int direction_of(const std::string& name) {
  if (name.empty()) return -1;
  const std::vector<std::string> known{"x", "y", "z"};
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) throw InputError(fmt::format("error: --direction '{}' is not known{}", name, did_you_mean(name, known)));
  return static_cast<int>(found - known.begin());
}

RunFolder read_run(const std::filesystem::path& folder, const PlotArguments& a) {
  RunFolder run(folder);
  if (a.from.empty() && a.to.empty()) return run;
  const double end = std::numeric_limits<double>::max();
  const double from = a.from.empty() ? 0 : quantity("--from", a.from, dimension::time);
  const double to = a.to.empty() ? end : quantity("--to", a.to, dimension::time);
  if (!(from < to)) throw InputError(fmt::format("error: --from {} is not before --to {}", a.from, a.to));
  run.limit(from, to);
  return run;
}

std::string heading(const PlotArguments& a, const RunFolder& run) {
  if (!a.title.empty()) return a.title;
  const auto& s = run.summary;
  const std::string title = s.at("title").get<std::string>().empty() ? a.folder.filename().string() : s.at("title").get<std::string>();
  if (run.time.empty() || !a.compare.empty()) return title;
  std::string course = fmt::format("{}, dt = {:g} ms", s.at("scheme").get<std::string>(), 1e3 * s.at("dt").get<double>());
  if (s.at("scheme") == "moreau-jean") course += fmt::format(", θ = {:g}", s.at("theta").get<double>());
  const std::size_t poundings = s.at("poundings").size();
  if (!s.at("pairs").empty()) course += fmt::format(", {} pounding{}", poundings, poundings == 1 ? "" : "s");
  return fmt::format("{} ({})", title, course);
}

// The label of a run among two: as given, or the name of its folder.
std::string label_of(const PlotArguments& a, std::size_t which) {
  if (!a.labels.empty()) return a.labels[which];
  const std::filesystem::path& folder = which == 0 ? a.folder : a.compare;
  return std::filesystem::weakly_canonical(folder).filename().string();
}

int plot(const PlotArguments& a) {
  if (!a.labels.empty() && a.compare.empty()) throw InputError("error: --labels name the runs of --compare, which is missing");
  if (!a.nodes.empty() && !a.floors.empty()) throw InputError("error: give one of --nodes and --floors");
  const std::filesystem::path target = a.output.empty() ? a.folder / "plot.svg" : a.output;
  FigureChoice choice{a.quantities, a.sections, {a.nodes, a.floors, direction_of(a.direction), static_cast<std::size_t>(a.width), true}};
  if (!a.sections.empty() && std::find(a.quantities.begin(), a.quantities.end(), "hysteresis") == a.quantities.end())
    throw InputError("error: --sections are drawn by --quantity hysteresis");
  try {
    const RunFolder run = read_run(a.folder, a);
    std::vector<Chart> charts = figure(run, choice);
    if (!a.compare.empty()) {
      const RunFolder other = read_run(a.compare, a);
      lay_over(charts, figure(other, choice), label_of(a, 0), label_of(a, 1));
    }
    const std::string bytes = picture(target, charts, {heading(a, run), a.width, a.height});
    if (bytes.empty()) throw InputError("error: there is nothing to draw: no value is finite");
    write_text_file(target, bytes);
  } catch (const nlohmann::json::exception& problem) {
    throw InputError(fmt::format("error: '{}' is not a summary of this nsframe: {}", (a.folder / "summary.json").string(), problem.what()));
  }
  fmt::print("{}\n", target.string());
  return done;
}

std::string known_quantities() {
  std::string names;
  for (const std::string& name : figure_quantities()) names += " " + name;
  return names;
}

}  // namespace

void add_plot_command(CLI::App& program, std::function<int()>& command) {
  CLI::App* c = program.add_subcommand("plot", "figures of a run as SVG or PNG: histories, gaps, spectra, energy, hysteresis, ...");
  auto a = std::make_shared<PlotArguments>();
  c->add_option("folder", a->folder, "folder that nsframe run has written")->required();
  c->add_option("--quantity", a->quantities, "what is drawn, separated by commas, one below the other (default: displacement and impulse)")
      ->delimiter(',')
      ->allow_extra_args(false);
  c->add_option("--nodes", a->nodes, "structure.node,...: histories of these (default: floors)")->delimiter(',')->allow_extra_args(false);
  c->add_option("--floors", a->floors, "structure.story,...: of the floors above these stories (default: roof and others)")
      ->delimiter(',')
      ->allow_extra_args(false);
  c->add_option("--sections", a->sections, "element or element:point,...: of hysteresis (default: the one with the largest range)")
      ->delimiter(',')
      ->allow_extra_args(false);
  c->add_option("--direction", a->direction, "x, y or z; of hysteresis the local axis (default: that of the largest values)");
  c->add_option("--from", a->from, "begin, as \"2.5 s\" (default: of the run)");
  c->add_option("--to", a->to, "end");
  c->add_option("--compare", a->compare, "folder of a second run, drawn with dashes");
  c->add_option("--labels", a->labels, "of the two runs, separated by a comma (default: names of the folders)")->delimiter(',')->expected(2);
  c->add_option("--title", a->title, "above all (default: of the scene, with scheme and step)");
  c->add_option("-o,--output", a->output, "file that ends in .svg or .png (default: plot.svg in the folder)");
  c->add_option("--width", a->width, "in pixels (default: 1000)")->check(CLI::Range(least_pixels, most_pixels));
  c->add_option("--height", a->height, "in pixels (default: by the number of charts)")->check(CLI::Range(least_pixels, most_pixels));
  c->footer("Quantities:" + known_quantities() + "\nHistories are drawn as far as the run kept them: history and floor_spectra in "
            "[output] of the scene.\nTriangles on the time axis: poundings.");
  c->callback([a, &command] { command = [a] { return plot(*a); }; });
}

}  // namespace nsframe::app
