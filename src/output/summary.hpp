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

}  // namespace nsframe
