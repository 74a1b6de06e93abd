#include "app/motion.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands.hpp"
#include "app/motion_input.hpp"
#include "app/motion_measures.hpp"
#include "base/errors.hpp"
#include "motion/adjust.hpp"
#include "motion/artificial.hpp"
#include "motion/history.hpp"
#include "motion/write_at2.hpp"
#include "output/files.hpp"
#include "plot/picture.hpp"

namespace nsframe::app {

namespace {

struct MotionArguments {
  RecordArguments record;
  TargetArguments target;
  std::filesystem::path output;
  std::string pga, over, at_least, from, to, angle, period;
  std::string duration = "20 s", dt = "5 ms", rise = "2 s", level = "10 s", tolerance = "8 %";
  std::optional<double> factor;
  double decay = 0.3;  // [1/s]
  int degree = 1, order = 4;
  std::uint32_t seed = 1;
  bool json = false, keep_pads = false, rest = false;
};

std::string csv_text(const Record& record) {
  std::string out = "time [s],acceleration [m/s2]\n";
  for (std::size_t i = 0; i < record.acceleration.size(); ++i)
    fmt::format_to(std::back_inserter(out), "{:.10g},{:.10g}\n", record.dt * static_cast<double>(i),
                   record.acceleration[i]);
  return out;
}

int info(const MotionArguments& a) {
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& file : a.record.files) {
    const Record record = load_record(a.record, file);
    if (a.json) {
      all.push_back(measures_json(record, file));
      continue;
    }
    fmt::print("{} ({}){}{}\n", file, record.format, record.description.empty() ? "" : ": ", record.description);
    for (const std::string& note : record.notes) fmt::print("  note: {}\n", note);
    print_measures(record);
  }
  if (a.json) fmt::print("{}\n", all.dump(2));
  return done;
}

// Writes by the extension of the output, and says what is in it.
int write(const MotionArguments& a, const Record& record, const std::string& what) {
  std::string extension = a.output.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".at2" && extension != ".csv")
    throw InputError(fmt::format("error: -o {}: must end in .at2 or .csv", a.output.string()));
  write_text_file(a.output, extension == ".csv" ? csv_text(record) : at2_text(record, "nsframe: " + what));
  fmt::print("{}: {}\n", a.output.string(), what);
  for (const std::string& note : record.notes) fmt::print("  note: {}\n", note);
  print_measures(record);
  return done;
}

Record only_record(const MotionArguments& a) { return load_record(a.record, a.record.files.front()); }

int scale(const MotionArguments& a) {
  if (!a.pga.empty() + a.factor.has_value() + !a.target.target.empty() != 1)
    throw InputError("error: give one of --pga, --factor and --target");
  Record record = only_record(a);
  const double peak = peak_of(record.acceleration, record.dt).value;
  if (peak == 0)
    throw InputError(fmt::format("error: '{}' is zero throughout and can't be scaled", a.record.files.front()));
  double factor = 1;
  std::string fit;
  if (a.factor) {
    factor = *a.factor;
  } else if (!a.pga.empty()) {
    factor = quantity("--pga", a.pga, dimension::acceleration) / peak;
    if (!(factor > 0)) throw InputError(fmt::format("error: --pga = \"{}\", must be positive", a.pga));
  } else {
    if (a.over.empty()) throw InputError("error: a target spectrum needs --over SHORTEST,LONGEST");
    const TargetSpectrum target = load_target(a.target);
    const auto [shortest, longest] = period_range("--over", a.over);
    const SpectralRatio r = spectral_ratio(record.acceleration, record.dt, target, shortest, longest);
    factor = a.at_least.empty() ? 1 / r.mean : quantity("--at-least", a.at_least, dimension::none) / r.least;
    if (!(factor > 0)) throw InputError(fmt::format("error: --at-least = \"{}\", must be positive", a.at_least));
    fit = fmt::format(" to {} from {:g} to {:g} s ({:.3f} of it at {:.3g} s to {:.3f} at {:.3g} s)", target.name,
                      shortest, longest, factor * r.least, r.least_at, factor * r.largest, r.largest_at);
  }
  for (double& value : record.acceleration) value *= factor;
  return write(a, record, fmt::format("{} scaled by {:.6g}{}", a.record.files.front(), factor, fit));
}

int baseline(const MotionArguments& a) {
  Record record = only_record(a);
  if (record.acceleration.size() < static_cast<std::size_t>(a.degree) + 4)
    throw InputError("error: the record is too short for its baseline");
  record.acceleration = baseline_corrected(record.acceleration, record.dt, a.degree);
  if (a.rest) record.acceleration = brought_to_rest(record.acceleration, record.dt);
  return write(a, record,
               fmt::format("{} less a baseline of degree {}{}", a.record.files.front(), a.degree,
                           a.rest ? ", brought to rest" : ""));
}

