#include "motion/formats.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>

namespace nsframe {

namespace {

// In the order in which a file is tried; the last takes what no other recognises.
constexpr const RecordFormat* formats[]{&peer_at2, &knet_ascii, &esm_dyna, &cosmos_v2, &csmip_v2, &plain_text};

FileBeginning beginning_of(const std::filesystem::path& file, std::ifstream& stream) {
  std::array<char, 8192> head{};
  stream.read(head.data(), head.size());
  FileBeginning out{upper(file.extension().string()), upper({head.data(), static_cast<std::size_t>(stream.gcount())})};
  stream.clear();
  stream.seekg(0);
  return out;
}

const RecordFormat& format_of(const FileBeginning& beginning, const std::string& name) {
  for (const RecordFormat* format : formats)
    if (name.empty() ? format->recognises(beginning) : name == format->name) return *format;
  throw RecordFault{0, 0, fmt::format("format '{}' is not known{}", name, did_you_mean(name, record_formats()))};
}

Record read(const std::filesystem::path& file, std::ifstream& stream, const ReadOptions& options) {
  const RecordFormat& format = format_of(beginning_of(file, stream), options.format);
  LineReader lines(stream);
  auto [record, unit] = format.read(lines, options);
  const std::string name = file.filename().string();
  if (unit && options.unit && *unit != *options.unit)
    throw RecordFault{
        0, 0,
        fmt::format("'{}' ({}) is in units of {}, not {}", name, format.text, name_of(*unit), name_of(*options.unit))};
  if (!unit && !options.unit)
    throw RecordFault{
        0, 0,
        fmt::format("'{}' ({}) doesn't say its unit, which must be given: unit = \"...\" in a scene, --unit on the "
                    "command line; one of {}",
                    name, format.text, known_acceleration_units())};
  if (record.dt == 0 && !options.dt)
    throw RecordFault{
        0, 0,
        fmt::format("'{}' ({}) doesn't say its step, which must be given: dt = \"...\" in a scene, --dt on the command "
                    "line",
                    name, format.text)};
  if (record.dt == 0) record.dt = *options.dt;
  if (options.dt && std::abs(*options.dt - record.dt) > 0.01 * record.dt)
    throw RecordFault{0, 0, fmt::format("'{}' has a step of {} s, not dt = {} s", name, record.dt, *options.dt)};
  const double factor = in_si(unit ? *unit : *options.unit);
  for (double& a : record.acceleration) a *= factor;
  record.format = format.name;
  return record;
}

}  // namespace

RecordError::RecordError(Location place, const std::string& message)
    : InputError([&] {
        Diagnostics one;
        one.error(place, message);
        return one.messages().front();
      }()),
      at(std::move(place)),
      text(message) {}

std::vector<std::string> record_formats() {
  std::vector<std::string> names;
  for (const RecordFormat* format : formats) names.emplace_back(format->name);
  return names;
}

Record read_record(const std::filesystem::path& file, const ReadOptions& options) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream || !std::filesystem::is_regular_file(file, ignored))
    throw IoError(fmt::format("error: cannot open the record '{}'", file.string()));
  try {
    return read(file, stream, options);
  } catch (const RecordFault& fault) {
    throw RecordError(fault.line > 0 ? Location{file.string(), fault.line, fault.column} : Location{}, fault.text);
  }
}

bool ChannelChoice::offer(const std::string& name, int line) {
  ++offered_;
  if (wanted_) return offered_ == *wanted_;
  if (offered_ > 1)
    throw RecordFault{
        line, 1,
        fmt::format("a second channel begins here ({}; the first: {}): say which to read, channel = 1, 2, ... in a "
                    "scene, --channel on the command line",
                    name, first_)};
  first_ = name;
  return true;
}

void ChannelChoice::finish(int line) const {
  if (wanted_ && *wanted_ > offered_)
    throw RecordFault{
        line, 1,
        fmt::format("holds {} channel{} of acceleration, not {}", offered_, offered_ == 1 ? "" : "s", *wanted_)};
  if (offered_ == 0) throw RecordFault{line, 1, "holds no accelerations"};
}

}  // namespace nsframe
