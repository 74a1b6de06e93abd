// Peaks, Arias intensity and durations of a record, for the terminal and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "motion/record.hpp"

namespace nsframe::app {

void print_measures(const Record& record);
nlohmann::json measures_json(const Record& record, const std::string& file);

}  // namespace nsframe::app
