// PEER AT2: some lines of text, one of them with the number of values and the step ("NPTS=  1559, DT=   .0200 SEC", or
// in older files "1559  .0200  NPTS, DT"), then the values in units of g, row by row. Plain text: one value a line, or
// time and acceleration; blank lines and lines that begin with # or % are skipped.
#include "scene/motion_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "scene/quantity.hpp"

namespace nsframe {

namespace {

constexpr int max_header_lines = 20;
constexpr std::size_t max_line_length = 65536;

struct RecordFault {
  int line, column;
  std::string text;
};

// Lines of a text file, one at a time, of bounded length.
class LineReader {
 public:
  explicit LineReader(std::ifstream& stream) : stream_(stream) {}

  bool next() {
    line_.clear();
    int c = stream_.get();
    if (c == std::char_traits<char>::eof()) return false;
    ++number_;
    for (; c != '\n' && c != std::char_traits<char>::eof(); c = stream_.get()) {
      if (c < 0x20 && c != '\t' && c != '\r' && c != '\f' && c != 0x1a)
        throw RecordFault{number_, static_cast<int>(line_.size()) + 1, "is a binary file, not text"};
      if (line_.size() == max_line_length)
        throw RecordFault{number_, 1, fmt::format("the line is longer than {} characters", max_line_length)};
      line_ += static_cast<char>(c);
    }
    return true;
  }
  const std::string& line() const { return line_; }
  int number() const { return number_; }

 private:
  std::ifstream& stream_;
  std::string line_;
  int number_ = 0;
};

struct Token {
  std::string_view text;
  int column;
};

std::vector<Token> tokens(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\f\x1a";
  std::vector<Token> out;
  std::size_t begin = line.find_first_not_of(blanks);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    out.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    begin = line.find_first_not_of(blanks, end);
  }
  return out;
}

double number(const Token& token, int line) {
  std::string_view text = token.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view shown = token.text.substr(0, 40);
  if (code == std::errc{} && end != text.data() + text.size() && *end == ',')
    throw RecordFault{line, token.column,
                      fmt::format("'{}': write decimals with a point, and blanks between columns", shown)};
  if (code != std::errc{} || end != text.data() + text.size())
    throw RecordFault{line, token.column, fmt::format("'{}' is not a number", shown)};
  if (!std::isfinite(value)) throw RecordFault{line, token.column, fmt::format("'{}' is not finite", shown)};
  return value;
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return out;
}

struct Header {
  std::size_t count = 0;
  double dt = 0;  // [s]
};

// The number behind `key` in "NPTS=  1559, DT=   .0200 SEC"; nothing when the key has no '='.
std::optional<double> value_behind(const std::string& line, std::string_view key) {
  std::size_t at = line.find(key);
  if (at == std::string::npos) return std::nullopt;
  at = line.find_first_not_of(" \t", at + key.size());
  if (at == std::string::npos || line[at] != '=') return std::nullopt;
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t end = std::min(line.find_first_of(" \t,;\r", at), line.size());
  double value = 0;
  const auto [stop, code] = std::from_chars(line.data() + at, line.data() + end, value);
  if (code != std::errc{} || stop == line.data() + at) return std::nullopt;
  return value;
}

Header parse_header(const std::string& text, int line) {
  const std::string upper_text = upper(text);
  std::optional<double> count = value_behind(upper_text, "NPTS"), dt = value_behind(upper_text, "DT");
  if (!count && !dt) {
    const std::vector<Token> parts = tokens(upper_text);
    const auto leading = [&](std::size_t i) -> std::optional<double> {
      double value = 0;
      if (i >= parts.size()) return std::nullopt;
      const auto [stop, code] =
          std::from_chars(parts[i].text.data(), parts[i].text.data() + parts[i].text.size(), value);
      return code == std::errc{} ? std::optional(value) : std::nullopt;
    };
    count = leading(0);
    dt = leading(1);
  }
  if (!count || !dt) throw RecordFault{line, 1, "the header line with NPTS has no number of values and step"};
  if (!(*count >= 1) || *count != std::floor(*count) || *count > double(max_record_samples))
    throw RecordFault{line, 1,
                      fmt::format("NPTS = {}, must be a whole number from 1 to {}", *count, max_record_samples)};
  if (!(*dt > 0) || !std::isfinite(*dt)) throw RecordFault{line, 1, fmt::format("DT = {}, must be positive", *dt)};
  return {static_cast<std::size_t>(*count), *dt};
}

void check_header_text(const std::string& line, int number) {
  const std::string text = upper(line);
  for (const char* other : {"VELOCITY TIME", "DISPLACEMENT TIME"})
    if (text.find(other) != std::string::npos) throw RecordFault{number, 1, "is not an acceleration record"};
  for (const char* other : {"CM/S", "M/S/S", "M/S2", "M/SEC", "GAL"})
    if (text.find("UNITS") != std::string::npos && text.find(other) != std::string::npos)
      throw RecordFault{number, 1, "an AT2 record is in units of g; give a plain text file with its unit instead"};
}

Record read_at2(LineReader& lines) {
  std::optional<Header> header;
  while (!header && lines.number() < max_header_lines && lines.next()) {
    if (upper(lines.line()).find("NPTS") != std::string::npos)
      header = parse_header(lines.line(), lines.number());
    else
      check_header_text(lines.line(), lines.number());
  }
  if (!header) throw RecordFault{std::max(lines.number(), 1), 1, "has no header line with NPTS and DT"};
  Record record{header->dt, {}};
  record.acceleration.reserve(std::min<std::size_t>(header->count, 65536));
  while (lines.next()) {
    for (const Token& token : tokens(lines.line())) {
      if (record.acceleration.size() == header->count)
        throw RecordFault{lines.number(), token.column, fmt::format("more values than NPTS = {}", header->count)};
      record.acceleration.push_back(number(token, lines.number()));
    }
  }
  if (record.acceleration.size() < header->count)
    throw RecordFault{lines.number(), 1,
                      fmt::format("ends after {} of NPTS = {} values", record.acceleration.size(), header->count)};
  return record;
}

// The step of equally spaced times from 0; times are printed with few digits, hence the hundredth of a step.
double equal_step(const std::vector<double>& time, const std::vector<int>& line) {
  if (time.size() < 2) throw RecordFault{line.front(), 1, "one row of time and acceleration gives no step"};
  if (time.front() != 0)
    throw RecordFault{line.front(), 1, fmt::format("the first time is {}, must be 0", time.front())};
  const double dt = time.back() / static_cast<double>(time.size() - 1);
  const double first_step = time[1];
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double step = time[i] - time[i - 1];
    if (!(step > 0)) throw RecordFault{line[i], 1, fmt::format("time {} is not after {}", time[i], time[i - 1])};
    if (std::abs(step - first_step) > 0.02 * first_step)
      throw RecordFault{line[i], 1,
                        fmt::format("the step to time {} is {}, not {} as before", time[i], step, first_step)};
  }
  return dt;
}

