// ESM and ITACA (DYNA 1.2): lines "KEY: VALUE", among them SAMPLING_INTERVAL_S, NDATA, UNITS and DATA_TYPE, then one
// value a line.
#include <fmt/format.h>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

struct EsmHeader {
  std::optional<double> dt;  // [s]
  std::optional<std::size_t> count;
  std::string event, station, stream;
  RecordFormat::Reading reading{};
};

double number_of(std::string_view value, std::string_view key, int line) {
  const auto number = leading_number(value);
  if (!number) throw RecordFault{line, 1, fmt::format("'{}' has no number", key)};
  return *number;
}

// True for a line of the header.
bool read_key(std::string_view line, int number, EsmHeader& header) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return false;
  const std::string_view key = trimmed(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
  if (key == "SAMPLING_INTERVAL_S")
    header.dt = positive_step(number_of(value, key, number), "SAMPLING_INTERVAL_S", number);
  if (key == "NDATA") header.count = sample_count(number_of(value, key, number), "NDATA", number);
  if (key == "EVENT_NAME") header.event = value;
  if (key == "STATION_CODE") header.station = value;
  if (key == "STREAM") header.stream = value;
  if (key == "DATA_TYPE" && value.find("ACCELERATION") == std::string_view::npos)
    throw RecordFault{number, 1, fmt::format("is not an acceleration record: DATA_TYPE is {}", value)};
  if (key == "UNITS") {
    header.reading.unit = parse_acceleration_unit(value);
    if (!header.reading.unit)
      throw RecordFault{number, 1,
                        fmt::format("'{}' is no unit of acceleration; known: {}", value, known_acceleration_units())};
  }
  return true;
}

RecordFormat::Reading read_esm(LineReader& lines, const ReadOptions& options) {
  if (options.dt) throw RecordFault{0, 0, "an ESM record says its own step, dt must not be given"};
  EsmHeader header;
  while (lines.next()) {
    if (read_key(lines.line(), lines.number(), header)) continue;
    lines.hold();
    break;
  }
  if (!header.dt) throw RecordFault{lines.place(), 1, "the header has no SAMPLING_INTERVAL_S"};
  if (!header.count) throw RecordFault{lines.place(), 1, "the header has no NDATA"};
  Record& record = header.reading.record;
  record.dt = *header.dt;
  for (const std::string& part : {header.event, header.station, header.stream})
    if (!part.empty()) record.description += (record.description.empty() ? "" : ", ") + part;
  read_numbers(lines, *header.count, 0, record.acceleration);
  while (lines.next())
    if (!trimmed(lines.line()).empty())
      throw RecordFault{lines.number(), 1, fmt::format("more values than NDATA = {}", *header.count)};
  return header.reading;
}

}  // namespace

const RecordFormat esm_dyna{"esm", "ESM",
                            [](const FileBeginning& file) {
                              return file.text.starts_with("EVENT_NAME:") ||
                                     file.text.find("SAMPLING_INTERVAL_S:") != std::string::npos;
                            },
                            read_esm};

}  // namespace nsframe
