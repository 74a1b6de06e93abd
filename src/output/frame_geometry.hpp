// What is drawn of a model: members swept with their outlines, slabs as plates, contact pairs as lines. The points of
// the drawing hang on stations (cross-sections and nodes) whose motion is linear in the DOFs of the nodes, so that a
// frame costs one sparse product and one cross product a point. Corotational beams are placed one by one.
#pragma once

#include <string>
#include <vector>

#include "models/model.hpp"
#include "models/state.hpp"

namespace nsframe {

enum class CellType : unsigned char { line = 3, triangle = 5, quad = 9 };  // VTK's numbers

// Codes of the cell field `kind`; the kinds of element groups follow.
inline constexpr int kind_contact = 0, kind_slab = 1, kind_first_element = 2;

// Cells [first_cell, last_cell) draw one element.
struct DrawnElement {
  std::size_t group = 0;
  int element = 0;
  int first_cell = 0, last_cell = 0;
};

// A beam that turns by any amount: its points [first_point, last_point) are placed by its pose.
struct FiniteMember {
  std::size_t group = 0;
  int element = 0;
  int first_point = 0, last_point = 0;
  int segments = 0;
};

struct FrameGeometry {
  std::vector<Vector3> position;  // of each point [m]
  std::vector<int> station;       // of each point
  std::vector<Vector3> arm;       // of each point from its station, global axes [m]
  SparseRows station_motion;      // (6 stations x full DOFs): ux uy uz rx ry rz in global axes

  std::vector<CellType> type;     // of each cell
  std::vector<int> connectivity;  // points of all cells, one cell after the other
  std::vector<int> offset{0};     // of each cell in `connectivity`, and its size at the end
  std::vector<int> kind;          // of each cell: index into kind_names
  std::vector<int> element;       // index into element_ids, or -1
  std::vector<int> pair;          // contact pair, or -1
  std::vector<int> structure;
  std::vector<double> along;  // place of the cell's middle along its element, in [0, 1]

  std::vector<DrawnElement> drawn;
  std::vector<FiniteMember> finite;
  std::vector<std::string> kind_names;
  std::vector<std::string> element_ids;

  int points() const { return static_cast<int>(position.size()); }
  int stations() const { return static_cast<int>(station_motion.rows() / 6); }
  int cells() const { return static_cast<int>(type.size()); }
};

// Beams are divided into `segments` along their length. Elements without length, and springs, are not drawn.
FrameGeometry frame_geometry(const Model& model, int segments = 12);

// Field values of one frame, in the order of points and cells.
struct FrameFields {
  std::vector<double> displacement, rotation, velocity;  // 3 a point [m], [rad], [m/s]
  std::vector<double> force, moment;                     // 3 a cell: N VY VZ [N], T MY MZ [N m]
  std::vector<double> peak_strain_ratio, gap, impulse;   // a cell [-], [m], [N s]
  std::vector<int> yielded;                              // a cell: 1 where a fiber carries plastic strain
};

// `interval_impulse`: of each pair since the frame before [N s].
void evaluate_frame(const FrameGeometry& geometry, const Model& model, const State& state,
                    const VectorX& interval_impulse, FrameFields& fields);

}  // namespace nsframe
