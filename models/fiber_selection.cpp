#include "models/fiber_selection.hpp"

#include <fmt/format.h>

#include <charconv>
#include <map>

namespace nsframe {
namespace {

using Elements = std::map<std::string, ChosenFibers>;

int points_of(const Model& model, const ChosenFibers& element) {
  const auto places = model.groups[element.group]->fiber_places(element.element);
  return places.empty() ? 0 : places.back().point + 1;
}

// The number after the last ':' of a name, and the name before it; 0 without one.
std::pair<std::string, int> split(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  int number = 0;
  if (colon == std::string::npos) return {name, 0};
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + colon + 1, end, number);
  if (error != std::errc() || stop != end) return {name, 0};
  return {name.substr(0, colon), number};
}

std::string fault_of(const Model& model, const Elements& elements, const std::string& name, ChosenFibers& chosen) {
  auto found = elements.find(name);
  int number = 0;
  std::string element = name;
  if (found == elements.end()) {  // not an element whose own name has a colon
    std::tie(element, number) = split(name);
    found = elements.find(element);
  }
  if (found == elements.end()) {
    std::vector<std::string> known;
    for (const auto& [id, place] : elements) known.push_back(id);
    return fmt::format("there is no element '{}'{}", element, did_you_mean(element, known));
  }
  chosen = found->second;
  const int points = points_of(model, chosen);
  if (points == 0) return fmt::format("element '{}' has no fibers", element);
  if (element == name) return {};
  if (number < 1 || number > points) return fmt::format("element '{}' has integration points 1 to {}, not {}", element, points, number);
  chosen.point = number - 1;
  return {};
}

}  // namespace

std::vector<ChosenFibers> choose_fibers(const Model& model, const std::vector<std::string>& names,
                                        std::vector<std::string>& faults) {
  std::vector<ChosenFibers> chosen;
  Elements elements;
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    for (int e = 0; e < model.groups[g]->size(); ++e) {
      const ChosenFibers place{g, e, -1};
      elements.emplace(model.groups[g]->id(e), place);
      if (names.empty() && points_of(model, place) > 0) chosen.push_back(place);
    }
  }
  for (const std::string& name : names) {
    ChosenFibers place;
    std::string fault = fault_of(model, elements, name, place);
    if (fault.empty()) {
      chosen.push_back(place);
    } else {
      faults.push_back(std::move(fault));
    }
  }
  return chosen;
}

}  // namespace nsframe
