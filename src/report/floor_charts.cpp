#include "report/floor_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "plot/thinning.hpp"
#include "report/places.hpp"

namespace nsframe {
namespace {

constexpr double negligible = 1e-6;       // of the largest along any direction: such a chart is left out
constexpr double vertical_matters = 0.1;  // the same along z
constexpr std::array<const char*, 3> axis_name{"x", "y", "z"};

struct Track {
  std::size_t place = 0;
  Thinner thinner;
  double largest = 0;
  void add(double value) {
    thinner.add(value);
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
};

// Histories of the drawn places in one direction of one quantity.
struct Panel {
  RunChart chart;
  std::size_t component;  // of a node's six
  bool between;           // a floor and the one below, over the height between them
  std::vector<Track> tracks{};

  double largest() const {
    double value = 0;
    for (const Track& track : tracks) value = std::max(value, track.largest);
    return value;
  }
};

// What is asked for of one quantity.
struct FloorQuantity {
  ChartGroup group;
  const char* data;
  std::vector<Panel> panels;
  std::vector<Curve> orbits{};  // of each place; empty but for "orbit"
};

FloorQuantity quantity_of(const std::string& id) {
  const auto along = [](const char* title, const char* after, const char* name, const char* unit, double factor, std::size_t directions,
                        bool between) {
    std::vector<Panel> panels;
    for (std::size_t k = 0; k < directions; ++k) {
      Panel panel{chart_over_time(fmt::format("{} along {}{}", title, axis_name[k], after), name, unit, factor), k, between};
      panel.chart.direction = static_cast<int>(k);
      panels.push_back(std::move(panel));
    }
    return panels;
  };
  if (id == "displacement")
    return {{id, "Displacement", ""}, "/nodes/displacement", along("Displacement", ", relative to the base", "displacement", "mm", 1e3, 3, false)};
  if (id == "velocity")
    return {{id, "Velocity", ""}, "/nodes/velocity", along("Velocity", ", relative to the base", "velocity", "m/s", 1, 3, false)};
  if (id == "drift")
    return {{id, "Story drift", ""}, "/nodes/displacement", along("Story drift", "", "drift", "% of the height", 100, 2, true)};
  if (id == "twist") {
    return {{id, "Twist", ""}, "/nodes/displacement", {{chart_over_time("Twist: rotation about z", "rotation", "mrad", 1e3), 5, false}}};
  }
  if (id == "acceleration") {
    return {{id, "Acceleration", "At an impact it is the jump of velocity over the step, and grows as the step shrinks; floor spectra don't."},
            "/nodes/acceleration_absolute",
            along("Absolute acceleration", "", "acceleration", "m/s²", 1, 3, false)};
  }
  return {{id, "Orbit", ""}, "/nodes/displacement", {}};
}

class FloorReader {
 public:
  FloorReader(const RunFolder& run, const std::vector<Place>& places, const ChartChoice& choice)
      : run_(run), places_(places), choice_(choice), means_(places_.size()) {}

  void add(const std::string& id) {
    FloorQuantity quantity = quantity_of(id);
    for (Panel& panel : quantity.panels) {
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (places_[i].drawn && (!panel.between || places_[i].below >= 0))
          panel.tracks.push_back({i, Thinner(run_.time.size(), choice_.parts)});
      }
    }
    if (id == "orbit") quantity.orbits.resize(places_.size());
    quantities_.push_back(std::move(quantity));
  }

  void read() {
    for (const char* data : {"/nodes/displacement", "/nodes/velocity", "/nodes/acceleration_absolute"}) read(data);
  }

  std::vector<ChartGroup> groups() {
    std::vector<ChartGroup> groups;
    for (FloorQuantity& quantity : quantities_) {
      quantity.group.charts = quantity.orbits.empty() ? charts(quantity.panels) : orbit(quantity.orbits);
      groups.push_back(std::move(quantity.group));
    }
    return groups;
  }

 private:
  void read(const std::string& name) {
    if (!run_.results.has(name)) return;
    if (std::none_of(quantities_.begin(), quantities_.end(), [&](const FloorQuantity& q) { return q.data == name; })) return;
    const std::size_t width = 6 * run_.recorded.size(), rows = run_.time.size(), block = std::max<std::size_t>(1, (1U << 19U) / width);
    std::vector<double> values;
    for (std::size_t first = 0; first < rows; first += block) {
      const std::size_t count = std::min(block, rows - first);
      run_.read_rows(name, first, count, values);
      for (std::size_t i = 0; i < count; ++i) {
        set_means(values.data() + i * width);
        for (FloorQuantity& quantity : quantities_) {
          if (quantity.data == name) add_row(quantity);
        }
      }
    }
  }

