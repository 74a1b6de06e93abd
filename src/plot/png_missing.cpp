// In place of png.cpp in a program without librsvg.
#include "base/errors.hpp"
#include "plot/picture.hpp"

namespace nsframe {

std::string png_of(const std::string&) {
  throw InputError("error: this nsframe was built without librsvg and writes no PNG: name a file that ends in .svg");
}

}  // namespace nsframe