int filter(const MotionArguments& a) {
  Record record = only_record(a);
  BandPass options;
  if (!a.from.empty()) options.from = quantity("--from", a.from, dimension::frequency);
  if (!a.to.empty()) options.to = quantity("--to", a.to, dimension::frequency);
  options.order = a.order;
  options.keep_pads = a.keep_pads;
  const std::size_t before = record.acceleration.size();
  try {
    Filtered filtered = band_passed(record.acceleration, record.dt, options);
    record.acceleration = std::move(filtered.acceleration);
    if (!a.keep_pads)
      record.notes.push_back(
          fmt::format("at the start the filtered motion has {:.3g} m/s and {:.3g} m, which a record from rest has not: "
                      "it drifts, unless "
                      "--keep-pads keeps what is before, or motion baseline --rest follows",
                      filtered.velocity, filtered.displacement));
    else
      record.notes.push_back(fmt::format("{} values more than the record; its start is at {:g} s",
                                         record.acceleration.size() - before, -filtered.begins));
  } catch (const std::invalid_argument& problem) {
    throw InputError(fmt::format("error: {}", problem.what()));
  }
  return write(a, record,
               fmt::format("{} filtered{}{}, Butterworth of order {} forwards and backwards", a.record.files.front(),
                           options.from > 0 ? fmt::format(" from {:g} Hz", options.from) : "",
                           options.to > 0 ? fmt::format(" to {:g} Hz", options.to) : "", options.order));
}

double angle_of(const std::string& text) {
  try {
    const Quantity read = parse_quantity(text);
    return read.dimension == dimension::none ? read.value * pi / 180 : parse_quantity(text, dimension::angle);
  } catch (const QuantityError& problem) {
    throw InputError(fmt::format("error: --angle = \"{}\"{}", text, problem.what()));
  }
}

int rotate(const MotionArguments& a) {
  Record first = load_record(a.record, a.record.files[0]);
  const Record second = load_record(a.record, a.record.files[1]);
  if (std::abs(first.dt - second.dt) > 1e-6 * first.dt)
    throw InputError(fmt::format("error: the components have steps of {:g} and {:g} s", first.dt, second.dt));
  const double radians = angle_of(a.angle);
  if (first.acceleration.size() != second.acceleration.size())
    first.notes.push_back(fmt::format("components of {} and {} values: the shorter goes on with zeros",
                                      first.acceleration.size(), second.acceleration.size()));
  first.acceleration = rotated(first.acceleration, second.acceleration, radians);
  return write(
      a, first,
      fmt::format("{} turned by {:g} degrees towards {}", a.record.files[0], radians * 180 / pi, a.record.files[1]));
}

int artificial(const MotionArguments& a) {
  if (a.period.empty() == a.over.empty()) throw InputError("error: give one of --period and --over");
  const TargetSpectrum target = load_target(a.target);
  ArtificialOptions options;
  if (a.period.empty()) {
    std::tie(options.shortest, options.longest) = period_range("--over", a.over);
  } else {
    const double period = quantity("--period", a.period, dimension::time);
    options.shortest = 0.2 * period;
    options.longest = 2 * period;
  }
  options.duration = quantity("--duration", a.duration, dimension::time);
  options.dt = quantity("--dt", a.dt, dimension::time);
  options.envelope = {quantity("--rise", a.rise, dimension::time), quantity("--level", a.level, dimension::time),
                      a.decay};
  options.tolerance = ratio("--tolerance", a.tolerance);
  options.seed = a.seed;
  const ArtificialMotion motion = artificial_motion(target, options);
  Record record;
  record.dt = options.dt;
  record.acceleration = motion.acceleration;
  record.description = fmt::format("artificial, seed {}, {}, damping {:g} %, periods {:g} to {:g} s", a.seed,
                                   target.name, 100 * target.damping, options.shortest, options.longest);
  return write(a, record,
               fmt::format("artificial motion for {}: within {:.1f} % of it from {:g} to {:g} s (phases drawn: {}, "
                           "iterations: {}, sines alone {:.1f} %)",
                           target.name, 100 * motion.misfit, options.shortest, options.longest, motion.draws,
                           motion.iterations, 100 * motion.misfit_of_sines));
}

int plot(const MotionArguments& a) {
  std::vector<Chart> charts{{"", "time, s", "acceleration, m/s²", false, false, {}, 160},
                            {"", "time, s", "velocity, m/s", false, false, {}, 160},
                            {"", "time, s", "displacement, m", false, false, {}, 160}};
  for (const std::string& file : a.record.files) {
    const Record record = load_record(a.record, file);
    const GroundHistory history = integrate(record.acceleration, record.dt);
    std::vector<double> time;
    for (std::size_t i = 0; i < record.acceleration.size(); ++i) time.push_back(record.dt * static_cast<double>(i));
    const std::string name = std::filesystem::path(file).filename().string();
    charts[0].curves.push_back({name, time, record.acceleration, false, false});
    charts[1].curves.push_back({name, time, history.velocity, false, false});
    charts[2].curves.push_back({name, time, history.displacement, false, false});
  }
  write_text_file(a.output, picture(a.output, charts));
  fmt::print("{}\n", a.output.string());
  return done;
}

