#include "app/motion_input.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/errors.hpp"

namespace nsframe::app {

void add_record_options(CLI::App& command, RecordArguments& a, int least, int most) {
  command
      .add_option("record", a.files,
                  most > 1 ? "record files (AT2, COSMOS, CSMIP V2, ESM, K-NET, text, CSV)"
                           : "record file (AT2, COSMOS, CSMIP V2, ESM, K-NET, text, CSV)")
      ->required()
      ->expected(least, most);
  command.add_option("--unit", a.unit, "of a file that doesn't say: g, m/s2, cm/s2, mm/s2, in/s2, ft/s2");
  command.add_option("--dt", a.dt, "step of a one-column file, as \"5 ms\"");
  command.add_option("--channel", a.channel, "of a COSMOS or CSMIP file with several")->check(CLI::Range(1, 10000));
  command.add_option("--format", a.format, "at2, k-net, esm, cosmos, csmip or text (default: found from the file)");
}

Record load_record(const RecordArguments& a, const std::string& file) {
  ReadOptions options;
  options.format = a.format;
  if (!a.dt.empty()) options.dt = quantity("--dt", a.dt, dimension::time);
  if (options.dt && !(*options.dt > 0)) throw InputError(fmt::format("error: --dt = \"{}\", must be positive", a.dt));
  if (a.channel > 0) options.channel = a.channel;
  if (!a.unit.empty()) {
    options.unit = parse_acceleration_unit(a.unit);
    if (!options.unit)
      throw InputError(
          fmt::format("error: --unit {} is no unit of acceleration; known: {}", a.unit, known_acceleration_units()));
  }
  return read_record(file, options);
}

void add_target_options(CLI::App& command, TargetArguments& a, bool required) {
  CLI::Option* target = command.add_option(
      "--target", a.target, "spectrum: eurocode8, asce7, or a table file of period [s] and pseudo-acceleration");
  if (required) target->required();
  for (CLI::Option* option :
       {command.add_option("--type", a.type, "of Eurocode 8: 1 or 2 (default: 1)")->check(CLI::Range(1, 2)),
        command.add_option("--ground", a.ground, "of Eurocode 8: A to E (default: A)"),
        command.add_option("--ag", a.ag, "of Eurocode 8, as \"0.3 g\""),
        command.add_option("--sds", a.sds, "of ASCE 7, as \"1.0 g\""),
        command.add_option("--sd1", a.sd1, "of ASCE 7, as \"0.6 g\""),
        command.add_option("--tl", a.tl, "of ASCE 7, long-period transition (default: 8 s)"),
        command.add_option("--target-unit", a.unit, "of a table that doesn't say its unit")})
    option->needs(target);
  command.add_option("--damping", a.damping, "ratio (default: 5 %)");
}

namespace {

// Options of another target than the one given would be without effect.
void refuse(const TargetArguments& a, std::initializer_list<std::pair<const char*, bool>> options) {
  for (const auto& [option, given] : options)
    if (given) throw InputError(fmt::format("error: {} does not belong to the target {}", option, a.target));
}

}  // namespace

TargetSpectrum load_target(const TargetArguments& a) {
  const auto needed = [](const char* option, const std::string& text) {
    if (text.empty()) throw InputError(fmt::format("error: the target spectrum needs {}, as \"0.3 g\"", option));
    return quantity(option, text, dimension::acceleration);
  };
  const double damping = ratio("--damping", a.damping);
  if (a.target == "eurocode8") {
    refuse(a, {{"--sds", !a.sds.empty()},
               {"--sd1", !a.sd1.empty()},
               {"--tl", !a.tl.empty()},
               {"--target-unit", !a.unit.empty()}});
    if (a.ground.size() > 1) throw InputError(fmt::format("error: --ground {}: must be A, B, C, D or E", a.ground));
    return eurocode8(
        {a.type == 0 ? 1 : a.type, a.ground.empty() ? 'A' : a.ground.front(), needed("--ag", a.ag), damping});
  }
  if (a.target == "asce7") {
    if (damping != 0.05) throw InputError("error: the spectrum of ASCE 7 is for 5 % damping");
    refuse(a, {{"--type", a.type != 0},
               {"--ground", !a.ground.empty()},
               {"--ag", !a.ag.empty()},
               {"--target-unit", !a.unit.empty()}});
    return asce7(
        {needed("--sds", a.sds), needed("--sd1", a.sd1), a.tl.empty() ? 8 : quantity("--tl", a.tl, dimension::time)});
  }
  refuse(a, {{"--type", a.type != 0},
             {"--ground", !a.ground.empty()},
             {"--ag", !a.ag.empty()},
             {"--sds", !a.sds.empty()},
             {"--sd1", !a.sd1.empty()},
             {"--tl", !a.tl.empty()}});
  std::optional<AccelerationUnit> unit;
  if (!a.unit.empty()) {
    unit = parse_acceleration_unit(a.unit);
    if (!unit)
      throw InputError(fmt::format("error: --target-unit {} is no unit of acceleration; known: {}", a.unit,
                                   known_acceleration_units()));
  }
  try {
    return target_table(a.target, unit, damping);
  } catch (const IoError&) {
    throw InputError(fmt::format("error: --target {}: neither eurocode8 nor asce7{}, nor a file that can be read",
                                 a.target,
                                 nearest(a.target, {"eurocode8", "asce7"}).empty()
                                     ? ""
                                     : " (did you mean " + nearest(a.target, {"eurocode8", "asce7"}) + "?)"));
  }
}

double quantity(const std::string& option, const std::string& text, const Dimension& wanted, double bare) {
  try {
    const Quantity read = parse_quantity(text);
    return read.dimension == dimension::none ? read.value * bare : parse_quantity(text, wanted);
  } catch (const QuantityError& problem) {
    throw InputError(fmt::format("error: {} = \"{}\"{}", option, text, problem.what()));
  }
}

double ratio(const std::string& option, const std::string& text) {
  const double value = quantity(option, text, dimension::none);
  if (!(value >= 0 && value < 1))
    throw InputError(fmt::format("error: {} = {}, must lie in [0, 1); percent are written as \"5 %\"", option, text));
  return value;
}

std::pair<double, double> period_range(const std::string& option, const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw InputError(fmt::format("error: {} {}: must be two periods, as 0.1,2", option, text));
  const double shortest = quantity(option, text.substr(0, comma), dimension::time),
               longest = quantity(option, text.substr(comma + 1), dimension::time);
  if (!(shortest > 0 && longest > shortest))
    throw InputError(fmt::format("error: {} {}: periods must be positive and rise", option, text));
  return {shortest, longest};
}

}  // namespace nsframe::app
