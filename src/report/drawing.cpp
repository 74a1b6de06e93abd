#include "report/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "output/gap_offsets.hpp"

namespace nsframe {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_frames = 600, frame_bytes = 1500000, most_moments = 60;
constexpr double largest_integer = 32000, shown_part = 0.06;  // of the model's size, that the largest displacement is drawn as

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < left ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? letters[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

// Evenly spaced rows, the last included, and those nearest to the strongest poundings.
std::vector<std::size_t> frame_rows(const RunFolder& run) {
  const std::size_t rows = run.time.size(), nodes = std::max<std::size_t>(1, run.recorded.size());
  const std::size_t count = std::clamp<std::size_t>(frame_bytes / (12 * nodes), 20, most_frames);
  std::set<std::size_t> chosen;
  for (std::size_t k = 0; k < std::min(count, rows); ++k)
    chosen.insert(k * (rows - 1) / std::max<std::size_t>(1, std::min(count, rows) - 1));
  std::vector<std::pair<double, double>> moments;
  for (const Json& pounding : run.summary.at("poundings"))
    moments.emplace_back(-pounding.at("impulse").get<double>(), pounding.at("t").get<double>());
  std::sort(moments.begin(), moments.end());
  moments.resize(std::min({moments.size(), most_moments, count / 4}));
  for (const auto& moment : moments) {
    const auto after = std::lower_bound(run.time.begin(), run.time.end(), moment.second);
    chosen.insert(std::min<std::size_t>(static_cast<std::size_t>(after - run.time.begin()), rows - 1));
  }
  return {chosen.begin(), chosen.end()};
}

struct Motion {
  std::vector<double> values;       // of all frames, six a recorded node
  std::array<double, 2> largest{};  // displacement [m], rotation [rad]
};

Motion read_motion(const RunFolder& run, const std::vector<std::size_t>& rows) {
  Motion motion;
  std::vector<double> row;
  for (const std::size_t at : rows) {
    run.results.read_rows("/nodes/displacement", at, 1, row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!std::isfinite(row[i])) row[i] = 0;
      double& largest = motion.largest[i % 6 < 3 ? 0 : 1];
      largest = std::max(largest, std::abs(row[i]));
    }
    motion.values.insert(motion.values.end(), row.begin(), row.end());
  }
  return motion;
}

std::string packed(const Motion& motion, const std::array<double, 2>& unit) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * motion.values.size());
  for (std::size_t i = 0; i < motion.values.size(); ++i) {
    const auto value = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(motion.values[i] / unit[i % 6 < 3 ? 0 : 1])));
    bytes.push_back(static_cast<std::uint8_t>(value & 255U));
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
  }
  return base64(bytes);
}

// The largest of 1, 2, 5, 10, ... below it, at least 1.
double round_scale(double value) {
  if (!(value >= 1)) return 1;
  const double power = std::pow(10, std::floor(std::log10(std::min(value, 1e4))));
  const double first = std::min(value, 1e4) / power;
  return power * (first >= 5 ? 5 : first >= 2 ? 2 : 1);
}

double size_of(const DrawnModel& model) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double least = model.position[k], most = least;
    for (std::size_t i = 0; i < model.size(); ++i) {
      least = std::min(least, model.position[3 * i + k]);
      most = std::max(most, model.position[3 * i + k]);
    }
    squared += (most - least) * (most - least);
  }
  return std::sqrt(squared);
}

Json members_json(const DrawnModel& model) {
  Json members = Json::array();
  for (const DrawnModel::Member& m : model.members) {
    members.push_back(
        {{"nodes", m.nodes}, {"curved", m.curved}, {"ends", {{m.ends[0], m.ends[1], m.ends[2]}, {m.ends[3], m.ends[4], m.ends[5]}}}});
  }
  return members;
}

// Each pair with the recorded node that is nearest to it, of the structures that it joins.
Json pairs_json(const RunFolder& run) {
  const DrawnModel& model = run.model;
  Json pairs = Json::array();
  for (const DrawnModel::Pair& pair : model.pairs) {
    int nearest = -1;
    double least = 1e300;
    for (const int node : run.recorded) {
      const auto i = static_cast<std::size_t>(node);
      if (model.structure[i] != pair.structures[0] && model.structure[i] != pair.structures[1]) continue;
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) squared += std::pow(model.position[3 * i + k] - pair.position[k], 2);
      if (squared < least) least = squared, nearest = node;
    }
    pairs.push_back({{"position", pair.position}, {"node", nearest}});
  }
  return pairs;
}

Json offsets_json(const DrawnModel& model) {
  std::vector<StructureGap> gaps;
  for (const DrawnModel::Pair& pair : model.pairs)
    gaps.push_back({pair.structures[0], pair.structures[1], pair.gap * Vector3(pair.normal[0], pair.normal[1], pair.normal[2])});
  Json offsets = Json::array();
  for (const Vector3& offset : gap_offsets(model.structures.size(), gaps)) offsets.push_back({offset.x(), offset.y(), offset.z()});
  return offsets;
}

