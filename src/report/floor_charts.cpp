#include "report/floor_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "report/thinning.hpp"

namespace nsframe {
namespace {

constexpr std::size_t most_series = 8, most_nodes = 6;
constexpr double negligible = 1e-6;       // of the largest along any direction: such a chart is left out
constexpr double vertical_matters = 0.1;  // the same along z
constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};

struct Place {
  std::string name;
  int structure = 0;
  double level = 0;                  // [m]
  std::vector<std::size_t> columns;  // of its nodes in the histories
  int below = -1;                    // the floor below, an index into all places
  bool drawn = false;
  double tint = 0;
};

std::unordered_map<int, std::size_t> columns_of(const RunFolder& run) {
  std::unordered_map<int, std::size_t> columns;
  for (std::size_t i = 0; i < run.recorded.size(); ++i) columns[run.recorded[i]] = i;
  return columns;
}

// All floors whose nodes have histories, or some nodes where there is none.
std::vector<Place> places_of(const RunFolder& run) {
  const auto columns = columns_of(run);
  std::vector<Place> places;
  for (const DrawnModel::Level& floor : run.model.floors) {
    Place place{fmt::format("{}, z = {:g} m", run.model.structures[static_cast<std::size_t>(floor.structure)], floor.level),
                floor.structure,
                floor.level,
                {}};
    for (const int node : floor.nodes) {
      if (const auto found = columns.find(node); found != columns.end()) place.columns.push_back(found->second);
    }
    if (place.columns.size() < floor.nodes.size()) continue;
    if (!places.empty() && places.back().structure == place.structure) place.below = static_cast<int>(places.size()) - 1;
    places.push_back(std::move(place));
  }
  if (!places.empty()) return places;
  for (std::size_t i = 0; i < std::min(most_nodes, run.recorded.size()); ++i) {
    const auto node = static_cast<std::size_t>(run.recorded[i]);
    places.push_back({run.model.nodes[node], run.model.structure[node], run.model.position[3 * node + 2], {i}});
  }
  return places;
}

// Of each structure the roof and floors at even distances below it; the base, which has a floor above and none below, isn't one.
void choose(std::vector<Place>& places, std::size_t structures) {
  const std::size_t most = std::max<std::size_t>(1, most_series / std::max<std::size_t>(1, structures));
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first;
    while (last < places.size() && places[last].structure == places[first].structure) ++last;
    std::vector<std::size_t> floors;
    for (std::size_t i = first; i < last; ++i) {
      if (i > first || last - first == 1 || places[i].below < 0) floors.push_back(i);
    }
    if (floors.size() > 1 && places[floors[1]].below == static_cast<int>(floors[0])) floors.erase(floors.begin());
    const std::size_t count = std::min(most, floors.size());
    for (std::size_t k = 0; k < count; ++k) {
      Place& place = places[floors[floors.size() - 1 - k * floors.size() / count]];
      place.drawn = true;
      place.tint = count > 1 ? 0.62 * static_cast<double>(k) / static_cast<double>(count - 1) : 0;
    }
    first = last;
  }
}

struct Track {
  std::size_t place = 0;
  Thinner thinner;
  double largest = 0;
  void add(double value) {
    thinner.add(value);
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
};

// Histories of the drawn floors in one direction of one quantity.
struct SpectralQuantity {
  std::string title;
  const char* unit;
  double factor;
  std::vector<Track> tracks;

  double largest() const {
    double value = 0;
    for (const Track& track : tracks) value = std::max(value, track.largest);
    return value;
  }
};

class FloorReader {
 public:
  FloorReader(const RunFolder& run, std::vector<Place> places, std::size_t parts)
      : run_(run), places_(std::move(places)), means_(places_.size()) {
    const auto tracks = [&](bool with_floor_below) {
      std::vector<Track> list;
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (places_[i].drawn && (!with_floor_below || places_[i].below >= 0)) list.push_back({i, Thinner(run_.time.size(), parts)});
      }
      return list;
    };
    for (const char* along : axis_name)
      displacement_.push_back({fmt::format("Displacement along {}, relative to the base", along), "mm", 1e3, tracks(false)});
    for (std::size_t k = 0; k < 2; ++k)
      drift_.push_back({fmt::format("Story drift along {}", axis_name[k]), "% of the height", 100, tracks(true)});
    twist_.push_back({"Twist: rotation about z", "mrad", 1e3, tracks(false)});
    for (const char* along : axis_name)
      acceleration_.push_back({fmt::format("Absolute acceleration along {}", along), "m/s²", 1, tracks(false)});
  }

