#include "motion/write_at2.hpp"

#include <fmt/format.h>

#include <iterator>

#include "motion/lines.hpp"

namespace nsframe {

namespace {

// A line of text that the reader doesn't take for another.
std::string header_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  for (std::size_t at = upper(text).find("NPTS"); at != std::string::npos; at = upper(text).find("NPTS"))
    text.erase(at, 4);
  return text.substr(0, 200);
}

}  // namespace

std::string at2_text(const Record& record, const std::string& title) {
  std::string out =
      fmt::format("{}\n{}\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= {:6d}, DT= {:.10g} SEC\n", header_line(title),
                  header_line(record.description), record.acceleration.size(), record.dt);
  const double g = in_si(AccelerationUnit::g);
  for (std::size_t i = 0; i < record.acceleration.size(); ++i)
    fmt::format_to(std::back_inserter(out), "{:16.7E}{}", record.acceleration[i] / g,
                   i % 5 == 4 || i + 1 == record.acceleration.size() ? "\n" : "");
  return out;
}

}  // namespace nsframe
