// What the readers of record formats share: lines of bounded length, numbers with their places, headers.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nsframe {

struct RecordFault {
  int line, column;  // line 0: what is said about the file is wrong, not the file
  std::string text;
};

// Lines of a text file, one at a time, of bounded length; throws RecordFault at the first character that is no text.
class LineReader {
 public:
  explicit LineReader(std::istream& stream) : stream_(stream), piece_(65536) {}

  bool next();
  const std::string& line() const { return line_; }
  int number() const { return number_; }
  int place() const { return number_ > 0 ? number_ : 1; }  // line of an error at the end of the file
  // The same line once more from the following next().
  void hold() { held_ = true; }

 private:
  int character();
  std::istream& stream_;
  std::vector<char> piece_;
  std::size_t at_ = 0, filled_ = 0;
  std::string line_;
  int number_ = 0;
  bool held_ = false;
};

struct Token {
  std::string_view text;
  int column;  // from 1
};

inline constexpr std::string_view blanks = " \t\r\f\x1a";

std::vector<Token> tokens(std::string_view line, std::string_view separators = blanks);
std::string_view trimmed(std::string_view text);
std::string upper(std::string_view text);

// The whole token as a finite number; throws RecordFault.
double number(const Token& token, int line);
// The number that `text` begins with, after blanks; nothing when there is none.
std::optional<double> leading_number(std::string_view text);
// What is behind `key` and its '=' or ':' in a line; nothing when the line has no such key. Case counts.
std::optional<std::string_view> value_behind(std::string_view line, std::string_view key);

// The count as an integer from 1 to max_record_samples; throws RecordFault that calls it `name`.
std::size_t sample_count(double count, const char* name, int line);
double positive_step(double dt, const char* name, int line);

// Appends `count` numbers, as many a line as there are: separated by blanks, or each `width` characters wide (they may
// then touch). Throws RecordFault when the file ends before, or holds letters.
void read_numbers(LineReader& lines, std::size_t count, int width, std::vector<double>& into);

// The width of "(8F10.5)" or "(1E15.6)"; 0 when there is no such format.
int format_width(std::string_view text);

}  // namespace nsframe
