// Dimensions and section properties of EN 10365 as published by European producers. Checked: the dimensions against a
// second table, A and both I against the exact properties of the drawn shape with its fillets (all within 0.05 %),
// J against the formula of El Darwish and Johnston (1965) that the producers' tables use (within their rounding).
#include "elements/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace nsframe {

namespace {

struct Row {
  std::string_view name;
  double h, b, tw, tf, r;      // [mm]
  double A;                    // [cm2]
  double I_strong, I_weak, J;  // [cm4]
};

// clang-format off
constexpr Row rows[] = {
    // name        h     b     tw     tf    r        A  I_strong   I_weak       J
    {"HEA100",     96,  100,     5,     8,  12,   21.24,    349.2,   133.8,   5.24},
    {"HEA120",    114,  120,     5,     8,  12,   25.34,    606.2,   230.9,   5.99},
    {"HEA140",    133,  140,   5.5,   8.5,  12,   31.42,     1033,   389.3,   8.13},
    {"HEA160",    152,  160,     6,     9,  15,   38.77,     1673,   615.6,  12.19},
    {"HEA180",    171,  180,     6,   9.5,  15,   45.25,     2510,   924.6,   14.8},
    {"HEA200",    190,  200,   6.5,    10,  18,   53.83,     3692,    1336,  20.98},
    {"HEA220",    210,  220,     7,    11,  18,   64.34,     5410,    1955,  28.46},
    {"HEA240",    230,  240,   7.5,    12,  21,   76.84,     7763,    2769,  41.55},
    {"HEA260",    250,  260,   7.5,  12.5,  24,   86.82,    10450,    3668,  52.37},
    {"HEA280",    270,  280,     8,    13,  24,   97.26,    13670,    4763,   62.1},
    {"HEA300",    290,  300,   8.5,    14,  27,  112.53,    18260,    6310,  85.17},
    {"HEA320",    310,  300,     9,  15.5,  27,  124.37,    22930,    6985,    108},
    {"HEA340",    330,  300,   9.5,  16.5,  27,  133.47,    27690,    7436,  127.2},
    {"HEA360",    350,  300,    10,  17.5,  27,  142.76,    33090,    7887,  148.8},
    {"HEA400",    390,  300,    11,    19,  27,  158.98,    45070,    8564,    189},
    {"HEA450",    440,  300,  11.5,    21,  27,  178.03,    63720,    9465,  243.8},
    {"HEA500",    490,  300,    12,    23,  27,  197.54,    86970,   10370,  309.3},
    {"HEA550",    540,  300,  12.5,    24,  27,  211.76,   111900,   10820,  351.5},
    {"HEA600",    590,  300,    13,    25,  27,  226.46,   141200,   11270,  397.8},
    {"HEA650",    640,  300,  13.5,    26,  27,  241.64,   175200,   11720,  448.3},
    {"HEA700",    690,  300,  14.5,    27,  27,  260.48,   215300,   12180,  513.9},
    {"HEA800",    790,  300,    15,    28,  30,  285.83,   303400,   12640,  596.9},
    {"HEA900",    890,  300,    16,    30,  30,  320.53,   422100,   13550,  736.8},
    {"HEA1000",   990,  300,  16.5,    31,  30,  346.85,   553800,   14000,  822.4},
    {"HEB100",    100,  100,     6,    10,  12,   26.04,    449.5,   167.3,  9.248},
    {"HEB120",    120,  120,   6.5,    11,  12,   34.01,    864.4,   317.5,  13.84},
    {"HEB140",    140,  140,     7,    12,  12,   42.96,     1509,   549.7,  20.06},
    {"HEB160",    160,  160,     8,    13,  15,   54.25,     2492,   889.2,  31.24},
    {"HEB180",    180,  180,   8.5,    14,  15,   65.25,     3831,    1363,  42.16},
    {"HEB200",    200,  200,     9,    15,  18,   78.08,     5696,    2003,  59.28},
    {"HEB220",    220,  220,   9.5,    16,  18,   91.04,     8091,    2843,  76.57},
    {"HEB240",    240,  240,    10,    17,  21,  105.99,    11260,    3923,  102.7},
    {"HEB260",    260,  260,    10,  17.5,  24,  118.44,    14920,    5135,  123.8},
    {"HEB280",    280,  280,  10.5,    18,  24,  131.36,    19270,    6595,  143.7},
    {"HEB300",    300,  300,    11,    19,  27,  149.08,    25170,    8563,    185},
    {"HEB320",    320,  300,  11.5,  20.5,  27,  161.34,    30820,    9239,  225.1},
    {"HEB340",    340,  300,    12,  21.5,  27,  170.90,    36660,    9690,  257.2},
    {"HEB360",    360,  300,  12.5,  22.5,  27,  180.63,    43190,   10140,  292.5},
    {"HEB400",    400,  300,  13.5,    24,  27,  197.78,    57680,   10820,  355.7},
    {"HEB450",    450,  300,    14,    26,  27,  217.98,    79890,   11720,  440.5},
    {"HEB500",    500,  300,  14.5,    28,  27,  238.64,   107200,   12620,  538.4},
    {"HEB550",    550,  300,    15,    29,  27,  254.06,   136700,   13080,  600.3},
    {"HEB600",    600,  300,  15.5,    30,  27,  269.96,   171000,   13530,  667.2},
    {"HEB650",    650,  300,    16,    31,  27,  286.34,   210600,   13980,  739.2},
    {"HEB700",    700,  300,    17,    32,  27,  306.38,   256900,   14440,  830.9},
    {"HEB800",    800,  300,  17.5,    33,  30,  334.18,   359100,   14900,    946},
    {"HEB900",    900,  300,  18.5,    35,  30,  371.28,   494100,   15820,   1137},
    {"HEB1000",  1000,  300,    19,    36,  30,  400.05,   644700,   16280,   1254},
    {"IPE80",      80,   46,   3.8,   5.2,   5,    7.64,    80.14,   8.489,    0.7},
    {"IPE100",    100,   55,   4.1,   5.7,   7,   10.32,      171,   15.92,    1.2},
    {"IPE120",    120,   64,   4.4,   6.3,   7,   13.21,    317.8,   27.67,   1.74},
    {"IPE140",    140,   73,   4.7,   6.9,   7,   16.43,    541.2,   44.92,   2.45},
    {"IPE160",    160,   82,     5,   7.4,   9,   20.09,    869.3,   68.31,    3.6},
    {"IPE180",    180,   91,   5.3,     8,   9,   23.95,     1317,   100.9,   4.79},
    {"IPE200",    200,  100,   5.6,   8.5,  12,   28.48,     1943,   142.4,   6.98},
    {"IPE220",    220,  110,   5.9,   9.2,  12,   33.37,     2772,   204.9,   9.07},
    {"IPE240",    240,  120,   6.2,   9.8,  15,   39.12,     3892,   283.6,  12.88},
    {"IPE270",    270,  135,   6.6,  10.2,  15,   45.95,     5790,   419.9,  15.94},
    {"IPE300",    300,  150,   7.1,  10.7,  15,   53.81,     8356,   603.8,  20.12},
    {"IPE330",    330,  160,   7.5,  11.5,  18,   62.61,    11770,   788.1,  28.15},
    {"IPE360",    360,  170,     8,  12.7,  18,   72.73,    16270,    1043,  37.32},
    {"IPE400",    400,  180,   8.6,  13.5,  21,   84.46,    23130,    1318,  51.08},
    {"IPE450",    450,  190,   9.4,  14.6,  21,   98.82,    33740,    1676,  66.87},
    {"IPE500",    500,  200,  10.2,    16,  21,  115.52,    48200,    2142,  89.29},
    {"IPE550",    550,  210,  11.1,  17.2,  24,  134.42,    67120,    2668,  123.2},
    {"IPE600",    600,  220,    12,    19,  24,  155.98,    92080,    3387,  165.4},
};
// clang-format on

// Division keeps the decimal value: 8.5 mm becomes the double nearest to 0.0085 m.
constexpr CatalogueShape in_meters(const Row& row) {
  constexpr double mm = 1e3, cm2 = 1e4, cm4 = 1e8;
  return {row.name,   row.h / mm,  row.b / mm,         row.tw / mm,      row.tf / mm,
          row.r / mm, row.A / cm2, row.I_strong / cm4, row.I_weak / cm4, row.J / cm4};
}

constexpr auto shapes = [] {
  std::array<CatalogueShape, std::size(rows)> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = in_meters(rows[i]);
  return all;
}();

// "he 140 a" and "HEA 140" become "HEA140".
std::string catalogue_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (!std::isspace(u)) name += static_cast<char>(std::toupper(u));
  }
  const bool en_order = name.size() > 3 && name.starts_with("HE") &&
                        std::isdigit(static_cast<unsigned char>(name[2])) && (name.back() == 'A' || name.back() == 'B');
  return en_order ? "HE" + name.substr(name.size() - 1) + name.substr(2, name.size() - 3) : name;
}

}  // namespace

