// nsframe report: what its command line says.
#pragma once

#include <filesystem>

#include "app/commands.hpp"

namespace nsframe::app {

struct ReportArguments {
  std::filesystem::path folder;  // that nsframe run wrote
  std::filesystem::path output;  // empty: report.html in the folder
};

int report(const ReportArguments& arguments);

}  // namespace nsframe::app
