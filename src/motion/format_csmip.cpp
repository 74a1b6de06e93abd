// CSMIP (CDMG) volume 2: for each channel 25 lines of text and headers of numbers, then
//   "3000 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)"
// with values of that width, which may touch, and the same for velocity and displacement.
#include <fmt/format.h>

#include "motion/formats.hpp"

namespace nsframe {

namespace {

constexpr std::string_view spaced = "EQUALLY SPACED AT";

// What is between "in" or "units:" and the format in brackets; nothing when the line doesn't say.
std::optional<AccelerationUnit> unit_of(std::string_view text) {
  for (const Token& token : tokens(text, " \t\r,()")) {
    std::string_view word = token.text;
    while (word.ends_with('.')) word.remove_suffix(1);
    if (const auto unit = parse_acceleration_unit(word)) return unit;
  }
  return std::nullopt;
}

RecordFormat::Reading read_csmip(LineReader& lines, const ReadOptions& options) {
  if (options.dt) throw RecordFault{0, 0, "a CSMIP record says its own step, dt must not be given"};
  RecordFormat::Reading out;
  ChannelChoice choice(options);
  std::string name;
  while (lines.next()) {
    const std::string text = upper(lines.line());
    const int at = lines.number();
    if (const std::size_t chan = text.find("CHAN ");
        chan != std::string::npos && text.find("END OF DATA") == std::string::npos)
      name = trimmed(std::string_view(lines.line()).substr(chan));
    const std::size_t points = text.find("POINTS OF "), step = text.find(spaced);
    const bool acceleration = text.find("ACC") != std::string::npos;
    if (points == std::string::npos || step == std::string::npos ||
        !(acceleration || text.find("VEL") != std::string::npos || text.find("DISP") != std::string::npos))
      continue;
    const auto count = leading_number(text);
    const auto dt = leading_number(text.substr(step + spaced.size()));
    if (!count || !dt) throw RecordFault{at, 1, "must say its number of points and step"};
    const int width = format_width(std::string_view(lines.line()).substr(step));
    std::vector<double> values;
    read_numbers(lines, sample_count(*count, "number of points", at), width, values);
    if (!acceleration || !choice.offer(name, at)) continue;
    out.record.dt = positive_step(*dt, "step", at);
    out.unit = unit_of(std::string_view(text).substr(step + spaced.size()));
    out.record.acceleration = std::move(values);
    out.record.description = name;
  }
  choice.finish(lines.place());
  return out;
}

}  // namespace

const RecordFormat csmip_v2{"csmip", "CSMIP volume 2",
                            [](const FileBeginning& file) {
                              return file.extension == ".V2" || (file.text.find("POINTS OF ACC") != std::string::npos &&
                                                                 file.text.find(spaced) != std::string::npos);
                            },
                            read_csmip};

}  // namespace nsframe