const CatalogueShape* find_shape(std::string_view name) {
  const auto found =
      std::find_if(shapes.begin(), shapes.end(),
                   [key = catalogue_name(name)](const CatalogueShape& shape) { return shape.name == key; });
  return found == shapes.end() ? nullptr : &*found;
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const CatalogueShape& shape : shapes) names.emplace_back(shape.name);
  return names;
}

// Order: flange at +y, then at -y, each by layers away from the web, each layer by rising z; web by rising y; fillets.
std::vector<FiberDescription> shape_fibers(const CatalogueShape& shape, const ShapeMesh& mesh,
                                           const Reference& material) {
  const auto& [name, h, b, tw, tf, r, A, I_strong, I_weak, J] = shape;
  std::vector<FiberDescription> fibers;
  const double flange_area = b * tf / mesh.flange_width / mesh.flange_layers;
  for (const double side : {1.0, -1.0}) {
    for (int layer = 0; layer < mesh.flange_layers; ++layer) {
      const double y = side * (h / 2 - tf + (layer + 0.5) * tf / mesh.flange_layers);
      for (int i = 0; i < mesh.flange_width; ++i) {
        fibers.push_back({y, -b / 2 + (i + 0.5) * b / mesh.flange_width, flange_area, material});
      }
    }
  }
  const double web_depth = h - 2 * tf;
  for (int i = 0; i < mesh.web; ++i) {
    fibers.push_back({-web_depth / 2 + (i + 0.5) * web_depth / mesh.web, 0, tw * web_depth / mesh.web, material});
  }
  if (mesh.fillets) {
    // Spandrel between a quarter circle and its tangents: its centroid lies (10 - 3 pi)/(12 - 3 pi) r from each of
    // them.
    const double area = (1 - pi / 4) * r * r, centroid = 0.2234 * r;
    for (const double side : {1.0, -1.0}) {
      for (const double edge : {1.0, -1.0}) {
        fibers.push_back({side * (web_depth / 2 - centroid), edge * (tw / 2 + centroid), area, material});
      }
    }
  }
  return fibers;
}

SectionOutline shape_outline(const CatalogueShape& shape) {
  const double depth = shape.h / 2, root = shape.h / 2 - shape.tf, width = shape.b / 2, web = shape.tw / 2;
  return {{depth, -width}, {depth, width},   {root, width},   {root, web},   {-root, web}, {-root, width},
          {-depth, width}, {-depth, -width}, {-root, -width}, {-root, -web}, {root, -web}, {root, -width}};
}

}  // namespace nsframe
