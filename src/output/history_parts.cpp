#include "output/history_parts.hpp"

#include <algorithm>

#include "models/dof_names.hpp"
#include "output/node_rows.hpp"

namespace nsframe {
namespace {

const std::vector<std::string> dof_names(node_dof_names.begin(), node_dof_names.end());

class NodePart : public HistoryPart {
 public:
  NodePart(const Model& model, const std::vector<std::string>& names, bool at_rest) : at_rest_(at_rest) {
    const auto nodes = find_nodes(model.nodes, names);
    for (const int node : nodes) ids_.push_back(model.nodes.id[static_cast<std::size_t>(node)]);
    rows_ = TransformationRows(model.dofs, full_dofs(nodes, {0, 1, 2, 3, 4, 5}));
  }

  std::size_t widest_row() const override { return 6 * ids_.size(); }

  void create(Hdf5File& file, std::size_t block) override {
    file.make_group("/nodes");
    file.write_texts("/nodes/id", ids_);
    const std::vector<hsize_t> shape{ids_.size(), 6};
    add_series(file, "/nodes/displacement", shape, block, "m, m, m, rad, rad, rad", dof_names);
    file.set_attribute("/nodes/displacement", "relative_to", "base");
    if (at_rest_) return;
    add_series(file, "/nodes/velocity", shape, block, "m/s, m/s, m/s, rad/s, rad/s, rad/s", dof_names);
    add_series(file, "/nodes/acceleration_absolute", shape, block, "m/s2, m/s2, m/s2, rad/s2, rad/s2, rad/s2",
               dof_names);
    file.set_attribute("/nodes/velocity", "relative_to", "base");
    file.set_attribute("/nodes/acceleration_absolute", "description",
                       "velocity difference over the step divided by dt, plus that of the ground; 0 in the first row");
  }

  void add_row(const Model& model, const Sample& sample) override {
    rows_.multiply(sample.after.displacement.data(), series_[0].add_row());
    if (at_rest_) return;
    rows_.multiply(sample.after.velocity.data(), series_[1].add_row());
    double* absolute = series_[2].add_row();  // zeros
    if (sample.dt <= 0) return;
    acceleration_ = (sample.after.velocity - sample.before.velocity) / sample.dt;
    rows_.multiply(acceleration_.data(), absolute);
    const Vector3 ground =
        (ground_velocity(model, sample.after.time) - ground_velocity(model, sample.before.time)) / sample.dt;
    for (std::size_t node = 0; node < ids_.size(); ++node) {
      for (std::size_t k = 0; k < 3; ++k) absolute[6 * node + k] += ground[static_cast<Eigen::Index>(k)];
    }
  }

 private:
  bool at_rest_;
  std::vector<std::string> ids_;
  TransformationRows rows_;
  VectorX acceleration_;
};

class ContactPart : public HistoryPart {
 public:
  explicit ContactPart(const Model& model) {
    for (const auto& pair : model.contacts.pairs) names_.push_back(pair.name);
  }

  std::size_t widest_row() const override { return names_.size(); }

  void create(Hdf5File& file, std::size_t block) override {
    file.make_group("/contacts");
    file.write_texts("/contacts/pair", names_);
    if (names_.empty()) return;
    add_series(file, "/contacts/gap", {names_.size()}, block, "m");
    add_series(file, "/contacts/impulse", {names_.size()}, block, "N s");
    file.set_attribute("/contacts/impulse", "description", "over the time since the row before");
  }

  void add_row(const Model& model, const Sample& sample) override {
    if (names_.empty()) return;
    const auto size = static_cast<Eigen::Index>(names_.size());
    Eigen::Map<VectorX> gap(series_[0].add_row(), size), impulse(series_[1].add_row(), size);
    gap = model.contacts.initial_gap;
    gap.noalias() += model.contacts.jacobian * sample.after.displacement;
    impulse = sample.impulse;
  }

 private:
  std::vector<std::string> names_;
};

constexpr double Energy::*energy_terms[] = {&Energy::kinetic, &Energy::strain,    &Energy::damping,
                                            &Energy::contact, &Energy::friction, &Energy::numerical, &Energy::input};
constexpr const char* energy_names[] = {"kinetic", "strain", "damping", "contact", "friction", "numerical", "input"};

class EnergyPart : public HistoryPart {
 public:
  std::size_t widest_row() const override { return 1; }

  void create(Hdf5File& file, std::size_t block) override {
    for (const char* name : energy_names) add_series(file, std::string("/energy/") + name, {}, block, "J");
    add_series(file, "/energy/balance_error", {}, block, "J");
  }

  void add_row(const Model&, const Sample& sample) override {
    for (std::size_t i = 0; i < std::size(energy_terms); ++i) *series_[i].add_row() = sample.energy.*energy_terms[i];
    *series_.back().add_row() = sample.energy.balance_error();
  }
};

class GroundPart : public HistoryPart {
 public:
  std::size_t widest_row() const override { return 3; }

  void create(Hdf5File& file, std::size_t block) override {
    add_series(file, "/ground/acceleration", {3}, block, "m/s2", {"x", "y", "z"});
    add_series(file, "/ground/velocity", {3}, block, "m/s", {"x", "y", "z"});
  }