Record read_text(LineReader& lines, const std::optional<double>& dt) {
  Record record;
  std::vector<double> time;
  std::vector<int> line_of_time;
  std::size_t columns = 0;
  while (lines.next()) {
    const std::vector<Token> row = tokens(lines.line());
    if (row.empty() || row.front().text.front() == '#' || row.front().text.front() == '%') continue;
    if (columns == 0) columns = row.size();
    if (row.size() != columns || columns > 2)
      throw RecordFault{lines.number(), 1,
                        fmt::format("{} columns, must be {}", row.size(),
                                    columns > 2 ? "1 or 2" : std::to_string(columns) + " as before")};
    if (columns == 2) {
      time.push_back(number(row[0], lines.number()));
      line_of_time.push_back(lines.number());
    }
    record.acceleration.push_back(number(row.back(), lines.number()));
    if (record.acceleration.size() > max_record_samples)
      throw RecordFault{lines.number(), 1, fmt::format("more than {} values", max_record_samples)};
  }
  if (record.acceleration.empty()) throw RecordFault{std::max(lines.number(), 1), 1, "holds no values"};
  if (columns == 2) {
    record.dt = equal_step(time, line_of_time);
    if (dt && std::abs(*dt - record.dt) > 0.01 * record.dt)
      throw RecordFault{line_of_time[1], 1, fmt::format("the step is {} s, the scene says dt = {} s", record.dt, *dt)};
  }
  return record;
}

bool is_at2(const std::filesystem::path& file) {
  if (upper(file.extension().string()) == ".AT2") return true;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 2048> head{};
  stream.read(head.data(), head.size());
  return upper({head.data(), static_cast<std::size_t>(stream.gcount())}).find("NPTS") != std::string::npos;
}

}  // namespace

std::optional<Record> read_record(const MotionTable& motion, const std::filesystem::path& directory,
                                  Diagnostics& diagnostics) {
  if (motion.file.name.empty()) return std::nullopt;  // reported by the reader
  const std::filesystem::path path = directory / motion.file.name;
  std::ifstream stream(path, std::ios::binary);
  std::error_code ignored;
  if (!stream || !std::filesystem::is_regular_file(path, ignored)) {
    diagnostics.error(motion.file.at, fmt::format("cannot open the record '{}'", path.string()));
    return std::nullopt;
  }
  const auto fail = [&](std::string message) {
    diagnostics.error(motion.file.at, std::move(message));
    return std::nullopt;
  };
  const bool at2 = is_at2(path);
  if (at2 && motion.dt) return fail(fmt::format("'{}' says its own step, dt must not be given", motion.file.name));
  if (at2 && motion.unit == MotionUnit::metres)
    return fail(fmt::format("'{}' is an AT2 record, in units of g", motion.file.name));
  if (!at2 && !motion.unit)
    return fail(fmt::format("'{}' is plain text, its unit must be given (\"g\" or \"m/s2\")", motion.file.name));
  try {
    LineReader lines(stream);
    Record record = at2 ? read_at2(lines) : read_text(lines, motion.dt);
    if (record.dt == 0 && !motion.dt)
      return fail(fmt::format("'{}' has one column, its step dt must be given", motion.file.name));
    if (record.dt == 0) record.dt = *motion.dt;
    if (at2 || motion.unit == MotionUnit::g)
      for (double& a : record.acceleration) a *= parse_quantity("1 g").value;
    return record;
  } catch (const RecordFault& fault) {
    diagnostics.error({path.string(), fault.line, fault.column}, fault.text);
    return std::nullopt;
  }
}

}  // namespace nsframe
