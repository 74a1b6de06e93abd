// What the commands about records share: options that say how a file is read, target spectra, quantities of the command
// line.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "motion/record.hpp"
#include "motion/target.hpp"
#include "scene/quantity.hpp"

namespace CLI {
class App;
}

namespace nsframe::app {

struct RecordArguments {
  std::vector<std::string> files;
  std::string unit, dt, format;
  int channel = 0;  // 0: not given
};
void add_record_options(CLI::App& command, RecordArguments& arguments, int least, int most);
// Throws RecordError, IoError, InputError.
Record load_record(const RecordArguments& arguments, const std::string& file);

struct TargetArguments {
  std::string target;                                           // "eurocode8", "asce7" or a file; empty: none
  std::string ag, ground, sds, sd1, tl, unit, damping = "5 %";  // empty: not given
  int type = 0;                                                 // 0: not given
};
void add_target_options(CLI::App& command, TargetArguments& arguments, bool required);
TargetSpectrum load_target(const TargetArguments& arguments);

// The SI value of an option; bare numbers are in `bare` SI units. Throws InputError.
double quantity(const std::string& option, const std::string& text, const Dimension& wanted, double bare = 1);
// A ratio such as "5 %" or 0.05.
double ratio(const std::string& option, const std::string& text);
// "0.1,2" as two rising periods [s].
std::pair<double, double> period_range(const std::string& option, const std::string& text);

}  // namespace nsframe::app
