// COSMOS strong-motion format 1.20, volume 1 and 2 (COSMOS 2001): for each channel and quantity, lines of text, integer
// and real headers that announce their own numbers of values and lines, comments, then
//   "4096 acceleration pts, approx  20 secs, units=cm/sec2 (04),Format=(8F10.5)"
// and values of that width, which may touch. Real header 62 is the sampling interval in ms, 34 the same in s.
#include <fmt/format.h>

#include <cmath>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

constexpr std::size_t step_in_ms = 61, step_in_s = 33;

// "100 Real-header values follow on 17 lines, Format = (6F13.6)": number of values, or nothing.
std::optional<double> announced(const std::string& line, std::string_view what) {
  return upper(line).find(what) == std::string::npos ? std::nullopt : leading_number(line);
}

struct DataLine {
  std::size_t count;
  int width;
  std::string unit;
  bool acceleration;
};

std::optional<DataLine> data_line(const std::string& line, int number) {
  const std::string text = upper(line);
  const std::size_t points = text.find(" PTS"), units = text.find("UNITS");
  if (points == std::string::npos || units == std::string::npos || !leading_number(text)) return std::nullopt;
  DataLine out;
  out.count = sample_count(*leading_number(text), "number of points", number);
  out.acceleration = text.find("ACC") < points;
  out.width = format_width(std::string_view(line).substr(units));
  if (out.width == 0) throw RecordFault{number, 1, "has no format such as (8F10.5) of its values"};
  const std::string_view value = value_behind(std::string_view(line).substr(units), line.substr(units, 5)).value_or("");
  out.unit = trimmed(value.substr(0, value.find_first_of(",(")));
  return out;
}

double step_of(const std::vector<double>& real, int line) {
  const auto valid = [&](std::size_t i) { return i < real.size() && real[i] > 0; };  // -999: unknown
  if (!valid(step_in_ms) && !valid(step_in_s))
    throw RecordFault{line, 1, "real headers 34 and 62 don't give the sampling interval"};
  if (!valid(step_in_ms)) return real[step_in_s];
  const double dt = 1e-3 * real[step_in_ms];
  if (valid(step_in_s) && std::abs(real[step_in_s] - dt) > 1e-4 * dt)
    throw RecordFault{
        line, 1,
        fmt::format("two sampling intervals: {} s in real header 34, {} ms in 62", real[step_in_s], real[step_in_ms])};
  return dt;
}

RecordFormat::Reading read_cosmos(LineReader& lines, const ReadOptions& options) {
  if (options.dt) throw RecordFault{0, 0, "a COSMOS record says its own step, dt must not be given"};
  RecordFormat::Reading out;
  ChannelChoice choice(options);
  std::string name;
  std::vector<double> real;
  while (lines.next()) {
    const std::string& line = lines.line();
    if (upper(line).find("STA CHAN") != std::string::npos) name = trimmed(line);
    if (const auto count = announced(line, "REAL-HEADER VALUES FOLLOW")) {
      real.clear();
      read_numbers(lines, sample_count(*count, "number of real headers", lines.number()), format_width(line), real);
      continue;
    }
    const int at = lines.number();
    const auto data = data_line(line, at);
    if (!data) continue;
    std::vector<double> values;
    read_numbers(lines, data->count, data->width, values);
    if (!data->acceleration || !choice.offer(name, at)) continue;
    out.unit = parse_acceleration_unit(data->unit);
    if (!out.unit)
      throw RecordFault{
          at, 1, fmt::format("'{}' is no unit of acceleration; known: {}", data->unit, known_acceleration_units())};
    out.record.dt = step_of(real, at);
    out.record.acceleration = std::move(values);
    out.record.description = name;
  }
  choice.finish(lines.place());
  return out;
}

}  // namespace

const RecordFormat cosmos_v2{"cosmos", "COSMOS",
                             [](const FileBeginning& file) {
                               return file.text.find("-HEADER VALUES FOLLOW ON") != std::string::npos ||
                                      file.text.find("(FORMAT V01.") != std::string::npos;
                             },
                             read_cosmos};

}  // namespace nsframe
