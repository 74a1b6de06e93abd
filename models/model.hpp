// The mechanical model: built once by build_model(), then constant. What changes is in State.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "elements/element_group.hpp"
#include "models/contacts.hpp"
#include "models/description.hpp"
#include "models/dof_map.hpp"
#include "models/ground_motion.hpp"

namespace nsframe {

struct Nodes {
  std::vector<std::string> id;        // "structure.node"
  std::vector<Vector3> position;      // [m]
  std::vector<int> structure;         // index into Model::structures
  int size() const { return static_cast<int>(id.size()); }
};

// A slab, for contact and drawing.
struct Slab {
  std::string id;
  int structure = 0;                  // index into Model::structures
  int description = 0;                // index into ModelDescription::structures
  std::vector<int> corners;           // nodes, in order around the slab
  int center = -1;                    // node, or -1
  double thickness = 0.12;            // [m]
  bool rigid = false;
};

// A connected structure: its free DOFs are contiguous, and no stiffness or damping couples it to another one.
struct Structure {
  std::string name;
  Location at;
  int first_dof = 0, last_dof = 0;    // [first, last) free DOFs
  std::vector<int> nodes;
  DampingDescription damping;
  bool may_move_freely = false;
};

// What a unit displacement of moved supports does in the pseudo-static shape s that they give the structures (theory.md, 370).
struct SupportEffect {
  VectorX displacement;               // s, full DOFs [m/m, rad/m]; empty: the motion is one of the whole base
  VectorX force;                      // of linear elements there, free DOFs [N/m]; zero where all are linear
  VectorX gap;                        // of the contact pairs [m/m]
  VectorX damping;                    // of dashpots, free DOFs [N s/m]
  bool moves_gaps() const { return gap.size() > 0 && gap.cwiseAbs().maxCoeff() > 1e-12; }
};

struct Model {
  Nodes nodes;
  DofMap dofs;
  std::vector<Structure> structures;
  std::vector<Slab> slabs;
  std::vector<std::shared_ptr<const ElementGroup>> groups;  // of models made smaller: the same ones
  std::vector<int> history_begin;     // of each group in State::history, and its total size at the end
  SparseMatrix mass;                  // M, free DOFs [kg, kg m2]; diagonal unless constraints couple DOFs
  SparseMatrix viscous_damping;       // dashpots only [N s/m]
  VectorX nodal_mass;                 // full DOFs, before constraints, half a member's mass at each end [kg, kg m2]
  std::array<VectorX, 3> inertia;     // T' M iota, of a unit translation along x, y, z; free DOFs [kg]
  VectorX gravity_load;               // weights at nodes, and the loads on members of linear groups; free DOFs [N]
  bool gravity_statically_first = true;
  std::vector<GroundMotion> motions;
  std::vector<VectorX> motion_load;   // free DOFs, force of a unit acceleration: -T' M T iota [kg], one a motion
  std::vector<VectorX> driven;        // free DOFs that a motion prescribes, 1 m of it [m/m]; one a motion, empty for the whole base
  std::vector<SupportEffect> support_effects;  // one a motion, once the driven DOFs are taken out (src/assembly/moved_supports.hpp)
  MatrixX support_mass, support_stiffness;     // s_j' M s_k [kg], and s_j' K s_k of linear elements [N/m]; empty without moved supports
  Contacts contacts;
  std::vector<StaticStage> stages;
  VectorX initial_displacement, initial_velocity;  // free DOFs

  int history_size() const { return history_begin.back(); }
  bool drives_dofs() const;           // a motion prescribes free DOFs: `driven`
  bool moves_supports() const { return support_mass.size() > 0; }  // which have been taken out
  bool loaded() const;                // weights or loads on members act
  double total_mass() const;          // of all nodes along x [kg]
};

// Turns a description into a model. Every error of the description is reported to `diagnostics` with its place
// (missing references, duplicate ids, zero-length elements, unconnected or unstable parts, ...); throws InputError
// with all of them.
Model build_model(const ModelDescription& description, Diagnostics& diagnostics);

}  // namespace nsframe
