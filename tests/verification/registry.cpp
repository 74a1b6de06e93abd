#include "tests/verification/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nsframe::test {
namespace {

// In the order of the document; new ones come after these.
const std::vector<std::string> known_chapters{"Contact", "Oscillators and time integration", "Modes", "Frames", "Large displacements", "Spectra"};

std::vector<VerificationCase>& registered() {
  static std::vector<VerificationCase> cases;
  return cases;
}

std::size_t place_of(const std::string& chapter) {
  return static_cast<std::size_t>(std::find(known_chapters.begin(), known_chapters.end(), chapter) - known_chapters.begin());
}

// Below a millionth a difference is rounding and iteration tolerance, other on every machine.
std::string shown_difference(const VerificationRow& row) {
  const double difference = row.difference(), scale = row.tolerance.relative ? 1 : std::max(std::abs(row.reference), row.tolerance.value);
  const double least = 1e-6 * scale;
  if (difference < least) return row.tolerance.relative ? "< 1e-6" : fmt::format("< {:.0e}", least);
  return fmt::format("{:.1e}", difference);
}

std::string number(const std::string& cell) {
  return cell.starts_with("< ") ? cell.substr(2) : cell;
}

// One unit of the last digit of a number as it stands there.
double last_unit(const std::string& text) {
  const std::size_t e = text.find('e'), point = text.find('.');
  const std::string digits = text.substr(0, e);
  const int exponent = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  const int decimals = point == std::string::npos || point > digits.size() ? 0 : static_cast<int>(digits.size() - point) - 1;
  return std::pow(10.0, exponent - decimals);
}

bool same_cell(const std::string& one, const std::string& other) {
  if (one == other) return true;
  const std::string a = number(one), b = number(other);
  char* end = nullptr;
  const double x = std::strtod(a.c_str(), &end);
  if (a.empty() || *end != '\0') return false;
  const double y = std::strtod(b.c_str(), &end);
  if (b.empty() || *end != '\0') return false;
  return std::abs(x - y) <= 1.001 * std::max(last_unit(a), last_unit(b));
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (std::size_t next; (next = text.find(by, at)) != std::string::npos; at = next + by.size()) parts.push_back(text.substr(at, next - at));
  parts.push_back(text.substr(at));
  return parts;
}

// What rounding leaves of a zero differs between machines: numbers far below what is allowed count as the same.
constexpr double far_below = 0.05;

bool same_line(const std::string& one, const std::string& other) {
  const auto a = split(one, " | "), b = split(other, " | ");
  if (a.size() != b.size()) return false;
  const bool of_zero = a.size() == 5 && a[2] == "0" && a[4].ends_with(" abs |") && a[4] == b[4];
  const double rounding = of_zero ? far_below * std::strtod(a[4].c_str(), nullptr) : 0;
  return std::equal(a.begin(), a.end(), b.begin(), [&](const std::string& x, const std::string& y) {
    const auto size = [](const std::string& cell) { return std::abs(std::strtod(number(cell).c_str(), nullptr)); };
    return same_cell(x, y) || (rounding > 0 && &x != &a.front() && size(x) < rounding && size(y) < rounding && size(x) > 0 && size(y) > 0);
  });
}

}  // namespace

double VerificationRow::difference() const {
  const double absolute = std::abs(value - reference);
  return tolerance.relative ? absolute / std::abs(reference) : absolute;
}

bool register_case(VerificationCase one) {
  registered().push_back(std::move(one));
  return true;
}

std::vector<VerificationCase> verification_cases() {
  std::vector<VerificationCase> cases = registered();
  std::sort(cases.begin(), cases.end(), [](const VerificationCase& a, const VerificationCase& b) {
    return std::tuple(place_of(a.chapter), a.chapter, a.title) < std::tuple(place_of(b.chapter), b.chapter, b.title);
  });
  return cases;
}

void check_case(const char* title, void (*fill)(VerificationRows& rows)) {
  VerificationRows rows;
  fill(rows);
  CHECK_MESSAGE(!rows.all().empty(), title);
  for (const VerificationRow& row : rows.all()) {
    CHECK_MESSAGE(row.holds(), row.quantity << ": " << row.value << ", reference " << row.reference << ", difference "
                                            << row.difference() << ", allowed " << row.tolerance.value);
  }
}

std::string verification_document() {
  std::string out =
      "# Verification\n\nWritten by the tests in `tests/verification` (`registry.hpp` tells how); one of them fails when this file "
      "is not what they give, and each\ncase fails beyond its tolerance. Differences are relative unless marked *abs*.\n";
  std::string chapter;
  for (const VerificationCase& one : verification_cases()) {
    if (one.chapter != chapter) out += fmt::format("\n## {}\n", one.chapter);
    chapter = one.chapter;
    out += fmt::format("\n### {}\n\n{}\n\n| quantity | nsframe | reference | difference | allowed |\n| --- | --- | --- | --- | --- |\n",
                       one.title, one.text);
    VerificationRows rows;
    one.fill(rows);
    for (const VerificationRow& row : rows.all()) {
      out += fmt::format("| {} | {:.7g} | {:.8g} | {} | {:.1e}{} |\n", row.quantity, row.value, row.reference, shown_difference(row),
                         row.tolerance.value, row.tolerance.relative ? "" : " abs");
    }
  }
  return out;
}

std::string document_difference(const std::string& one, const std::string& other) {
  const auto a = split(one, "\n"), b = split(other, "\n");
  std::string out;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string from = i < a.size() ? a[i] : "(nothing)", to = i < b.size() ? b[i] : "(nothing)";
    if (!same_line(from, to)) out += fmt::format("line {}: '{}' against '{}'\n", i + 1, from, to);
  }
  return out;
}

}  // namespace nsframe::test
