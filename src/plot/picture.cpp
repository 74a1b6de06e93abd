#include "plot/picture.hpp"

#include <fmt/format.h>

#include "base/errors.hpp"

namespace nsframe {

std::string picture(const std::filesystem::path& file, const std::vector<Chart>& charts, const Sheet& sheet) {
  const std::string kind = file.extension().string();
  if (kind != ".svg" && kind != ".png")
    throw InputError(fmt::format("error: '{}' must end in .svg or .png", file.string()));
  const std::string svg = chart_svg(charts, sheet);
  return kind == ".png" && !svg.empty() ? png_of(svg) : svg;
}

}  // namespace nsframe