  void read() {
    read("/nodes/displacement", [&] {
      for (std::size_t k = 0; k < 3; ++k) add(displacement_[k], [&](const Track& track) { return means_[track.place][k]; });
      for (std::size_t k = 0; k < 2; ++k) {
        add(drift_[k], [&](const Track& track) {
          const Place& place = places_[track.place];
          const auto below = static_cast<std::size_t>(place.below);
          return (means_[track.place][k] - means_[below][k]) / (place.level - places_[below].level);
        });
      }
      add(twist_[0], [&](const Track& track) { return means_[track.place][5]; });
    });
    read("/nodes/acceleration_absolute", [&] {
      for (std::size_t k = 0; k < 3; ++k) add(acceleration_[k], [&](const Track& track) { return means_[track.place][k]; });
    });
  }

  std::vector<ChartGroup> groups(const std::string& note) {
    std::vector<ChartGroup> groups{
        {"displacement", "Displacement", note, charts(displacement_)},
        {"drift", "Story drift", "", charts(drift_, true)},
        {"twist", "Twist", "", charts(twist_)},
        {"acceleration", "Acceleration",
         "At an impact it is the jump of velocity over the step, and grows as the step shrinks; floor spectra don't.",
         charts(acceleration_)}};
    if (groups[2].charts.size() == 1 && !groups[1].charts.empty()) {  // beside the drifts
      groups[1].title = "Story drift and twist";
      groups[1].charts.push_back(std::move(groups[2].charts[0]));
      groups[2].charts.clear();
    }
    std::erase_if(groups, [](const ChartGroup& group) { return group.charts.empty(); });
    return groups;
  }

 private:
  template <class Value>
  void add(SpectralQuantity& quantity, const Value& value) {
    for (Track& track : quantity.tracks) track.add(value(track));
  }

  // Calls `row` with the means of all places set, for every row of the data set.
  template <class Row>
  void read(const char* name, const Row& row) {
    if (!run_.results.has(name)) return;
    const std::size_t width = 6 * run_.recorded.size(), rows = run_.time.size(), block = std::max<std::size_t>(1, (1U << 19U) / width);
    std::vector<double> values;
    for (std::size_t first = 0; first < rows; first += block) {
      const std::size_t count = std::min(block, rows - first);
      run_.results.read_rows(name, first, count, values);
      for (std::size_t i = 0; i < count; ++i) {
        set_means(values.data() + i * width);
        row();
      }
    }
  }

  void set_means(const double* row) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
      means_[p].fill(0);
      const double share = 1 / static_cast<double>(places_[p].columns.size());
      for (const std::size_t column : places_[p].columns) {
        for (std::size_t k = 0; k < 6; ++k) means_[p][k] += share * row[6 * column + k];
      }
    }
  }

  // `between`: floors, not of one.
  std::vector<ReportChart> charts(std::vector<SpectralQuantity>& quantities, bool between = false) {
    double largest = 0;
    for (const SpectralQuantity& quantity : quantities) largest = std::max(largest, quantity.largest());
    std::vector<ReportChart> charts;
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      SpectralQuantity& quantity = quantities[k];
      const double least = largest * (k == 2 ? vertical_matters : negligible);
      if (!(quantity.largest() > least) || quantity.largest() < 1e-12) continue;
      ReportChart chart{quantity.title, quantity.unit, "time, s", quantity.factor, true};
      for (Track& track : quantity.tracks) {
        const Place& place = places_[track.place];
        const auto below = static_cast<std::size_t>(std::max(0, place.below));
        ChartSeries series{between ? fmt::format("{}, {:g} to {:g} m", run_.model.structures[static_cast<std::size_t>(place.structure)],
                                                 places_[below].level, place.level)
                                   : place.name,
                           place.structure,
                           place.tint,
                           {},
                           track.thinner.values()};
        for (const std::size_t row : track.thinner.rows()) series.x.push_back(run_.time[row]);
        chart.series.push_back(std::move(series));
      }
      charts.push_back(std::move(chart));
    }
    return charts;
  }

  const RunFolder& run_;
  std::vector<Place> places_;
  std::vector<std::array<double, 6>> means_;  // of each place in the present row
  std::vector<SpectralQuantity> displacement_, drift_, twist_, acceleration_;
};

std::size_t count_drawn(const std::vector<Place>& places) {
  return static_cast<std::size_t>(std::count_if(places.begin(), places.end(), [](const Place& place) { return place.drawn; }));
}

}  // namespace

std::size_t drawn_floors(const RunFolder& run) {
  std::vector<Place> places = places_of(run);
  choose(places, run.model.structures.size());
  return count_drawn(places);
}

std::vector<ChartGroup> floor_charts(const RunFolder& run, std::size_t parts) {
  if (run.time.empty() || run.recorded.empty()) return {};
  std::vector<Place> places = places_of(run);
  choose(places, run.model.structures.size());
  const std::size_t drawn = count_drawn(places), floors = places.size();
  FloorReader reader(run, std::move(places), parts);
  reader.read();
  return reader.groups(drawn + run.model.structures.size() < floors ? fmt::format("{} of {} levels are drawn.", drawn, floors) : "");
}

}  // namespace nsframe