// Upright walls as rectangles from the lowest node to above the highest pair, wider than what may touch them, with the structure in
// front and the vector across the gap. The ground isn't one.
Json walls_json(const DrawnModel& model) {
  struct Wall {
    Vector3 normal = Vector3::Zero(), across = Vector3::Zero();
    double plane = 0, left = 1e300, right = -1e300, top = -1e300;
  };
  std::map<std::tuple<int, long, long, long>, Wall> walls;  // by structure, direction and place in micrometres
  for (const DrawnModel::Pair& pair : model.pairs) {
    const Vector3 normal(pair.normal[0], pair.normal[1], pair.normal[2]), at(pair.position[0], pair.position[1], pair.position[2]);
    if (pair.structures[1] >= 0 || std::abs(normal.z()) > 0.5) continue;
    const double plane = normal.dot(at) + pair.gap, along = Vector3::UnitZ().cross(normal).dot(at);
    const auto micro = [](double value) { return std::lround(1e6 * value); };
    Wall& wall = walls[{pair.structures[0], micro(normal.x()), micro(normal.y()), micro(plane)}];
    wall.normal = normal, wall.across = pair.gap * normal, wall.plane = plane;
    wall.left = std::min(wall.left, along), wall.right = std::max(wall.right, along), wall.top = std::max(wall.top, at.z());
  }
  double ground = model.position[2];
  for (std::size_t i = 0; i < model.size(); ++i) ground = std::min(ground, model.position[3 * i + 2]);
  const double beyond = 0.05 * size_of(model);
  Json list = Json::array();
  for (const auto& [key, wall] : walls) {
    const Vector3 along = Vector3::UnitZ().cross(wall.normal), foot = wall.plane * wall.normal;
    Json corners = Json::array();
    for (const auto& [side, z] : {std::pair{wall.left - beyond, ground}, {wall.right + beyond, ground}, {wall.right + beyond, wall.top + beyond},
                                  {wall.left - beyond, wall.top + beyond}}) {
      const Vector3 corner = foot + side * along + z * Vector3::UnitZ();
      corners.push_back({corner.x(), corner.y(), corner.z()});
    }
    list.push_back({{"corners", corners}, {"structure", std::get<0>(key)}, {"across", {wall.across.x(), wall.across.y(), wall.across.z()}}});
  }
  return list;
}

std::vector<int> loose_nodes(const DrawnModel& model) {
  std::set<int> with_members;
  for (const DrawnModel::Member& m : model.members) with_members.insert(model.structure[static_cast<std::size_t>(m.nodes[0])]);
  std::vector<int> nodes;
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (!with_members.contains(model.structure[i])) nodes.push_back(static_cast<int>(i));
  }
  return nodes;
}

}  // namespace

Json drawing(const RunFolder& run) {
  const DrawnModel& model = run.model;
  if (model.nodes.empty()) return nullptr;
  Json positions = Json::array();
  for (std::size_t i = 0; i < model.size(); ++i)
    positions.push_back({model.position[3 * i], model.position[3 * i + 1], model.position[3 * i + 2]});
  Json view = {{"position", positions},
               {"structure", model.structure},
               {"members", members_json(model)},
               {"slabs", model.slabs},
               {"points", loose_nodes(model)},
               {"recorded", run.recorded},
               {"pairs", pairs_json(run)},
               {"offsets", offsets_json(model)},
               {"walls", walls_json(model)},
               {"times", Json::array()},
               {"frames", ""},
               {"unit", {0, 0}},
               {"scale", 1},
               {"note", ""}};
  if (run.time.empty() || run.recorded.empty()) {
    view["note"] = run.summary.at("steps") == 0 ? "At rest: only a time history is drawn in motion."
                                                : "At rest: the motion is not in these results; history = [\"nodes\"] in [output] keeps it.";
    return view;
  }
  const std::vector<std::size_t> rows = frame_rows(run);
  const Motion motion = read_motion(run, rows);
  const std::array<double, 2> unit{std::max(motion.largest[0], 1e-300) / largest_integer,
                                   std::max(motion.largest[1], 1e-300) / largest_integer};
  std::vector<double> times;
  for (const std::size_t row : rows) times.push_back(run.time[row]);
  view["times"] = times;
  view["frames"] = packed(motion, unit);
  view["unit"] = unit;
  view["scale"] = round_scale(shown_part * size_of(model) / std::max(motion.largest[0], 1e-300));
  std::string note = fmt::format("Relative to the base; {} moments of {}, straight between them.", rows.size(), run.time.size());
  if (run.recorded.size() < model.size()) {
    note += fmt::format(" Only {} of {} nodes have histories; the rest does not move.", run.recorded.size(), model.size());
  }
  view["note"] = note;
  return view;
}

}  // namespace nsframe
