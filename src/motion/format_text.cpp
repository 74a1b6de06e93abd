// Plain text and CSV: one value a line, or time and acceleration, separated by blanks, tabs, commas or semicolons. Lines
// that begin with # or %, and a first line of column names, may say the unit and the step: "# unit: cm/s2", "# dt = 0.005",
// "time [s], acceleration [g]".
#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

constexpr double step_tolerance = 0.02;  // times are printed with few digits

class TextReader {
 public:
  TextReader(LineReader& lines, const ReadOptions& options) : lines_(lines), options_(options) {}
  RecordFormat::Reading read();

 private:
  void comment(const std::string& line);
  bool heading(const std::vector<Token>& row);
  std::vector<Token> columns(const std::string& line);
  void add_time(double time);
  void finish();

  LineReader& lines_;
  const ReadOptions& options_;
  RecordFormat::Reading out_;
  std::size_t columns_ = 0;
  bool commas_ = false, points_ = false;  // commas between columns, decimal points or exponents met
  int first_line_ = 0, second_line_ = 0;
  double said_step_ = 0, first_step_ = 0, last_time_ = 0;  // [s]
};

void TextReader::comment(const std::string& line) {
  const std::string text = upper(line);
  for (const char* key : {"UNITS", "UNIT"}) {
    const auto value = value_behind(text, key);
    if (!value) continue;
    const auto unit = parse_acceleration_unit(*value);
    if (!unit) throw RecordFault{lines_.number(), 1, fmt::format("'{}' is no unit of acceleration; known: {}", *value, known_acceleration_units())};
    out_.unit = unit;
  }
  if (const auto value = value_behind(text, " DT")) {
    const auto dt = leading_number(*value);
    if (!dt) throw RecordFault{lines_.number(), 1, "dt has no number"};
    said_step_ = positive_step(*dt, "dt", lines_.number());
  }
}

// Names of columns, the last one perhaps with its unit in brackets.
bool TextReader::heading(const std::vector<Token>& row) {
  const char first = row.front().text.front();
  if (first != '"' && !std::isalpha(static_cast<unsigned char>(first))) return false;
  const std::string name = upper(row.front().text);
  if (name == "NAN" || name == "INF" || name == "INFINITY") return false;
  const std::string& line = lines_.line();
  std::vector<std::string_view> units;
  for (std::size_t open = line.find_first_of("[("); open != std::string::npos; open = line.find_first_of("[(", open + 1)) {
    const std::size_t close = line.find_first_of("])", open);
    if (close != std::string::npos) units.push_back(std::string_view(line).substr(open + 1, close - open - 1));
  }
  if (units.size() > 2) throw RecordFault{lines_.number(), 1, "more than two columns; must be acceleration, or time and acceleration"};
  if (units.size() == 2 && upper(trimmed(units.front())) != "S" && upper(trimmed(units.front())) != "SEC")
    throw RecordFault{lines_.number(), 1, fmt::format("times must be in s, not '{}'", units.front())};
  if (units.empty()) return true;
  const auto unit = parse_acceleration_unit(units.back());
  if (!unit)
    throw RecordFault{lines_.number(), 1, fmt::format("'{}' is no unit of acceleration; known: {}", units.back(), known_acceleration_units())};
  out_.unit = unit;
  return true;
}

std::vector<Token> TextReader::columns(const std::string& line) {
  if (line.find(';') != std::string::npos) return tokens(line, " \t\r\f\x1a;");
  const std::vector<Token> by_blanks = tokens(line);
  bool inside = false;  // a comma within a word of several: "0,01 0,25"
  for (const Token& token : by_blanks) {
    const std::size_t comma = token.text.find(',');
    inside = inside || (comma != std::string_view::npos && comma > 0 && comma + 1 < token.text.size());
  }
  if (line.find(',') == std::string::npos || (inside && by_blanks.size() > 1)) return by_blanks;
  commas_ = true;
  return tokens(line, " \t\r\f\x1a,");
}

void TextReader::add_time(double time) {
  const std::size_t i = out_.record.acceleration.size();
  const int line = lines_.number();
  if (i == 0 && time != 0) throw RecordFault{line, 1, fmt::format("the first time is {}, must be 0", time)};
  if (i == 1) {
    first_step_ = time;
    second_line_ = line;
  }
  if (i > 0 && !(time > last_time_))
    throw RecordFault{line, 1, fmt::format("time {} is not after {}{}", time, last_time_, commas_ && !points_ ? " (are these decimal commas? write points)" : "")};
  if (i > 0 && std::abs(time - last_time_ - first_step_) > step_tolerance * first_step_)
    throw RecordFault{line, 1, fmt::format("the step to time {} is {}, not {} as before", time, time - last_time_, first_step_)};
  last_time_ = time;
}

void TextReader::finish() {
  const std::size_t count = out_.record.acceleration.size();
  if (count == 0) throw RecordFault{lines_.place(), 1, "holds no values"};
  if (commas_ && !points_)
    throw RecordFault{first_line_, 1, "commas between columns or decimal commas? write decimals with a point"};
  if (columns_ == 1) {
    out_.record.dt = said_step_;
    if (said_step_ > 0 && options_.dt && std::abs(*options_.dt - said_step_) > 1e-6 * said_step_)
      throw RecordFault{0, 0, fmt::format("the file says dt = {} s, not {} s", said_step_, *options_.dt)};
    return;
  }
  if (count < 2) throw RecordFault{first_line_, 1, "one row of time and acceleration gives no step"};
  out_.record.dt = last_time_ / static_cast<double>(count - 1);
  if (options_.dt && std::abs(*options_.dt - out_.record.dt) > 0.01 * out_.record.dt)
    throw RecordFault{second_line_, 1, fmt::format("the step is {} s, not dt = {} s as given", out_.record.dt, *options_.dt)};
}

RecordFormat::Reading TextReader::read() {
  std::vector<double>& values = out_.record.acceleration;
  while (lines_.next()) {
    const std::vector<Token> row = columns(lines_.line());
    if (row.empty()) continue;
    if (row.front().text.front() == '#' || row.front().text.front() == '%') {
      comment(lines_.line());
      continue;
    }
    if (values.empty() && first_line_ == 0) {
      first_line_ = lines_.number();
      if (heading(row)) continue;
    }
    if (columns_ == 0) {
      columns_ = row.size();
      first_line_ = lines_.number();
    }
    if (row.size() != columns_ || columns_ > 2)
      throw RecordFault{lines_.number(), 1, fmt::format("{} columns, must be {}", row.size(),
                                                        columns_ > 2 ? "1 or 2" : std::to_string(columns_) + " as before")};
    points_ = points_ || lines_.line().find_first_of(".eE") != std::string::npos;
    if (columns_ == 2) add_time(number(row.front(), lines_.number()));
    values.push_back(number(row.back(), lines_.number()));
    if (values.size() > max_record_samples) throw RecordFault{lines_.number(), 1, fmt::format("more than {} values", max_record_samples)};
  }
  finish();
  return std::move(out_);
}

}  // namespace

const RecordFormat plain_text{"text", "plain text or CSV", [](const FileBeginning&) { return true; },
                              [](LineReader& lines, const ReadOptions& options) { return TextReader(lines, options).read(); }};

}  // namespace nsframe
