#include "motion/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "motion/record.hpp"

namespace nsframe {

namespace {

constexpr std::size_t max_line_length = 65536;
constexpr int at_end = -1;

}  // namespace

int LineReader::character() {
  if (at_ == filled_) {
    stream_.read(piece_.data(), static_cast<std::streamsize>(piece_.size()));
    filled_ = static_cast<std::size_t>(stream_.gcount());
    at_ = 0;
    if (filled_ == 0) return at_end;
  }
  return static_cast<unsigned char>(piece_[at_++]);
}

bool LineReader::next() {
  if (held_) {
    held_ = false;
    return true;
  }
  line_.clear();
  int c = character();
  if (c == at_end) return false;
  ++number_;
  for (; c != '\n' && c != at_end; c = character()) {
    if (c < 0x20 && c != '\t' && c != '\r' && c != '\f' && c != 0x1a)
      throw RecordFault{number_, static_cast<int>(line_.size()) + 1, "is a binary file, not text"};
    if (line_.size() == max_line_length)
      throw RecordFault{number_, 1, fmt::format("the line is longer than {} characters", max_line_length)};
    line_ += static_cast<char>(c);
  }
  return true;
}

std::vector<Token> tokens(std::string_view line, std::string_view separators) {
  std::vector<Token> out;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    out.push_back({line.substr(begin, end - begin), static_cast<int>(begin) + 1});
    begin = line.find_first_not_of(separators, end);
  }
  return out;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
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
  if (code == std::errc::result_out_of_range)
    throw RecordFault{line, token.column, fmt::format("'{}' is out of the range of numbers", shown)};
  if (code != std::errc{} || end != text.data() + text.size())
    throw RecordFault{line, token.column, fmt::format("'{}' is not a number", shown)};
  if (!std::isfinite(value)) throw RecordFault{line, token.column, fmt::format("'{}' is not finite", shown)};
  return value;
}

std::optional<double> leading_number(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end == text.data()) return std::nullopt;
  return value;
}

std::optional<std::string_view> value_behind(std::string_view line, std::string_view key) {
  std::size_t at = line.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  at = line.find_first_not_of(" \t", at + key.size());
  if (at == std::string_view::npos || (line[at] != '=' && line[at] != ':')) return std::nullopt;
  return trimmed(line.substr(at + 1));
}

std::size_t sample_count(double count, const char* name, int line) {
  if (!(count >= 1) || count != std::floor(count) || count > double(max_record_samples))
    throw RecordFault{line, 1,
                      fmt::format("{} = {}, must be a whole number from 1 to {}", name, count, max_record_samples)};
  return static_cast<std::size_t>(count);
}

double positive_step(double dt, const char* name, int line) {
  if (!(dt > 0) || !std::isfinite(dt)) throw RecordFault{line, 1, fmt::format("{} = {}, must be positive", name, dt)};
  return dt;
}

void read_numbers(LineReader& lines, std::size_t count, int width, std::vector<double>& into) {
  const std::size_t first = into.size();
  into.reserve(first + std::min<std::size_t>(count, 65536));
  while (into.size() - first < count) {
    if (!lines.next())
      throw RecordFault{lines.place(), 1, fmt::format("ends after {} of {} values", into.size() - first, count)};
    const std::string_view line = lines.line();
    if (width == 0) {
      for (const Token& token : tokens(line)) {
        if (into.size() - first == count)
          throw RecordFault{lines.number(), token.column, fmt::format("more values than {}", count)};
        into.push_back(number(token, lines.number()));
      }
      continue;
    }
    for (std::size_t at = 0; at < line.size(); at += static_cast<std::size_t>(width)) {
      const std::string_view field = line.substr(at, static_cast<std::size_t>(width));
      const std::string_view text = trimmed(field);
      if (text.empty()) continue;
      const int column = static_cast<int>(at + field.find_first_not_of(blanks)) + 1;
      if (into.size() - first == count)
        throw RecordFault{lines.number(), column, fmt::format("more values than {}", count)};
      into.push_back(number({text, column}, lines.number()));
    }
  }
}

int format_width(std::string_view text) {
  for (std::size_t open = text.find('('); open != std::string_view::npos; open = text.find('(', open + 1)) {
    std::size_t at = open + 1;
    while (at < text.size() && (std::isdigit(static_cast<unsigned char>(text[at])) || text[at] == ' ')) ++at;
    if (at >= text.size() || std::string_view("fFeEgGiI").find(text[at]) == std::string_view::npos) continue;
    int width = 0;
    if (std::from_chars(text.data() + at + 1, text.data() + text.size(), width).ec == std::errc{} && width > 0 &&
        width <= 80)
      return width;
  }
  return 0;
}

}  // namespace nsframe
