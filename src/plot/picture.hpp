// Charts as the bytes of a picture file: SVG, or PNG where the program was built with librsvg.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plot/chart.hpp"

namespace nsframe {

// By the end of the file's name, .svg or .png; an empty string when no chart has a point to draw. Throws InputError for other
// names, and for PNG in a program without it.
std::string picture(const std::filesystem::path& file, const std::vector<Chart>& charts, const Sheet& sheet = {});

// A PNG as large as the SVG says. Throws InputError in a program without librsvg.
std::string png_of(const std::string& svg);

}  // namespace nsframe
