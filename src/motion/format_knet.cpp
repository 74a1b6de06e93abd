// K-NET and KiK-net ASCII of NIED: 17 lines of header with 18-character keys, then counts, eight a line. Acceleration
// in gal = count times "Scale Factor  3920(gal)/6182761". Counts carry the offset of the instrument: their mean is
// taken off, as it was for the "Max. Acc." of the header, which must come out again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

constexpr int header_lines = 17;
constexpr std::size_t key_width = 18;

struct KnetHeader {
  double frequency = 0, duration = 0, scale = 0, peak = 0;  // [Hz], [s], [gal], [gal]
  std::string station, direction;
};

double scale_factor(std::string_view text, int line) {
  const auto numerator = leading_number(text);
  const std::size_t slash = text.find('/');
  const auto denominator = slash == std::string_view::npos ? std::nullopt : leading_number(text.substr(slash + 1));
  if (!numerator || !denominator || text.find("(gal)") == std::string_view::npos || !(*numerator > 0) ||
      !(*denominator > 0))
    throw RecordFault{line, 1, "the scale factor must be written as 3920(gal)/6182761"};
  return *numerator / *denominator;
}

KnetHeader read_header(LineReader& lines) {
  KnetHeader out;
  while (lines.number() < header_lines) {
    if (!lines.next())
      throw RecordFault{lines.place(), 1, fmt::format("ends within the {} lines of the header", header_lines)};
    const std::string_view line = lines.line();
    const std::string_view key = trimmed(line.substr(0, key_width)),
                           value = trimmed(line.size() > key_width ? line.substr(key_width) : "");
    const auto number_of = [&] {
      const auto number = leading_number(value);
      if (!number)
        throw RecordFault{lines.number(), static_cast<int>(key_width) + 1, fmt::format("'{}' has no number", key)};
      return *number;
    };
    if (key == "Station Code") out.station = value;
    if (key == "Dir.") out.direction = value;
    if (key == "Sampling Freq(Hz)")
      out.frequency = positive_step(number_of(), "the sampling frequency", lines.number());
    if (key == "Duration Time(s)") out.duration = positive_step(number_of(), "the duration", lines.number());
    if (key == "Scale Factor") out.scale = scale_factor(value, lines.number());
    if (key == "Max. Acc. (gal)") out.peak = number_of();
  }
  if (out.frequency == 0) throw RecordFault{lines.number(), 1, "the header has no 'Sampling Freq(Hz)'"};
  if (out.scale == 0) throw RecordFault{lines.number(), 1, "the header has no 'Scale Factor' in gal"};
  if (out.duration == 0) throw RecordFault{lines.number(), 1, "the header has no 'Duration Time(s)'"};
  return out;
}

RecordFormat::Reading read_knet(LineReader& lines, const ReadOptions& options) {
  if (options.dt) throw RecordFault{0, 0, "a K-NET record says its own step, dt must not be given"};
  const KnetHeader header = read_header(lines);
  RecordFormat::Reading out{{}, AccelerationUnit::centimetres};
  Record& record = out.record;
  record.dt = 1 / header.frequency;
  record.description = header.station + ", " + header.direction;
  const std::size_t count =
      sample_count(std::round(header.frequency * header.duration), "frequency times duration", lines.number());
  read_numbers(lines, count, 0, record.acceleration);
  while (lines.next())
    if (!trimmed(lines.line()).empty())
      throw RecordFault{lines.number(), 1, fmt::format("more values than the {} that the header announces", count)};
  const double mean =
      std::accumulate(record.acceleration.begin(), record.acceleration.end(), 0.0) / static_cast<double>(count);
  double peak = 0;
  for (double& a : record.acceleration) {
    a = (a - mean) * header.scale;
    peak = std::max(peak, std::abs(a));
  }
  record.notes.push_back(fmt::format("mean of {:.4g} cm/s2 taken off", mean * header.scale));
  // printed with few digits, and the offset that NIED takes off may be that of the time before the shaking
  if (header.peak > 0 && std::abs(peak - header.peak) > 0.02 * header.peak + std::abs(mean) * header.scale * 0.02 + 0.1)
    record.notes.push_back(fmt::format("peak of {:.4g} cm/s2, the header says {:.4g}", peak, header.peak));
  return out;
}

}  // namespace

const RecordFormat knet_ascii{"k-net", "K-NET ASCII",
                              [](const FileBeginning& file) { return file.text.starts_with("ORIGIN TIME"); }, read_knet};

}  // namespace nsframe
