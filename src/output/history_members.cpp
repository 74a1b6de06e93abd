#include <algorithm>
#include <map>

#include "output/history_parts.hpp"
#include "output/member_forces.hpp"

namespace nsframe {
namespace {

struct Member {
  std::size_t group;
  int element;
};

// Elements of all groups by kind, in the order of the model.
std::map<std::string, std::vector<Member>> members_by_kind(const Model& model) {
  std::map<std::string, std::vector<Member>> kinds;
  for (std::size_t g = 0; g < model.groups.size(); ++g) {
    auto& members = kinds[std::string(model.groups[g]->kind())];
    for (int e = 0; e < model.groups[g]->size(); ++e) members.push_back({g, e});
  }
  return kinds;
}

std::vector<SectionResult> sections_of(const Model& model, const Member& member, const State& state,
                                       const VectorX& displacement) {
  const ElementGroup& group = *model.groups[member.group];
  return group.sections(member.element, element_displacement(group, member.element, displacement),
                        element_history(model, member.group, member.element, state));
}

class ElementPart : public HistoryPart {
 public:
  explicit ElementPart(const Model& model) : kinds_(members_by_kind(model)) {
    for (const auto& [kind, members] : kinds_) {
      std::vector<std::string> ids;
      for (const auto& [g, e] : members) ids.push_back(model.groups[g]->id(e));
      ids_.push_back(std::move(ids));
    }
  }

  std::size_t widest_row() const override {
    std::size_t widest = 1;
    for (const auto& [kind, members] : kinds_) widest = std::max(widest, 12 * members.size());
    return widest;
  }

  void create(Hdf5File& file, std::size_t block) override {
    file.make_group("/elements");
    std::size_t index = 0;
    for (const auto& [kind, members] : kinds_) {
      const std::string folder = "/elements/" + kind;
      file.make_group(folder);
      file.write_texts(folder + "/id", ids_[index++]);
      add_series(file, folder + "/forces", {members.size(), 12}, block,
                 "N, N, N, N m, N m, N m, N, N, N, N m, N m, N m",
                 {"N_i", "VY_i", "VZ_i", "T_i", "MY_i", "MZ_i", "N_j", "VY_j", "VZ_j", "T_j", "MY_j", "MZ_j"});
      file.set_attribute(folder + "/forces", "description", "of the nodes on the ends of the element, its local axes");
    }
  }

  void add_row(const Model& model, const Sample& sample) override {
    const VectorX displacement = model.dofs.expand(sample.after.displacement);
    auto series = series_.begin();
    for (const auto& [kind, members] : kinds_) {
      double* row = (series++)->add_row();
      for (const auto& [g, e] : members) {
        row = std::copy_n(end_forces_.evaluate(model, g, e, sample.after, displacement).data(), 12, row);
      }
    }
  }

 private:
  std::map<std::string, std::vector<Member>> kinds_;
  std::vector<std::vector<std::string>> ids_;
  EndForces end_forces_;
};

struct SectionKind {
  std::string name;
  std::vector<Member> members;
  std::vector<std::string> elements;  // of each section
  std::vector<double> positions;
  bool with_shear = false;            // some section has laws of shear or torsion
};

class SectionPart : public HistoryPart {
 public:
  SectionPart(const Model& model, const State& state) {
    const VectorX displacement = model.dofs.expand(state.displacement);
    for (const auto& [name, members] : members_by_kind(model)) {
      SectionKind kind{name, {}, {}, {}, false};
      for (const auto& member : members) {
        const auto sections = sections_of(model, member, state, displacement);
        if (sections.empty()) continue;
        kind.members.push_back(member);
        for (const auto& section : sections) {
          kind.elements.push_back(model.groups[member.group]->id(member.element));
          kind.positions.push_back(section.position);
          kind.with_shear = kind.with_shear || section.with_shear;
        }
      }
      if (!kind.members.empty()) kinds_.push_back(std::move(kind));
    }
  }

  std::size_t widest_row() const override {
    std::size_t widest = 1;
    for (const auto& kind : kinds_) widest = std::max(widest, 3 * kind.positions.size());
    return widest;
  }

  void create(Hdf5File& file, std::size_t block) override {
    file.make_group("/sections");
    for (const auto& kind : kinds_) {
      const std::string folder = "/sections/" + kind.name;
      const hsize_t points = kind.positions.size();
      file.make_group(folder);
      file.write_texts(folder + "/element", kind.elements);
      file.write_numbers(folder + "/position", kind.positions);
      file.set_attribute(folder + "/position", "description",
                         "along the element, 0 at its first node, 1 at its second");
      add_series(file, folder + "/deformation", {points, 3}, block, "1, 1/m, 1/m", {"e0", "kz", "ky"});
      add_series(file, folder + "/force", {points, 3}, block, "N, N m, N m", {"N", "MZ", "MY"});
      if (kind.with_shear) {
        add_series(file, folder + "/shear_deformation", {points, 3}, block, "1, 1, rad/m", {"gamma_y", "gamma_z", "twist"});
        add_series(file, folder + "/shear_force", {points, 3}, block, "N, N, N m", {"VY", "VZ", "T"});
        file.set_attribute(folder + "/shear_deformation", "description", "of the laws beside the fibers; 0 where a section is rigid in shear");
        file.set_attribute(folder + "/shear_force", "description", "derivatives of MZ and MY along the element, and torsion");
      }
      add_series(file, folder + "/peak_strain_ratio", {points}, block, "1");
      add_series(file, folder + "/yielded", {points}, block, "1");
      file.set_attribute(folder + "/peak_strain_ratio", "description",
                         "largest strain of a fiber over its yield strain, at that time (not an envelope)");
      file.set_attribute(folder + "/yielded", "description",
                         "1 where a fiber's plastic strain exceeds a tenth of its yield strain, else 0");
    }
  }

  void add_row(const Model& model, const Sample& sample) override {
    const VectorX displacement = model.dofs.expand(sample.after.displacement);
    auto series = series_.begin();
    for (const auto& kind : kinds_) {
      double* deformation = (series++)->add_row();
      double* force = (series++)->add_row();
      double* shear = kind.with_shear ? (series++)->add_row() : nullptr;
      double* shear_force = kind.with_shear ? (series++)->add_row() : nullptr;
      double* strain_ratio = (series++)->add_row();
      double* yielded = (series++)->add_row();
      for (const auto& member : kind.members) {
        for (const auto& section : sections_of(model, member, sample.after, displacement)) {
          deformation = std::copy_n(section.deformation.data(), 3, deformation);
          force = std::copy_n(section.force.data(), 3, force);
          if (kind.with_shear) {
            shear = std::copy_n(section.shear_deformation.data(), 3, shear);
            shear_force = std::copy_n(section.shear_force.data(), 3, shear_force);
          }
          *strain_ratio++ = section.peak_strain_ratio;
          *yielded++ = section.yielded;
        }
      }
    }
  }

 private:
  std::vector<SectionKind> kinds_;
};

}  // namespace

std::unique_ptr<HistoryPart> member_history(const Model& model) { return std::make_unique<ElementPart>(model); }

std::unique_ptr<HistoryPart> section_history(const Model& model, const State& state) {
  return std::make_unique<SectionPart>(model, state);
}

}  // namespace nsframe
