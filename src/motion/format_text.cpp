// Plain text and CSV: one value a line, or time and acceleration, separated by blanks, tabs, commas or semicolons.
// Lines that begin with # or %, and a first line of column names, may say the unit and the step: "# unit: cm/s2", "# dt
// = 0.005", "time [s], acceleration [g]".
#include <fmt/format.h>

#include <cmath>

#include "motion/formats.hpp"
#include "motion/text_table.hpp"

namespace nsframe {

namespace {

constexpr double step_tolerance = 0.02;  // times are printed with few digits

// Times from 0 in equal steps.
struct Times {
  int second_line = 0;
  double first_step = 0, last = 0;  // [s]

  void add(double time, std::size_t i, const TextRows& rows) {
    const int line = rows.line();
    if (i == 0 && time != 0) throw RecordFault{line, 1, fmt::format("the first time is {}, must be 0", time)};
    if (i == 1) first_step = time, second_line = line;
    if (i > 0 && !(time > last))
      throw RecordFault{line, 1,
                        fmt::format("time {} is not after {}{}", time, last,
                                    rows.maybe_decimal_commas() ? " (are these decimal commas? write points)" : "")};
    if (i > 0 && std::abs(time - last - first_step) > step_tolerance * first_step)
      throw RecordFault{line, 1,
                        fmt::format("the step to time {} is {}, not {} as before", time, time - last, first_step)};
    last = time;
  }
};

double step_of(const Times& times, const TextRows& rows, std::size_t count, const ReadOptions& options) {
  if (rows.columns() == 1) {
    if (rows.step() > 0 && options.dt && std::abs(*options.dt - rows.step()) > 1e-6 * rows.step())
      throw RecordFault{0, 0, fmt::format("the file says dt = {} s, not {} s", rows.step(), *options.dt)};
    return rows.step();
  }
  if (count < 2) throw RecordFault{rows.first_line(), 1, "one row of time and acceleration gives no step"};
  const double dt = times.last / static_cast<double>(count - 1);
  if (options.dt && std::abs(*options.dt - dt) > 0.01 * dt)
    throw RecordFault{times.second_line, 1, fmt::format("the step is {} s, not dt = {} s as given", dt, *options.dt)};
  return dt;
}

RecordFormat::Reading read_text(LineReader& lines, const ReadOptions& options) {
  RecordFormat::Reading out;
  std::vector<double>& values = out.record.acceleration;
  TextRows rows(lines, 2);
  Times times;
  while (rows.next()) {
    if (rows.columns() == 2) times.add(rows.values().front(), values.size(), rows);
    values.push_back(rows.values().back());
    if (values.size() > max_record_samples)
      throw RecordFault{lines.number(), 1, fmt::format("more than {} values", max_record_samples)};
  }
  if (values.empty()) throw RecordFault{lines.place(), 1, "holds no values"};
  rows.finish();
  out.unit = rows.unit();
  out.record.dt = step_of(times, rows, values.size(), options);
  return out;
}

}  // namespace

const RecordFormat plain_text{"text", "plain text or CSV", [](const FileBeginning&) { return true; }, read_text};

}  // namespace nsframe
