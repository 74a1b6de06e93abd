// C shapes (American standard channels) of AISC, as published in inches (Manual, 15th edition, table 1-5). The flange is
// thicker at the web, with a slope of 1/6; tf is its mean thickness. Checked: A against the weight in the name within
// 1 %; A, Ix, Iy and the centroid of the drawn shape, which has no fillets, lie within 1.3, 1.3, 3.9 and 1.3 % of the table.
#include <algorithm>
#include <array>
#include <iterator>

#include "elements/channel.hpp"

namespace nsframe {

namespace {

struct Row {
  std::string_view name;
  double d, bf, tw, tf;  // [in]
  double A;              // [in2]
  double Ix, Iy;         // [in4]
  double x;              // [in] of the centroid from the web's back
  double J;              // [in4]
};

// clang-format off
constexpr Row rows[] = {
    // name          d     bf     tw     tf      A     Ix     Iy      x      J
    {"C15X50",        15,   3.72,  0.716,   0.65,   14.7,    404,     11,  0.799,   2.65},
    {"C15X40",        15,   3.52,   0.52,   0.65,   11.8,    348,   9.17,  0.778,   1.45},
    {"C15X33.9",      15,    3.4,    0.4,   0.65,     10,    315,   8.07,  0.788,   1.01},
    {"C12X30",        12,   3.17,   0.51,  0.501,   8.81,    162,   5.12,  0.674,  0.861},
    {"C12X25",        12,   3.05,  0.387,  0.501,   7.34,    144,   4.45,  0.674,  0.538},
    {"C12X20.7",      12,   2.94,  0.282,  0.501,   6.08,    129,   3.86,  0.698,  0.369},
    {"C10X30",        10,   3.03,  0.673,  0.436,   8.81,    103,   3.93,  0.649,   1.22},
    {"C10X25",        10,   2.89,  0.526,  0.436,   7.35,   91.1,   3.34,  0.617,  0.687},
    {"C10X20",        10,   2.74,  0.379,  0.436,   5.87,   78.9,    2.8,  0.606,  0.368},
    {"C10X15.3",      10,    2.6,   0.24,  0.436,   4.48,   67.3,   2.27,  0.634,  0.209},
    {"C9X20",          9,   2.65,  0.448,  0.413,   5.87,   60.9,   2.41,  0.583,  0.427},
    {"C9X15",          9,   2.49,  0.285,  0.413,    4.4,     51,   1.91,  0.586,  0.208},
    {"C9X13.4",        9,   2.43,  0.233,  0.413,   3.94,   47.8,   1.75,  0.601,  0.168},
    {"C8X18.75",       8,   2.53,  0.487,   0.39,   5.51,   43.9,   1.97,  0.565,  0.434},
    {"C8X13.75",       8,   2.34,  0.303,   0.39,   4.03,   36.1,   1.52,  0.554,  0.186},
    {"C8X11.5",        8,   2.26,   0.22,   0.39,   3.37,   32.5,   1.31,  0.572,   0.13},
    {"C7X14.75",       7,    2.3,  0.419,  0.366,   4.33,   27.2,   1.37,  0.532,  0.267},
    {"C7X12.25",       7,   2.19,  0.314,  0.366,   3.59,   24.2,   1.16,  0.525,  0.161},
    {"C7X9.8",         7,   2.09,   0.21,  0.366,   2.87,   21.2,  0.957,  0.541, 0.0996},
    {"C6X13",          6,   2.16,  0.437,  0.343,   3.82,   17.3,   1.05,  0.514,  0.237},
    {"C6X10.5",        6,   2.03,  0.314,  0.343,   3.07,   15.1,   0.86,    0.5,  0.128},
    {"C6X8.2",         6,   1.92,    0.2,  0.343,   2.39,   13.1,  0.687,  0.512, 0.0736},
    {"C5X9",           5,   1.89,  0.325,   0.32,   2.64,   8.89,  0.624,  0.478,  0.109},
    {"C5X6.7",         5,   1.75,   0.19,   0.32,   1.97,   7.48,   0.47,  0.484, 0.0549},
    {"C4X7.25",        4,   1.72,  0.321,  0.296,   2.13,   4.58,  0.425,  0.459, 0.0817},
    {"C4X5.4",         4,   1.58,  0.184,  0.296,   1.58,   3.85,  0.312,  0.457, 0.0399},
    {"C3X6",           3,    1.6,  0.356,  0.273,   1.76,   2.07,    0.3,  0.455, 0.0725},
    {"C3X5",           3,    1.5,  0.258,  0.273,   1.47,   1.85,  0.241,  0.439, 0.0425},
    {"C3X4.1",         3,   1.41,   0.17,  0.273,    1.2,   1.65,  0.191,  0.437, 0.0269},
};
// clang-format on

constexpr double inch = 0.0254;
constexpr double slope = 1.0 / 6;  // of the inner faces of the flanges

constexpr auto shapes = [] {
  std::array<ChannelShape, std::size(rows)> out{};
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    const Row& r = rows[i];
    constexpr double in2 = inch * inch, in4 = in2 * in2;
    out[i] = {r.name, r.d * inch, r.bf * inch, r.tw * inch, r.tf * inch, r.x * inch, r.A * in2, r.Ix * in4, r.Iy * in4, r.J * in4};
  }
  return out;
}();

// Thickness of the flanges at z from the web's back.
double flange(const ChannelShape& c, double z) { return c.tf + slope * ((c.tw + c.b) / 2 - z); }

}  // namespace

std::span<const ChannelShape> channels() { return shapes; }

const ChannelShape* find_channel(std::string_view name) {
  const auto found = std::find_if(shapes.begin(), shapes.end(), [name](const ChannelShape& c) { return c.name == name; });
  return found == shapes.end() ? nullptr : &*found;
}

Fibers channel_fibers(const ChannelShape& c, const ShapeMesh& mesh, const Reference& material) {
  Fibers fibers;
  const double half = c.h / 2, inner = flange(c, c.tw), tip = flange(c, c.b);
  for (const double side : {1.0, -1.0}) {
    const Vector2 heel(side * half, c.tw), toe(side * half, c.b), root(side * (half - inner), c.tw), edge(side * (half - tip), c.b);
    const Quadrilateral corners = side > 0 ? Quadrilateral{root, heel, toe, edge} : Quadrilateral{heel, root, edge, toe};
    add_quadrilateral(fibers, corners, mesh.flange_layers, mesh.flange_width, material);
  }
  add_rectangle(fibers, {{-half, half}, {0, c.tw}}, mesh.web, 1, material, Spacing::exact);
  AreaMoments tabulated{c.A, Vector2(0, c.z), Matrix2::Zero()};
  tabulated.second.diagonal() << c.I_strong, c.I_weak;
  match_moments(fibers, tabulated);
  for (FiberDescription& fiber : fibers) fiber.z -= c.z;
  return fibers;
}

SectionOutline channel_outline(const ChannelShape& c) {
  const double half = c.h / 2, inner = flange(c, c.tw), tip = flange(c, c.b);
  SectionOutline outline{{-half, 0}, {half, 0}, {half, c.b}, {half - tip, c.b}, {half - inner, c.tw},
                         {inner - half, c.tw}, {tip - half, c.b}, {-half, c.b}};
  for (Vector2& point : outline) point.y() -= c.z;
  return outline;
}

}  // namespace nsframe