  void add_row(const Model& model, const Sample& sample) override {
    Eigen::Map<Vector3>(series_[0].add_row()) = ground_acceleration(model, sample.after.time);
    Eigen::Map<Vector3>(series_[1].add_row()) = ground_velocity(model, sample.after.time);
  }
};

}  // namespace

Hdf5Series<double>& HistoryPart::add_series(Hdf5File& file, const std::string& name, std::vector<hsize_t> shape,
                                            std::size_t block, const std::string& units,
                                            const std::vector<std::string>& components) {
  series_.emplace_back(file, name, std::move(shape), block);
  file.set_attribute(name, "units", units);
  if (!components.empty()) file.set_attribute(name, "components", components);
  return series_.back();
}

std::unique_ptr<HistoryPart> node_history(const Model& model, const std::vector<std::string>& nodes, bool at_rest) {
  return std::make_unique<NodePart>(model, nodes, at_rest);
}

std::unique_ptr<HistoryPart> contact_history(const Model& model) { return std::make_unique<ContactPart>(model); }

std::unique_ptr<HistoryPart> energy_history() { return std::make_unique<EnergyPart>(); }

std::unique_ptr<HistoryPart> ground_history(const Model&) { return std::make_unique<GroundPart>(); }

ImpactRows::ImpactRows(Hdf5File& file, const Contacts& contacts) : pair_(file, "/impacts/pair", {}, 256) {
  const std::pair<const char*, const char*> columns[] = {
      {"time", "s"}, {"approach_velocity", "m/s"}, {"impulse", "N s"}, {"rate_before", "m/s"}, {"rate_after", "m/s"}, {"duration", "s"}};
  for (const auto& [name, units] : columns) {
    const std::string path = std::string("/impacts/") + name;
    columns_.emplace_back(file, path, std::vector<hsize_t>{}, 256);
    file.set_attribute(path, "units", units);
  }
  std::vector<std::string> names;
  for (const auto& pair : contacts.pairs) names.push_back(pair.name);
  if (!names.empty()) file.set_attribute("/impacts/pair", "names", names);
}

void ImpactRows::add(const Impact& impact) {
  *pair_.add_row() = impact.pair;
  const double values[] = {impact.time, impact.approach_velocity, impact.impulse, impact.rate_before,
                           impact.rate_after, impact.duration};
  for (std::size_t i = 0; i < columns_.size(); ++i) *columns_[i].add_row() = values[i];
}

void ImpactRows::write() {
  pair_.write();
  for (auto& column : columns_) column.write();
}

void ImpactRows::truncate(hsize_t rows) {
  pair_.truncate(rows);
  for (auto& column : columns_) column.truncate(rows);
}

void write_poundings(Hdf5File& file, const std::vector<Pounding>& poundings) {
  file.make_group("/poundings");
  const auto column = [&](const char* name, const char* units, auto value) {
    std::vector<double> values;
    for (const auto& pounding : poundings) values.push_back(static_cast<double>(value(pounding)));
    const std::string path = std::string("/poundings/") + name;
    file.write_numbers(path, values);
    file.set_attribute(path, "units", units);
  };
  column("time", "s", [](const Pounding& p) { return p.time; });
  column("duration", "s", [](const Pounding& p) { return p.duration; });
  column("pair", "1", [](const Pounding& p) { return p.pair; });
  column("approach_velocity", "m/s", [](const Pounding& p) { return p.approach_velocity; });
  column("impulse", "N s", [](const Pounding& p) { return p.impulse; });
  column("effective_restitution", "1", [](const Pounding& p) { return p.effective_restitution; });
  column("impacts", "1", [](const Pounding& p) { return p.impacts; });
}

void write_final_energy(Hdf5File& file, const Energy& energy) {
  for (std::size_t i = 0; i < std::size(energy_terms); ++i) {
    file.set_attribute("/energy", energy_names[i], energy.*energy_terms[i]);
  }
  file.set_attribute("/energy", "initial", energy.initial);
  file.set_attribute("/energy", "balance_error", energy.balance_error());
  file.set_attribute("/energy", "units", "J");
}

void write_floor_spectra(Hdf5File& file, const FloorSpectra& spectra) {
  const std::string folder = "/floor_spectra";
  file.make_group(folder);
  file.set_attribute(folder, "damping", spectra.damping());
  file.write_texts(folder + "/node", spectra.nodes());
  file.write_numbers(folder + "/period", spectra.periods());
  file.set_attribute(folder + "/period", "units", "s");
  const std::vector<hsize_t> shape{spectra.nodes().size(), 3, spectra.periods().size()};
  const auto column = [&](const char* name, const char* units, const char* description, auto value) {
    std::vector<double> all;
    for (std::size_t node = 0; node < spectra.nodes().size(); ++node) {
      for (int direction = 0; direction < 3; ++direction) {
        const std::vector<double> values = value(spectra.displacement(node, direction));
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    file.write_numbers(folder + name, all, shape);
    file.set_attribute(folder + name, "units", units);
    file.set_attribute(folder + name, "components", std::vector<std::string>{"x", "y", "z"});
    file.set_attribute(folder + name, "description", description);
  };
  column("/displacement", "m", "largest, relative to the floor", [](const auto& peak) { return peak; });
  column("/pseudo_velocity", "m/s", "2 pi / period times displacement", [&](const auto& peak) { return pseudo_velocity(spectra.periods(), peak); });
  column("/pseudo_acceleration", "m/s2", "(2 pi / period)^2 times displacement", [&](const auto& peak) { return pseudo_acceleration(spectra.periods(), peak); });
}

void mark_finished(Hdf5File& file) { file.set_attribute("/", "finished", 1.0); }

}  // namespace nsframe
