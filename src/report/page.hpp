// A run as one HTML page that needs nothing else: no server, no network.
#pragma once

#include <filesystem>
#include <string>

namespace nsframe {

// Reads the folder of a run. Throws InputError when it is none, IoError when a file of it cannot be read.
std::string report_page(const std::filesystem::path& folder);

}  // namespace nsframe
