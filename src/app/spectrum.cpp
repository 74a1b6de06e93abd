// nsframe spectrum: response spectra of one record or of two components.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/motion.hpp"
#include "app/motion_input.hpp"
#include "base/errors.hpp"
#include "output/files.hpp"
#include "output/read_floor_spectra.hpp"
#include "spectra/oscillators.hpp"
#include "spectra/spectrum.hpp"
#include "plot/chart.hpp"

namespace nsframe::app {

namespace {

struct SpectrumArguments {
  RecordArguments record;
  TargetArguments target;
  std::string range = "0.02,10", at, floor;
  int count = 200;
  std::filesystem::path output;
  bool json = false, at_samples = false;
};

struct Series {
  std::string name;                  // "RotD50"
  std::vector<double> displacement;  // [m], by period
};

struct Spectrum {
  std::string title;
  double damping = 0;
  std::vector<double> periods;  // [s]
  std::vector<Series> series;
};

std::vector<double> periods_of(const SpectrumArguments& a) {
  if (a.at.empty()) {
    const auto [shortest, longest] = period_range("--periods", a.range);
    return logarithmic_periods(shortest, longest, a.count);
  }
  std::vector<double> out;
  for (std::size_t begin = 0; begin <= a.at.size();) {
    const std::size_t end = std::min(a.at.find(',', begin), a.at.size());
    out.push_back(quantity("--at", a.at.substr(begin, end - begin), dimension::time));
    if (!(out.back() > 0)) throw InputError(fmt::format("error: --at {}: periods must be positive", a.at));
    begin = end + 1;
  }
  return out;
}

Spectrum of_records(const SpectrumArguments& a) {
  Record first = load_record(a.record, a.record.files.front());
  const auto name = [](const std::string& file) { return std::filesystem::path(file).filename().string(); };
  Spectrum out{name(a.record.files.front()), ratio("--damping", a.target.damping), periods_of(a), {}};
  const SpectrumOptions options{out.damping, a.at_samples};
  if (a.record.files.size() == 1) {
    out.series.push_back({"", spectral_displacement(first.acceleration, first.dt, out.periods, options)});
    return out;
  }
  Record second = load_record(a.record, a.record.files[1]);
  if (std::abs(first.dt - second.dt) > 1e-6 * first.dt)
    throw InputError(fmt::format("error: the components have steps of {:g} and {:g} s", first.dt, second.dt));
  const std::size_t count =
      std::max(first.acceleration.size(), second.acceleration.size());  // the shorter goes on with zeros
  first.acceleration.resize(count);
  second.acceleration.resize(count);
  const RotatedSpectrum r = rotated_spectrum(first.acceleration, second.acceleration, first.dt, out.periods, options);
  out.title += " and " + name(a.record.files[1]);
  out.series = {{"RotD50", r.rotd50}, {"RotD100", r.rotd100}, {"1", r.first}, {"2", r.second}};
  return out;
}

// Of the floors of a run: all nodes and directions that moved, or one node.
Spectrum of_floors(const SpectrumArguments& a) {
  const FloorSpectraTable table = read_floor_spectra(std::filesystem::path(a.record.files.front()) / "results.h5");
  Spectrum out{fmt::format("floors of {}", a.record.files.front()), table.damping, table.periods, {}};
  bool known = a.floor == "all";
  for (std::size_t node = 0; node < table.nodes.size(); ++node) {
    if (a.floor != "all" && a.floor != table.nodes[node]) continue;
    known = true;
    for (int direction = 0; direction < 3; ++direction) {
      const std::vector<double> values = table.along(node, direction);
      if (*std::max_element(values.begin(), values.end()) > 0)
        out.series.push_back({fmt::format("{} {}", table.nodes[node], "xyz"[direction]), values});
    }
  }
  if (!known)
    throw InputError(fmt::format("error: --floor: the run has no floor spectrum of '{}'{}", a.floor,
                                 did_you_mean(a.floor, table.nodes)));
  if (out.series.empty()) throw InputError(fmt::format("error: --floor {}: nothing moved there", a.floor));
  return out;
}

std::string column(const Series& series, const char* what, const char* unit) {
  return series.name.empty() ? fmt::format("{} [{}]", what, unit) : fmt::format("{} {} [{}]", series.name, what, unit);
}

std::string csv(const Spectrum& s) {
  std::string out = "period [s]";
  for (const Series& one : s.series)
    out += "," + column(one, "PSA", "m/s2") + "," + column(one, "PSV", "m/s") + "," + column(one, "SD", "m");
  out += '\n';
  for (std::size_t i = 0; i < s.periods.size(); ++i) {
    const double w = 2 * pi / s.periods[i];
    fmt::format_to(std::back_inserter(out), "{:.10g}", s.periods[i]);
    for (const Series& one : s.series)
      fmt::format_to(std::back_inserter(out), ",{:.8g},{:.8g},{:.8g}", w * w * one.displacement[i],
                     w * one.displacement[i], one.displacement[i]);
    out += '\n';
  }
  return out;
}

std::string json(const Spectrum& s) {
  nlohmann::json out{{"title", s.title},
                     {"damping", s.damping},
                     {"period", s.periods},
                     {"units", {{"psa", "m/s2"}, {"psv", "m/s"}, {"sd", "m"}}}};
  for (const Series& one : s.series)
    out["spectra"].push_back({{"name", one.name},
                              {"sd", one.displacement},
                              {"psv", pseudo_velocity(s.periods, one.displacement)},
                              {"psa", pseudo_acceleration(s.periods, one.displacement)}});
  return out.dump(2);
}

std::string svg(const Spectrum& s, const SpectrumArguments& a) {
  Chart chart;
  chart.title = fmt::format("{}, damping {:g} %", s.title, 100 * s.damping);
  chart.x_label = "period, s";
  chart.y_label = "pseudo-acceleration, m/s²";
  chart.log_x = chart.log_y = true;
  for (const Series& one : s.series)
    chart.curves.push_back({one.name, s.periods, pseudo_acceleration(s.periods, one.displacement), false, false});
  if (!a.target.target.empty()) {
    const TargetSpectrum target = load_target(a.target);
    Curve curve{target.name, {}, {}, false, true};
    for (const double period : s.periods) {
      if (period < target.shortest || period > target.longest) continue;
      curve.x.push_back(period);
      curve.y.push_back(target.acceleration(period));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart_svg({chart});
}

// One line a period; of many periods as many as fit on a screen.
void print_table(const Spectrum& s) {
  fmt::print("{}, damping {:g} %\n{:>10}", s.title, 100 * s.damping, "T [s]");
  const bool one = s.series.size() == 1;
  for (const Series& series : s.series) {
    fmt::print(" {:>16}", series.name.empty() ? "PSA [m/s2]" : "PSA " + series.name);
    if (one) fmt::print(" {:>12} {:>12}", "PSV [m/s]", "SD [m]");
  }
  fmt::print("\n");
  const std::size_t step = (s.periods.size() + 39) / 40;
  for (std::size_t i = 0; i < s.periods.size(); i += step) {
    const double w = 2 * pi / s.periods[i];
    fmt::print("{:>10.4g}", s.periods[i]);
    for (const Series& series : s.series) {
      fmt::print(" {:>16.5g}", w * w * series.displacement[i]);
      if (one) fmt::print(" {:>12.5g} {:>12.5g}", w * series.displacement[i], series.displacement[i]);
    }
    fmt::print("\n");
  }
  if (step > 1) fmt::print("one of {} of the {} periods; all of them with -o or --json\n", step, s.periods.size());
}

int spectrum(const SpectrumArguments& a) {
  if (!a.floor.empty() && a.record.files.size() != 1) throw InputError("error: --floor takes one folder of results");
  const Spectrum s = a.floor.empty() ? of_records(a) : of_floors(a);
  if (a.json) {
    fmt::print("{}\n", json(s));
  } else {
    print_table(s);
  }
  if (a.output.empty()) {
    if (!a.target.target.empty()) throw InputError("error: --target is drawn in the plot: give -o too");
    return done;
  }
  const std::string plot = svg(s, a);
  make_folder(a.output);
  write_text_file(a.output / "spectrum.csv", csv(s));
  write_text_file(a.output / "spectrum.json", json(s) + "\n");
  write_text_file(a.output / "spectrum.svg", plot);
  if (!a.json) fmt::print("spectrum.csv, spectrum.json, spectrum.svg in {}\n", a.output.string());
  return done;
}

}  // namespace

void add_spectrum_command(CLI::App& program, std::function<int()>& command) {
  CLI::App* c = program.add_subcommand(
      "spectrum", "response spectra of a record, RotD50 and RotD100 of two, floor spectra of a run");
  auto a = std::make_shared<SpectrumArguments>();
  add_record_options(*c, a->record, 1, 2);
  add_target_options(*c, a->target, false);
  c->add_option("--periods", a->range, "shortest and longest, evenly spaced in logarithm (default: 0.02,10)");
  c->add_option("--count", a->count, "of these (default: 200)")->check(CLI::Range(2, 100000));
  c->add_option("--at", a->at, "periods in place of a range, as 0.5,1,2");
  c->add_flag("--at-samples", a->at_samples,
              "peaks at the record's samples only, as most books (default: also between them and after the end)");
  c->add_option("--floor", a->floor, "the record is a folder of results: floor spectra of this node, or of all");
  c->add_option("-o,--output", a->output, "folder for spectrum.csv, spectrum.json, spectrum.svg");
  c->add_flag("--json", a->json, "print JSON");
  for (const char* option : {"--periods", "--count"}) c->get_option("--at")->excludes(c->get_option(option));
  for (const char* option :
       {"--periods", "--count", "--at", "--at-samples", "--unit", "--dt", "--channel", "--format", "--damping"})
    c->get_option("--floor")->excludes(c->get_option(option));
  c->callback([&command, a] { command = [a] { return spectrum(*a); }; });
}

}  // namespace nsframe::app
