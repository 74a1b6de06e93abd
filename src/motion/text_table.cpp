#include "motion/text_table.hpp"

#include <fmt/format.h>

#include <cctype>
#include <fstream>

#include "motion/record.hpp"

namespace nsframe {

namespace {

constexpr std::size_t most_table_rows = 100000;

AccelerationUnit unit_of(std::string_view text, int line) {
  const auto unit = parse_acceleration_unit(text);
  if (!unit)
    throw RecordFault{line, 1,
                      fmt::format("'{}' is no unit of acceleration; known: {}", text, known_acceleration_units())};
  return *unit;
}

}  // namespace

void TextRows::comment(const std::string& line) {
  const std::string text = upper(line);
  for (const char* key : {"UNITS", "UNIT"})
    if (const auto value = value_behind(text, key)) unit_ = unit_of(*value, lines_.number());
  if (const auto value = value_behind(text, " DT")) {
    const auto dt = leading_number(*value);
    if (!dt) throw RecordFault{lines_.number(), 1, "dt has no number"};
    step_ = positive_step(*dt, "dt", lines_.number());
  }
}

// Names of columns, the last one perhaps with its unit in brackets.
bool TextRows::heading(const std::vector<Token>& row) {
  const char first = row.front().text.front();
  if (first != '"' && !std::isalpha(static_cast<unsigned char>(first))) return false;
  const std::string name = upper(row.front().text);
  if (name == "NAN" || name == "INF" || name == "INFINITY") return false;
  const std::string& line = lines_.line();
  std::vector<std::string_view> units;
  for (std::size_t open = line.find_first_of("[("); open != std::string::npos;
       open = line.find_first_of("[(", open + 1)) {
    const std::size_t close = line.find_first_of("])", open);
    if (close != std::string::npos) units.push_back(std::string_view(line).substr(open + 1, close - open - 1));
  }
  if (units.size() > most_columns_)
    throw RecordFault{lines_.number(), 1, fmt::format("more than {} columns", most_columns_)};
  if (units.size() == 2 && upper(trimmed(units.front())) != "S" && upper(trimmed(units.front())) != "SEC")
    throw RecordFault{lines_.number(), 1, fmt::format("times must be in s, not '{}'", units.front())};
  if (!units.empty()) unit_ = unit_of(units.back(), lines_.number());
  return true;
}

std::vector<Token> TextRows::split(const std::string& line) {
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

bool TextRows::next() {
  while (lines_.next()) {
    const bool is_comment = std::string_view("#%").find(trimmed(lines_.line()).substr(0, 1)) != std::string_view::npos;
    if (trimmed(lines_.line()).empty()) continue;
    if (is_comment) {
      comment(lines_.line());
      continue;
    }
    const std::vector<Token> row = split(lines_.line());
    if (row.empty()) continue;
    if (!heading_passed_) {
      heading_passed_ = true;
      if (heading(row)) continue;
    }
    if (columns_ == 0) {
      columns_ = row.size();
      first_line_ = lines_.number();
    }
    if (row.size() != columns_ || columns_ > most_columns_)
      throw RecordFault{lines_.number(), 1,
                        fmt::format("{} columns, must be {}", row.size(),
                                    columns_ > most_columns_ ? fmt::format("1 or {}", most_columns_)
                                                             : fmt::format("{} as before", columns_))};
    points_ = points_ || lines_.line().find_first_of(".eE") != std::string::npos;
    values_.clear();
    for (const Token& token : row) values_.push_back(number(token, lines_.number()));
    return true;
  }
  return false;
}

void TextRows::finish() const {
  if (maybe_decimal_commas())
    throw RecordFault{first_line_, 1, "commas between columns or decimal commas? write decimals with a point"};
}

TextTable read_text_table(const std::filesystem::path& file, std::size_t columns) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream || !std::filesystem::is_regular_file(file, ignored))
    throw IoError(fmt::format("error: cannot open '{}'", file.string()));
  try {
    LineReader lines(stream);
    TextRows rows(lines, columns);
    TextTable out;
    while (rows.next()) {
      if (rows.columns() != columns)
        throw RecordFault{rows.line(), 1, fmt::format("{} columns, must be {}", rows.columns(), columns)};
      if (out.rows.size() == most_table_rows)
        throw RecordFault{rows.line(), 1, fmt::format("more than {} rows", most_table_rows)};
      out.rows.push_back({rows.line(), rows.values()});
    }
    rows.finish();
    out.unit = rows.unit();
    return out;
  } catch (const RecordFault& fault) {
    throw RecordError({file.string(), fault.line, fault.column}, fault.text);
  }
}

}  // namespace nsframe
