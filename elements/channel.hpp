// Channels by name (AISC: C): dimensions, tabulated properties, fibers and outline. Local axes through the centroid: depth
// along y, so the strong axis is z; flanges towards positive z. Members take the shear centre as lying on the centroid.
#pragma once

#include <span>
#include <string_view>

#include "elements/catalogue.hpp"

namespace nsframe {

struct ChannelShape {
  std::string_view name;      // "C10X20"
  double h, b, tw, tf;        // depth, width, web, mean flange thickness [m]
  double z;                   // tabulated place of the centroid from the web's back [m]
  double A;                   // tabulated area [m2]
  double I_strong, I_weak;    // tabulated second moments [m4]
  double J;                   // tabulated torsion constant [m4]
};

std::span<const ChannelShape> channels();
// By its name in capitals without blanks, or nullptr.
const ChannelShape* find_channel(std::string_view name);

// Their area, centroid and second moments are the tabulated ones. Flanges at +y and -y, then the web.
Fibers channel_fibers(const ChannelShape& shape, const ShapeMesh& mesh, const Reference& material);
SectionOutline channel_outline(const ChannelShape& shape);

}  // namespace nsframe
