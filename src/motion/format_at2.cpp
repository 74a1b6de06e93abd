// PEER AT2: some lines of text, one of them with the number of values and the step ("NPTS=  1559, DT=   .0200 SEC", or
// in older files "1559  .0200  NPTS, DT"), then the values in units of g, row by row.
#include <fmt/format.h>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

constexpr int max_header_lines = 20;

struct At2Header {
  std::size_t count = 0;
  double dt = 0;  // [s]
};

At2Header parse_header(const std::string& text, int line) {
  const std::string upper_text = upper(text);
  const auto behind = [&](std::string_view key) {
    const auto value = value_behind(upper_text, key);
    return value ? leading_number(*value) : std::nullopt;
  };
  std::optional<double> count = behind("NPTS"), dt = behind("DT");
  if (!count && !dt) {
    const std::vector<Token> parts = tokens(upper_text);
    if (parts.size() >= 2) {
      count = leading_number(parts[0].text);
      dt = leading_number(parts[1].text);
    }
  }
  if (!count || !dt) throw RecordFault{line, 1, "the header line with NPTS has no number of values and step"};
  return {sample_count(*count, "NPTS", line), positive_step(*dt, "DT", line)};
}

void check_header_text(const std::string& line, int number) {
  const std::string text = upper(line);
  for (const char* other : {"VELOCITY TIME", "DISPLACEMENT TIME"})
    if (text.find(other) != std::string::npos) throw RecordFault{number, 1, "is not an acceleration record"};
  for (const char* other : {"CM/S", "M/S/S", "M/S2", "M/SEC", "GAL"})
    if (text.find("UNITS") != std::string::npos && text.find(other) != std::string::npos)
      throw RecordFault{number, 1, "an AT2 record is in units of g; give a plain text file with its unit instead"};
}

RecordFormat::Reading read_at2(LineReader& lines, const ReadOptions& options) {
  if (options.dt) throw RecordFault{0, 0, "an AT2 record says its own step, dt must not be given"};
  std::optional<At2Header> header;
  RecordFormat::Reading out{{}, AccelerationUnit::g};
  while (!header && lines.number() < max_header_lines && lines.next()) {
    if (upper(lines.line()).find("NPTS") != std::string::npos) {
      header = parse_header(lines.line(), lines.number());
      continue;
    }
    check_header_text(lines.line(), lines.number());
    if (lines.number() <= 2 && !trimmed(lines.line()).empty())
      out.record.description += (out.record.description.empty() ? "" : "; ") + std::string(trimmed(lines.line()));
  }
  if (!header) throw RecordFault{lines.place(), 1, "has no header line with NPTS and DT"};
  out.record.dt = header->dt;
  std::vector<double>& values = out.record.acceleration;
  values.reserve(std::min<std::size_t>(header->count, 65536));
  while (lines.next()) {
    for (const Token& token : tokens(lines.line())) {
      if (values.size() == header->count)
        throw RecordFault{lines.number(), token.column, fmt::format("more values than NPTS = {}", header->count)};
      values.push_back(number(token, lines.number()));
    }
  }
  if (values.size() < header->count)
    throw RecordFault{lines.number(), 1,
                      fmt::format("ends after {} of NPTS = {} values", values.size(), header->count)};
  return out;
}

}  // namespace

const RecordFormat peer_at2{
    "at2", "PEER AT2",
    [](const FileBeginning& file) { return file.extension == ".AT2" || file.text.find("NPTS") != std::string::npos; },
    read_at2};

}  // namespace nsframe
