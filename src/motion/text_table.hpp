// Rows of numbers in plain text or CSV: separators, comments, a heading with units, and decimal commas found out.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "motion/lines.hpp"
#include "motion/units.hpp"

namespace nsframe {

// Reads row by row, so that memory doesn't grow with the file. Throws RecordFault.
class TextRows {
 public:
  // Rows of up to `most_columns` numbers.
  TextRows(LineReader& lines, std::size_t most_columns) : lines_(lines), most_columns_(most_columns) {}

  bool next();  // false at the end
  const std::vector<double>& values() const { return values_; }
  int line() const { return lines_.number(); }
  int first_line() const { return first_line_; }
  std::size_t columns() const { return columns_; }
  std::optional<AccelerationUnit> unit() const { return unit_; }  // said in a comment or the heading
  double step() const { return step_; }                           // the same [s]; 0: not said
  bool maybe_decimal_commas() const { return commas_ && !points_; }
  // Throws when commas may have been columns or decimals alike.
  void finish() const;

 private:
  void comment(const std::string& line);
  bool heading(const std::vector<Token>& row);
  std::vector<Token> split(const std::string& line);

  LineReader& lines_;
  std::size_t most_columns_, columns_ = 0;
  std::vector<double> values_;
  std::optional<AccelerationUnit> unit_;
  double step_ = 0;
  int first_line_ = 0;
  bool heading_passed_ = false, commas_ = false, points_ = false;  // commas between columns; points or exponents met
};

// A short table, of at most 100000 rows.
struct TextTable {
  struct Row {
    int line;
    std::vector<double> values;
  };
  std::vector<Row> rows;
  std::optional<AccelerationUnit> unit;
};
// Throws RecordError, IoError.
TextTable read_text_table(const std::filesystem::path& file, std::size_t columns);

}  // namespace nsframe
