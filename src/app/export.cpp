#include <fmt/format.h>

#include <iterator>

#include "app/commands.hpp"
#include "models/dof_names.hpp"

namespace nsframe::app {

namespace {

// Matrix Market coordinate format, all entries.
template <class Matrix>
std::string matrix_market(const Matrix& matrix, const std::string& comment) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real general\n% {}\n{} {} {}\n", comment, matrix.rows(),
                                 matrix.cols(), matrix.nonZeros());
  for (int k = 0; k < matrix.outerSize(); ++k) {
    for (typename Matrix::InnerIterator entry(matrix, k); entry; ++entry) {
      fmt::format_to(std::back_inserter(text), "{} {} {:.17g}\n", entry.row() + 1, entry.col() + 1, entry.value());
    }
  }
  return text;
}

std::string array_market(const MatrixX& matrix, const std::string& comment) {
  std::string text = fmt::format("%%MatrixMarket matrix array real general\n% {}\n{} {}\n", comment, matrix.rows(), matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) fmt::format_to(std::back_inserter(text), "{:.17g}\n", matrix(i, j));
  }
  return text;
}

// C of the whole model: dashpots, Rayleigh, and the modal part U U' written out.
SparseMatrix damping_matrix(const System& system) {
  std::vector<Eigen::Triplet<double>> entries;
  SparseMatrix viscous = system.damping.viscous;
  if (system.damping.follows_tangent()) viscous += system.damping.tangent;
  for (int k = 0; k < viscous.outerSize(); ++k) {
    for (SparseMatrix::InnerIterator entry(viscous, k); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(entry.col()), entry.value());
    }
  }
  for (std::size_t s = 0; s < system.damping.modal.size(); ++s) {
    const MatrixX part = system.damping.modal[s] * system.damping.modal[s].transpose();
    const int first = system.assembler.blocks()[s].first;
    for (Eigen::Index j = 0; j < part.cols(); ++j) {
      for (Eigen::Index i = 0; i < part.rows(); ++i) {
        if (part(i, j) != 0) entries.emplace_back(first + static_cast<int>(i), first + static_cast<int>(j), part(i, j));
      }
    }
  }
  SparseMatrix C(viscous.rows(), viscous.cols());
  C.setFromTriplets(entries.begin(), entries.end());
  return C;
}

std::string dof_table(const Model& model) {
  std::string text = "dof,node,direction\n";
  for (std::size_t i = 0; i < model.dofs.free.size(); ++i) {
    const FreeDof& dof = model.dofs.free[i];
    text += fmt::format("{},{},{}\n", i + 1, model.nodes.id[static_cast<std::size_t>(dof.node)], node_dof_names[static_cast<std::size_t>(dof.direction)]);
  }
  return text;
}

std::string contact_table(const Contacts& contacts) {
  std::string text = "pair,name,gap_m,restitution,friction\n";
  for (int i = 0; i < contacts.size(); ++i) {
    text += fmt::format("{},{},{:.17g},{:.17g},{:.17g}\n", i + 1, contacts.pairs[static_cast<std::size_t>(i)].name, contacts.initial_gap[i],
                        contacts.restitution[i], contacts.frictional() ? contacts.friction[i] : 0);
  }
  return text;
}

}  // namespace

int export_matrices(const SceneArguments& arguments) {
  const LoadedScene loaded = load_at_rest(arguments);
  Simulation simulation(loaded.model, loaded.scene.analysis);
  const System& system = simulation.system();
  const std::filesystem::path folder = output_folder(arguments);
  make_folder(folder);
  MatrixX loads(loaded.model.dofs.size(), 1 + static_cast<Eigen::Index>(loaded.model.motion_load.size()));
  loads.col(0) = system.static_load;
  for (std::size_t i = 0; i < loaded.model.motion_load.size(); ++i) loads.col(1 + static_cast<Eigen::Index>(i)) = loaded.model.motion_load[i];
  write_text(folder / "M.mtx", matrix_market(system.mass(), "mass [kg, kg m2], free DOFs"));
  write_text(folder / "C.mtx", matrix_market(damping_matrix(system), "damping [N s/m], free DOFs"));
  write_text(folder / "K.mtx", matrix_market(simulation.initial_stiffness(), "tangent stiffness after static loads [N/m], free DOFs"));
  write_text(folder / "H.mtx", matrix_market(loaded.model.contacts.jacobian, "contact Jacobian: gap rate = H velocity"));
  write_text(folder / "loads.mtx", array_market(loads, "column 1: static load [N]; others: load of a unit base acceleration, one a motion [kg]"));
  write_text(folder / "dofs.csv", dof_table(loaded.model));
  write_text(folder / "contacts.csv", contact_table(loaded.model.contacts));
  write_text(folder / "scene_expanded.toml", write_expanded_scene(loaded.scene, folder));
  if (!arguments.quiet) {
    fmt::print("M.mtx, C.mtx, K.mtx, H.mtx, loads.mtx, dofs.csv, contacts.csv and scene_expanded.toml are in {}\n", folder.string());
  }
  return done;
}

int reference() {
  fmt::print("{}", scene_reference());
  return done;
}

}  // namespace nsframe::app
