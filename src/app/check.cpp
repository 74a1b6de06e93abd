#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "app/commands.hpp"
#include "models/build_elements.hpp"

namespace nsframe::app {

namespace {

// "1 node", "2 nodes".
std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string counted(int count, const char* what) { return counted(static_cast<std::size_t>(count), what); }

void print_structure(const Model& model, const StructureModes& modes, std::size_t index) {
  const Structure& structure = model.structures[index];
  Vector3 mass = Vector3::Zero();
  for (const int node : structure.nodes) mass += model.nodal_mass.segment<3>(6 * node);
  fmt::print("structure '{}': {}, {}, mass {:.6g} kg\n", structure.name, counted(structure.nodes.size(), "node"),
             counted(structure.last_dof - structure.first_dof, "free DOF"), mass.maxCoeff());
  for (int i = 0; i < std::min(6, modes.modes.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    fmt::print("  mode {:<3} {:10.4f} Hz   damping {:6.3f} %   mass x {:5.1f} %  y {:5.1f} %  z {:5.1f} %\n", modes.names[at],
               modes.modes.circular_frequency[i] / (2 * pi), 100 * modes.damping_ratio[i], 100 * modes.participation[at].x(),
               100 * modes.participation[at].y(), 100 * modes.participation[at].z());
  }
}

// Initial stiffnesses; of fibers with E in A and I, as build_library() leaves them.
void print_sections(const ModelDescription& description) {
  Diagnostics none;  // build_model() has reported them
  for (const auto& [name, section] : build_library(description, none).sections) {
    const ElasticSection& e = section.elastic;
    fmt::print("section '{}': {}EA {:.5g} kN, EIz {:.5g} kN m2, EIy {:.5g} kN m2, GJ {:.5g} kN m2\n", name,
               section.fibers ? counted(section.fibers->fibers, "fiber") + ", " : "", e.E * e.A / 1e3, e.E * e.Iz / 1e3,
               e.E * e.Iy / 1e3, e.G * e.J / 1e3);
  }
}

void print_contacts(const Contacts& contacts) {
  fmt::print("contact pairs: {}\n", contacts.size());
  for (int i = 0; i < contacts.size(); ++i) {
    const ContactPair& pair = contacts.pairs[static_cast<std::size_t>(i)];
    fmt::print("  {:<32} gap {:8.4f} m   e = {:.3g}{}   normal ({:g}, {:g}, {:g}){}\n", pair.name, contacts.initial_gap[i],
               contacts.restitution[i], contacts.frictional() ? fmt::format("   mu = {:.3g}", contacts.friction[i]) : "", pair.normal.x() + 0.0, pair.normal.y() + 0.0, pair.normal.z() + 0.0,  // no -0
               pair.rigid_bodies ? "" : "   at points of flexible slabs or columns");
  }
}

void print_motion(const Model& model, std::size_t index) {
  const GroundMotion& motion = model.motions[index];
  double peak = 0;
  for (const double value : motion.acceleration) peak = std::max(peak, std::abs(value));
  fmt::print("motion '{}': {} samples, dt {:g} s, {:.3f} s, peak {:.4g} m/s2, direction ({:g}, {:g}, {:g})", motion.source,
             motion.acceleration.size(), motion.dt, motion.duration() - motion.start, peak, motion.direction.x(), motion.direction.y(),
             motion.direction.z());
  if (motion.start > 0) fmt::print(", from {:.6g} s on", motion.start);
  if (motion.of_supports) {
    std::set<int> nodes;
    for (int i = 0; i < model.dofs.size(); ++i) {
      if (model.driven[index][i] != 0) nodes.insert(model.dofs.free[static_cast<std::size_t>(i)].node);
    }
    fmt::print(", at {}:", counted(nodes.size(), "support"));
    for (const int node : nodes) fmt::print(" {}", model.nodes.id[static_cast<std::size_t>(node)]);
  }
  fmt::print("\n");
}

void print_solution(const LoadedScene& loaded, Simulation& simulation, const std::vector<std::string>& own) {
  const AnalysisOptions& analysis = loaded.scene.analysis;
  for (const StaticStage& stage : simulation.stages()) {
    fmt::print("static stage '{}': by {}{}, {}, first {:g}, last {:g}\n", stage.name, stage.options.control,
               stage.control_name.empty() ? "" : " at " + stage.control_name, counted(stage.options.targets.size(), "target"),
               stage.options.targets.front(), stage.options.targets.back());
  }
  if (!simulation.stages().empty() && !(simulation.duration() > 0)) return;
  const std::string name = simulation.scheme().name();
  if (!own.empty() && name != "moreau-jean") {
    fmt::print("scheme {}: {} {:g} ms, {} steps to {:g} s\n", name, name == "exact" ? "results every" : "dt =", 1e3 * analysis.dt,
               std::lround(simulation.duration() / analysis.dt), simulation.duration());
    fmt::print("  chosen because: {}\n", simulation.scheme_reason());
    for (const std::string& line : own) fmt::print("  {}\n", line);
    return;
  }
  fmt::print("scheme {}: theta = {:g}, gamma = {:g}, dt = {:g} ms, {} steps to {:g} s\n", name, analysis.theta,
             analysis.gamma, 1e3 * analysis.dt, std::lround(simulation.duration() / analysis.dt), simulation.duration());
  fmt::print("  chosen because: {}\n", simulation.scheme_reason());
  for (const std::string& line : own) fmt::print("  {}\n", line);
  const std::string algorithms = fmt::format("{}", fmt::join(analysis.algorithm, ", "));
  fmt::print("solution: {}; contact by {}\n",
             simulation.system().linear() ? std::string("linear, the iteration matrix is factored once")
                                          : "Newton-Raphson, the tangent is factored anew where it has changed too much; algorithms: " + algorithms,
             analysis.contact_solver == ContactSolverKind::active_set ? "an exact active-set method" : "projected Gauss-Seidel");
}

}  // namespace

int check(const SceneArguments& arguments) {
  const LoadedScene loaded = load(arguments);
  ReducedSimulation reduced(loaded.model, loaded.scene.analysis);
  Simulation& simulation = reduced.simulation();
  const Model& model = loaded.model;
  fmt::print("{}\n", loaded.scene.title.empty() ? arguments.scene.string() : loaded.scene.title);
  std::map<std::string, int> kinds;
  int elements = 0;
  for (const auto& group : model.groups) {
    std::string kind(group->kind());
    std::replace(kind.begin(), kind.end(), '_', ' ');
    kinds[kind] += group->size();
    elements += group->size();
  }
  const std::size_t fibers = static_cast<std::size_t>(simulation.system().assembler.fibers());
  fmt::print("{}, {}, {}{}\n", counted(model.nodes.size(), "node"), counted(elements, "element"),
             counted(reduced.held().dofs.size(), "free DOF"), fibers > 0 ? ", " + counted(fibers, "fiber") : "");
  for (const auto& [kind, count] : kinds) fmt::print("  {:<24} {}\n", kind, count);
  print_sections(loaded.scene.model);
  for (std::size_t i = 0; i < model.structures.size(); ++i) print_structure(reduced.held(), simulation.modes()[i], i);
  print_contacts(model.contacts);
  for (std::size_t i = 0; i < model.motions.size(); ++i) print_motion(model, i);
  if (const auto& calibration = loaded.scene.tables.calibration) {
    fmt::print("calibration: {}, {} measured (nsframe calibrate)\n", counted(calibration->parameters.size(), "parameter"),
               calibration->targets.size() == 1 ? "1 frequency" : fmt::format("{} frequencies", calibration->targets.size()));
  }
  print_solution(loaded, simulation, reduced.describe());
  return done;
}

}  // namespace nsframe::app
