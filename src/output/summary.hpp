// The summary of a run: summary.json for programs, a plain table for the terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Writes the summary as JSON, replacing an earlier file only when complete. Throws IoError.
void write_summary(const Summary& summary, const std::filesystem::path& path);

// The same as text.
std::string summary_json(const Summary& summary);

// Tables of at most 100 columns.
std::string summary_text(const Summary& summary);

// Name of a contact pair.
std::string pair_name(const Summary& summary, int pair);

// Modes whose damping the scene sets, or with more than 5 % of the mass in one direction below 30 Hz; all when there
// are none.
std::vector<ModeNumerics> modes_that_matter(const Summary& summary);

// Sentences about the errors of the scheme itself at this step: modes that it damps or shifts beyond what was asked
// for, an energy balance or a contact solution that does not close.
std::vector<std::string> numerical_warnings(const Summary& summary);

}  // namespace nsframe
