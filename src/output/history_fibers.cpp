#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "models/fiber_selection.hpp"
#include "output/history_parts.hpp"
#include "output/member_forces.hpp"

namespace nsframe {
namespace {

// Fibers [first, last) of an element.
struct FiberRun {
  std::size_t group;
  int element;
  std::size_t first, last;
};

struct FiberKind {
  std::vector<FiberRun> runs;
  std::vector<std::string> elements, materials;  // of each fiber
  std::vector<double> point, position, y, z, area;
};

class FiberPart : public HistoryPart {
 public:
  FiberPart(const Model& model, const std::vector<std::string>& names) {
    std::vector<std::string> faults;
    for (const ChosenFibers& chosen : choose_fibers(model, names, faults)) add(model, chosen);
    if (!faults.empty()) throw InputError(fmt::format("output.fibers: {}", fmt::join(faults, "\noutput.fibers: ")));
  }

  std::size_t widest_row() const override {
    std::size_t widest = 1;
    for (const auto& [name, kind] : kinds_) widest = std::max(widest, kind.y.size());
    return widest;
  }

  void create(Hdf5File& file, std::size_t block) override {
    file.make_group("/fibers");
    for (const auto& [name, kind] : kinds_) {
      const std::string folder = "/fibers/" + name;
      file.make_group(folder);
      file.write_texts(folder + "/element", kind.elements);
      file.write_texts(folder + "/material", kind.materials);
      const auto column = [&](const char* what, const std::vector<double>& values, const char* units) {
        file.write_numbers(folder + what, values);
        file.set_attribute(folder + what, "units", units);
      };
      column("/point", kind.point, "1");
      file.set_attribute(folder + "/point", "description", "integration point of the element, from 1 at its first node");
      column("/position", kind.position, "1");
      file.set_attribute(folder + "/position", "description", "of the point along the element, 0 at its first node, 1 at its second");
      column("/y", kind.y, "m");
      column("/z", kind.z, "m");
      column("/area", kind.area, "m2");
      add_series(file, folder + "/strain", {kind.y.size()}, block, "1");
      add_series(file, folder + "/stress", {kind.y.size()}, block, "Pa");
      add_series(file, folder + "/yielded", {kind.y.size()}, block, "1");
      file.set_attribute(folder + "/yielded", "description", "1 where the plastic strain exceeds a tenth of the yield strain, else 0");
    }
  }

  void add_row(const Model& model, const Sample& sample) override {
    const VectorX displacement = model.dofs.expand(sample.after.displacement);
    auto series = series_.begin();
    for (const auto& [name, kind] : kinds_) {
      double* strain = (series++)->add_row();
      double* stress = (series++)->add_row();
      double* yielded = (series++)->add_row();
      for (const FiberRun& run : kind.runs) {
        const ElementGroup& group = *model.groups[run.group];
        const auto states = group.fiber_states(run.element, element_displacement(group, run.element, displacement),
                                               element_history(model, run.group, run.element, sample.after));
        for (std::size_t i = run.first; i < run.last; ++i) {
          *strain++ = states[i].strain;
          *stress++ = states[i].stress;
          *yielded++ = states[i].yielded ? 1 : 0;
        }
      }
    }
  }

 private:
  void add(const Model& model, const ChosenFibers& chosen) {
    const ElementGroup& group = *model.groups[chosen.group];
    FiberKind& kind = kinds_[std::string(group.kind())];
    const auto places = group.fiber_places(chosen.element);
    const auto at_point = [&](int point) {
      return static_cast<std::size_t>(std::partition_point(places.begin(), places.end(), [point](const FiberPlace& place) { return place.point < point; }) - places.begin());
    };
    FiberRun run{chosen.group, chosen.element, 0, places.size()};
    if (chosen.point >= 0) run.first = at_point(chosen.point), run.last = at_point(chosen.point + 1);
    for (std::size_t i = run.first; i < run.last; ++i) {
      kind.elements.push_back(group.id(chosen.element));
      kind.materials.emplace_back(places[i].material);
      kind.point.push_back(places[i].point + 1);
      kind.position.push_back(places[i].position);
      kind.y.push_back(places[i].y);
      kind.z.push_back(places[i].z);
      kind.area.push_back(places[i].area);
    }
    kind.runs.push_back(run);
  }

  std::map<std::string, FiberKind> kinds_;
};

}  // namespace

std::unique_ptr<HistoryPart> fiber_history(const Model& model, const std::vector<std::string>& elements) {
  return std::make_unique<FiberPart>(model, elements);
}

}  // namespace nsframe