using Action = int (*)(const MotionArguments&);

}  // namespace

void add_motion_command(CLI::App& program, std::function<int()>& command) {
  CLI::App* motion =
      program.add_subcommand("motion", "acceleration records: measures, scaling, filters, artificial motions");
  motion->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, Action action) {
    auto arguments = std::make_shared<MotionArguments>();
    CLI::App* c = motion->add_subcommand(name, text);
    c->callback([&command, arguments, action] { command = [arguments, action] { return action(*arguments); }; });
    return std::pair{c, arguments};
  };
  const auto add_output = [](CLI::App* c, MotionArguments& a, const char* what) {
    c->add_option("-o,--output", a.output, what)->required();
  };
  constexpr const char* record_file = "file to write, .at2 or .csv";
  {
    const auto [c, a] = add("info", "step, peaks, Arias intensity and significant durations", info);
    add_record_options(*c, a->record, 1, 1000);
    c->add_flag("--json", a->json, "print JSON");
  }
  {
    const auto [c, a] = add("convert", "write a record in another format",
                            [](const MotionArguments& x) { return write(x, only_record(x), x.record.files.front()); });
    add_record_options(*c, a->record, 1, 1);
    add_output(c, *a, record_file);
  }
  {
    const auto [c, a] = add("scale", "to a peak, by a factor, or to a target spectrum over a range of periods", scale);
    add_record_options(*c, a->record, 1, 1);
    add_output(c, *a, record_file);
    c->add_option("--pga", a->pga, "peak to scale to, as \"0.3 g\"");
    c->add_option("--factor", a->factor, "to multiply by");
    add_target_options(*c, a->target, false);
    c->add_option("--over", a->over,
                  "periods over which the geometric mean of the ratio to the target becomes 1, as 0.1,2");
    c->add_option("--at-least", a->at_least, "in place of the mean: the least ratio over the periods, as 0.9");
    for (const char* option : {"--over", "--at-least", "--damping"})
      c->get_option(option)->needs(c->get_option("--target"));
  }
  {
    const auto [c, a] = add("baseline", "take a polynomial from the acceleration", baseline);
    add_record_options(*c, a->record, 1, 1);
    add_output(c, *a, record_file);
    c->add_option("--degree", a->degree, "of the polynomial (default: 1)")->check(CLI::Range(0, 6));
    c->add_flag("--rest", a->rest, "then bring velocity and displacement to zero at the end");
  }
  {
    const auto [c, a] = add("filter", "Butterworth high-pass, low-pass or band-pass without shift of phase", filter);
    add_record_options(*c, a->record, 1, 1);
    add_output(c, *a, record_file);
    c->add_option("--from", a->from, "corner of the high-pass, as \"0.1 Hz\"");
    c->add_option("--to", a->to, "corner of the low-pass, as \"25 Hz\"");
    c->add_option("--order", a->order, "of each filter, which runs forwards and backwards (default: 4)")
        ->check(CLI::Range(1, 10));
    c->add_flag("--keep-pads", a->keep_pads, "keep what the filter brings before and after the record");
  }
  {
    const auto [c, a] = add("rotate", "component along a direction between two horizontal ones", rotate);
    add_record_options(*c, a->record, 2, 2);
    add_output(c, *a, record_file);
    c->add_option("--angle", a->angle, "from the first towards the second, degrees")->required();
  }
  {
    const auto [c, a] = add("artificial", "motion whose spectrum matches a target", artificial);
    add_output(c, *a, record_file);
    add_target_options(*c, a->target, true);
    c->add_option("--period", a->period, "of the structure: matches from 0.2 to 2 times it");
    c->add_option("--over", a->over, "periods to match, as 0.1,1");
    c->add_option("--duration", a->duration, "(default: 20 s)");
    c->add_option("--dt", a->dt, "step, at most 1/8 of the shortest period (default: 5 ms)");
    c->add_option("--rise", a->rise, "of the envelope (default: 2 s)");
    c->add_option("--level", a->level, "length of its level part (default: 10 s)");
    c->add_option("--decay", a->decay, "rate of its fall, 1/s (default: 0.3)");
    c->add_option("--seed", a->seed, "of the random phases (default: 1)");
    c->add_option("--tolerance", a->tolerance, "largest difference from the target (default: 8 %)");
  }
  {
    const auto [c, a] = add("plot", "acceleration, velocity and displacement as SVG or PNG", plot);
    add_record_options(*c, a->record, 1, 7);
    add_output(c, *a, "file to write, .svg or .png");
  }
}

}  // namespace nsframe::app
