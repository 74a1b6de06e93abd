#include "report/places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"

namespace nsframe {
namespace {

constexpr std::size_t most_floors = 8, most_nodes = 6;

// All floors whose nodes have histories.
std::vector<Place> all_floors(const RunFolder& run) {
  std::unordered_map<int, std::size_t> columns;
  for (std::size_t i = 0; i < run.recorded.size(); ++i) columns[run.recorded[i]] = i;
  std::vector<Place> places;
  for (const DrawnModel::Level& floor : run.model.floors) {
    Place place{fmt::format("{}, z = {:g} m", run.model.structures[static_cast<std::size_t>(floor.structure)], floor.level),
                floor.structure, floor.level};
    place.colour = floor.structure;
    for (const int node : floor.nodes) {
      if (const auto found = columns.find(node); found != columns.end()) place.columns.push_back(found->second);
    }
    if (place.columns.size() < floor.nodes.size()) continue;
    if (!places.empty() && places.back().structure == place.structure) place.below = static_cast<int>(places.size()) - 1;
    places.push_back(std::move(place));
  }
  return places;
}

Place node_place(const RunFolder& run, std::size_t column) {
  const auto node = static_cast<std::size_t>(run.recorded[column]);
  Place place{run.model.nodes[node], run.model.structure[node], run.model.position[3 * node + 2], {column}};
  place.drawn = true;
  return place;
}

// Of the floors of one structure the roof and some at even distances below it; the base, which has a floor above and none below, isn't one.
void choose(std::vector<Place>& places, std::size_t first, std::size_t last, std::size_t most) {
  std::vector<std::size_t> floors;
  for (std::size_t i = first; i < last; ++i) floors.push_back(i);
  if (floors.size() > 1) floors.erase(floors.begin());
  const std::size_t count = std::min(most, floors.size());
  for (std::size_t k = 0; k < count; ++k) {
    Place& place = places[floors[floors.size() - 1 - k * floors.size() / count]];
    place.drawn = true;
    place.tint = count > 1 ? 0.62 * static_cast<double>(k) / static_cast<double>(count - 1) : 0;
  }
}

// "left.2" for the floors of left; a structure's only floor is 1.
std::vector<std::string> floor_names(const RunFolder& run, const std::vector<Place>& places) {
  std::vector<std::string> names;
  int number = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool lowest = i == 0 || places[i - 1].structure != places[i].structure;
    const bool alone = lowest && (i + 1 == places.size() || places[i + 1].structure != places[i].structure);
    number = lowest ? (alone ? 1 : 0) : number + 1;
    names.push_back(fmt::format("{}.{}", run.model.structures[static_cast<std::size_t>(places[i].structure)], number));
  }
  return names;
}

std::size_t find_name(const char* what, const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(fmt::format("error: no history of {} '{}' in these results{}", what, name, did_you_mean(name, names)));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::vector<Place> places_of(const RunFolder& run, const std::vector<std::string>& nodes, const std::vector<std::string>& floors) {
  std::vector<Place> places;
  if (!nodes.empty()) {
    std::vector<std::string> names;
    for (const int node : run.recorded) names.push_back(run.model.nodes[static_cast<std::size_t>(node)]);
    for (const std::string& name : nodes) places.push_back(node_place(run, find_name("node", name, names)));
    return places;
  }
  places = all_floors(run);
  if (!floors.empty()) {
    const std::vector<std::string> names = floor_names(run, places);
    for (const std::string& name : floors) {
      Place& place = places[find_name("floor", name, names)];
      place.drawn = true;
      place.colour = -1;
    }
    return places;
  }
  if (places.empty()) {
    for (std::size_t i = 0; i < std::min(most_nodes, run.recorded.size()); ++i) places.push_back(node_place(run, i));
    return places;
  }
  const std::size_t most = std::max<std::size_t>(1, most_floors / std::max<std::size_t>(1, run.model.structures.size()));
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first;
    while (last < places.size() && places[last].structure == places[first].structure) ++last;
    choose(places, first, last, most);
    first = last;
  }
  return places;
}

}  // namespace nsframe