  void add_row(FloorQuantity& quantity) {
    for (Panel& panel : quantity.panels) {
      for (Track& track : panel.tracks) track.add(value(panel, places_[track.place], means_[track.place][panel.component]));
    }
    for (std::size_t p = 0; p < quantity.orbits.size(); ++p) {
      if (!places_[p].drawn) continue;
      quantity.orbits[p].x.push_back(1e3 * means_[p][0]);
      quantity.orbits[p].y.push_back(1e3 * means_[p][1]);
    }
  }

  double value(const Panel& panel, const Place& place, double own) const {
    if (!panel.between) return own;
    const auto below = static_cast<std::size_t>(place.below);
    return (own - means_[below][panel.component]) / (place.level - places_[below].level);
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

  bool matters(const Panel& panel, double largest) const {
    if (panel.tracks.empty()) return false;
    if (choice_.direction >= 0 && panel.chart.direction >= 0) return panel.chart.direction == choice_.direction;
    if (panel.chart.direction < 0 && choice_.zeros) return true;
    return panel.largest() > largest * (panel.chart.direction == 2 ? vertical_matters : negligible) && panel.largest() >= 1e-12;
  }

  std::vector<RunChart> charts(std::vector<Panel>& panels) const {
    double largest = 0;
    for (const Panel& panel : panels) largest = std::max(largest, panel.largest());
    std::vector<RunChart> charts;
    for (Panel& panel : panels) {
      if (matters(panel, largest)) charts.push_back(chart(panel));
    }
    if (charts.empty() && choice_.zeros && choice_.direction < 0 && !panels.front().tracks.empty()) charts.push_back(chart(panels.front()));
    return charts;
  }

  RunChart chart(Panel& panel) const {
    RunChart chart = std::move(panel.chart);
    for (Track& track : panel.tracks) {
      const Place& place = places_[track.place];
      Curve curve = curve_of(place);
      curve.y = track.thinner.values();
      if (panel.between) {
        curve.name = fmt::format("{}, {:g} to {:g} m", run_.model.structures[static_cast<std::size_t>(place.structure)],
                                 places_[static_cast<std::size_t>(place.below)].level, place.level);
      }
      for (const std::size_t row : track.thinner.rows()) curve.x.push_back(run_.time[row]);
      chart.curves.push_back(std::move(curve));
    }
    return chart;
  }

  std::vector<RunChart> orbit(std::vector<Curve>& orbits) const {
    RunChart chart;
    chart.title = "Path in plan, relative to the base";
    chart.x_label = "displacement along x, mm";
    chart.y_label = "displacement along y, mm";
    chart.unit = "mm";
    chart.equal = true;
    for (std::size_t p = 0; p < orbits.size(); ++p) {
      if (orbits[p].x.empty()) continue;
      Curve curve = curve_of(places_[p]);
      curve.x = std::move(orbits[p].x), curve.y = std::move(orbits[p].y);
      chart.curves.push_back(std::move(curve));
    }
    return {std::move(chart)};
  }

  static Curve curve_of(const Place& place) {
    Curve curve{place.name};
    curve.colour = place.colour, curve.tint = place.tint;
    return curve;
  }

  const RunFolder& run_;
  const std::vector<Place>& places_;
  const ChartChoice& choice_;
  std::vector<std::array<double, 6>> means_;  // of each place in the present row
  std::vector<FloorQuantity> quantities_;
};

std::size_t count_drawn(const std::vector<Place>& places) {
  return static_cast<std::size_t>(std::count_if(places.begin(), places.end(), [](const Place& place) { return place.drawn; }));
}

}  // namespace

std::size_t drawn_floors(const RunFolder& run) { return count_drawn(places_of(run, {}, {})); }

std::vector<ChartGroup> floor_charts(const RunFolder& run, const std::vector<std::string>& quantities, const ChartChoice& choice) {
  if (run.time.empty() || run.recorded.empty()) return {};
  const std::vector<Place> places = places_of(run, choice.nodes, choice.floors);
  FloorReader reader(run, places, choice);
  for (const std::string& id : quantities) reader.add(id);
  reader.read();
  std::vector<ChartGroup> groups = reader.groups();
  const std::size_t drawn = count_drawn(places);
  if (!groups.empty() && drawn + run.model.structures.size() < places.size())
    groups.front().note = fmt::format("{} of {} levels are drawn.", drawn, places.size());
  return groups;
}

}  // namespace nsframe
