#include <doctest/doctest.h>

#ifdef NSFRAME_HAS_VTK

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/errors.hpp"
#include "output/frame_geometry.hpp"
#include "output/vtk_frames.hpp"
#include "tests/output/sample_pair.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_frame(const std::filesystem::path& path) {
  REQUIRE(std::filesystem::exists(path));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

OutputOptions at_rate(double frames) {
  OutputOptions options;
  options.frames = frames;
  return options;
}

Vector3 value_at(vtkDataArray* array, vtkIdType i) {
  return {array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2)};
}

Vector3 point_at(vtkUnstructuredGrid* grid, vtkIdType i) { return Eigen::Map<const Vector3>(grid->GetPoint(i)); }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("VTK reads a frame back with all its fields, true to size and without NaN") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  VtkFrames frames(folder.path(), at_rate(100));
  frames.start(model, sample_state(model));
  frames.finish();
  const auto grid = read_frame(folder / "frames/frame_000000.vtu");
  const FrameGeometry geometry = frame_geometry(model);
  CHECK(grid->GetNumberOfPoints() == geometry.points());
  CHECK(grid->GetNumberOfCells() == geometry.cells());
  for (const char* name : {"displacement", "rotation", "velocity"}) {
    vtkDataArray* array = grid->GetPointData()->GetArray(name);
    REQUIRE_MESSAGE(array, name);
    CHECK(array->GetNumberOfComponents() == 3);
    CHECK(array->GetDataType() == VTK_DOUBLE);
    CHECK(array->GetNumberOfTuples() == geometry.points());
  }
  CHECK(grid->GetPointData()->GetArray("displacement_exaggerated") == nullptr);
  for (const char* name : {"force", "moment"}) {
    REQUIRE_MESSAGE(grid->GetCellData()->GetArray(name), name);
    CHECK(grid->GetCellData()->GetArray(name)->GetNumberOfComponents() == 3);
  }
  for (const char* name : {"kind", "element", "pair", "structure", "peak_strain_ratio", "yielded", "gap", "impulse"}) {
    CHECK_MESSAGE(grid->GetCellData()->GetArray(name) != nullptr, name);
  }
  for (vtkFieldData* fields :
       {static_cast<vtkFieldData*>(grid->GetPointData()), static_cast<vtkFieldData*>(grid->GetCellData())}) {
    for (int a = 0; a < fields->GetNumberOfArrays(); ++a) {
      vtkDataArray* array = fields->GetArray(a);
      bool finite = true;
      for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
        for (int c = 0; c < array->GetNumberOfComponents(); ++c) finite &= std::isfinite(array->GetComponent(i, c));
      }
      CHECK_MESSAGE(finite, array->GetName());
    }
  }
  auto* kinds = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("kind_names"));
  REQUIRE(kinds);
  CHECK(kinds->GetValue(kind_contact) == "contact");
  CHECK(kinds->GetValue(kind_slab) == "slab");
  CHECK(kinds->GetValue(kind_first_element) == "elastic_beam");
  auto* structures = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("structure_names"));
  REQUIRE(structures);
  CHECK(structures->GetValue(1) == "right");
}

TEST_CASE("members, slabs and contacts have the cells that close their surfaces") {
  const Model model = sample_pair();
  const FrameGeometry geometry = frame_geometry(model, 12);
  const auto hea = shape_outline(*find_shape("HEA100")).size(), ipe = shape_outline(*find_shape("IPE200")).size();
  const std::size_t columns = 16, beams = 16, slabs = 4, pairs = 4;
  CHECK(static_cast<std::size_t>(geometry.points()) == 13 * (columns * hea + beams * ipe) + 8 * slabs + 2 * pairs);
  CHECK(static_cast<std::size_t>(geometry.cells()) ==
        columns * (12 * hea + 2 * (hea - 2)) + beams * (12 * ipe + 2 * (ipe - 2)) + slabs * 8 + pairs);
  // Outward triangles and quadrilaterals of a closed surface enclose its volume (divergence theorem).
  std::vector<double> volume(32 + 1, 0.0);
  for (std::size_t cell = 0; cell < geometry.type.size(); ++cell) {
    if (geometry.type[cell] == CellType::line) continue;
    const auto at = [&](int i) {
      return geometry.position[static_cast<std::size_t>(
          geometry.connectivity[static_cast<std::size_t>(geometry.offset[cell] + i)])];
    };
    double& part = volume[geometry.element[cell] < 0 ? 32 : static_cast<std::size_t>(geometry.element[cell])];
    part += at(0).dot(at(1).cross(at(2))) / 6;
    if (geometry.type[cell] == CellType::quad) part += at(0).dot(at(2).cross(at(3))) / 6;
  }
  CHECK(volume[32] == doctest::Approx(4 * span_x * span_y * 0.12));
  const int column = static_cast<int>(std::find(geometry.element_ids.begin(), geometry.element_ids.end(), "left.c11") -
                                      geometry.element_ids.begin());
  REQUIRE(column < 32);
  CHECK(volume[static_cast<std::size_t>(column)] ==
        doctest::Approx(story_height * find_shape("HEA100")->A).epsilon(0.1));
}

TEST_CASE("the outline of a column's section stands around its axis, its depth along the local y axis") {
  const Model model = sample_pair();
  const FrameGeometry geometry = frame_geometry(model);
  const CatalogueShape& shape = *find_shape("HEA100");
  Vector3 low = Vector3::Constant(1e9), high = -low;
  Matrix3 axes = Matrix3::Zero();
  for (const auto& drawn : geometry.drawn) {
    if (model.groups[drawn.group]->id(drawn.element) != "left.c12") continue;
    axes = model.groups[drawn.group]->shape(drawn.element).axes;
    for (int k = geometry.offset[static_cast<std::size_t>(drawn.first_cell)];
         k < geometry.offset[static_cast<std::size_t>(drawn.last_cell)]; ++k) {
      const auto point = static_cast<std::size_t>(geometry.connectivity[static_cast<std::size_t>(k)]);
      low = low.cwiseMin(geometry.position[point]);
      high = high.cwiseMax(geometry.position[point]);
    }
  }
  const Vector3 half = 0.5 * (shape.h * axes.row(1).cwiseAbs() + shape.b * axes.row(2).cwiseAbs()).transpose();
  CHECK((low - (Vector3(span_x, 0, 0) - half)).norm() < 1e-12);
  CHECK((high - (Vector3(span_x, 0, story_height) + half)).norm() < 1e-12);
}

TEST_CASE("drawn ends move with their nodes, and sections turn with them") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  const State state = sample_state(model);
  VtkFrames frames(folder.path(), at_rate(100));
  frames.start(model, state);
  const auto grid = read_frame(folder / "frames/frame_000000.vtu");
  const FrameGeometry geometry = frame_geometry(model);
  const VectorX full = model.dofs.expand(state.displacement), rate = model.dofs.expand(state.velocity);
  vtkDataArray* displacement = grid->GetPointData()->GetArray("displacement");
  vtkDataArray* velocity = grid->GetPointData()->GetArray("velocity");
  vtkDataArray* rotation = grid->GetPointData()->GetArray("rotation");
  int checked = 0;
  for (const auto& drawn : geometry.drawn) {
    const ElementGroup& group = *model.groups[drawn.group];
    for (int cell = drawn.first_cell; cell < drawn.last_cell; ++cell) {
      const double along = geometry.along[static_cast<std::size_t>(cell)];
      if (along != 0 && along != 1) continue;  // the end caps
      const int node = group.nodes(drawn.element)[along == 0 ? 0 : 1];
      const vtkIdType point =
          geometry.connectivity[static_cast<std::size_t>(geometry.offset[static_cast<std::size_t>(cell)])];
      const Vector3 arm = point_at(grid, point) - model.nodes.position[static_cast<std::size_t>(node)];
      const Vector3 turn = full.segment<3>(6 * node + 3), spin = rate.segment<3>(6 * node + 3);
      CHECK((value_at(displacement, point) - full.segment<3>(6 * node) - turn.cross(arm)).norm() < 1e-15);
      CHECK((value_at(velocity, point) - rate.segment<3>(6 * node) - spin.cross(arm)).norm() < 1e-14);
      CHECK((value_at(rotation, point) - turn).norm() < 1e-15);
      ++checked;
    }
  }
  CHECK(checked > 100);
}

TEST_CASE("a beam is drawn with the cubic of its shape functions") {
  const Model model = sample_pair();
  State state = sample_state(model);
  state.displacement.setZero();
  const int node = node_index(model, "left.11");
  for (int dof = 0; dof < model.dofs.size(); ++dof) {
    const FreeDof& free = model.dofs.free[static_cast<std::size_t>(dof)];
    if (free.node == node && free.direction == 4) state.displacement[dof] = 0.01;  // ry turns the top of column c11
  }
  const FrameGeometry geometry = frame_geometry(model, 12);
  FrameFields fields;
  evaluate_frame(geometry, model, state, state.impulse, fields);
  const VectorX stations = geometry.station_motion * model.dofs.expand(state.displacement);
  bool found = false;
  for (const auto& drawn : geometry.drawn) {
    if (model.groups[drawn.group]->id(drawn.element) != "left.c11") continue;
    const int first =
        geometry.connectivity[static_cast<std::size_t>(geometry.offset[static_cast<std::size_t>(drawn.first_cell)])];
    const int station = geometry.station[static_cast<std::size_t>(first)] + 6;  // at half height
    // u(s) = theta L s^2 (s - 1) across the axis with u' = theta at the top; rotation ry of the axis z is u'.
    CHECK(stations[6 * station] == doctest::Approx(0.01 * story_height * 0.25 * -0.5).epsilon(1e-12));
    CHECK(stations[6 * station + 4] == doctest::Approx(0.01 * (3 * 0.25 - 2 * 0.5)).epsilon(1e-12));
    found = true;
  }
  CHECK(found);
}

TEST_CASE("frames are the steps nearest to the frame times, and sum the impulses between them") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  VtkFrames frames(folder.path(), at_rate(250));
  const State moved = sample_state(model);
  State before = moved;
  before.displacement.setZero();
  frames.start(model, before);
  for (int i = 1; i <= 20; ++i) {
    State after = moved;
    after.time = 1e-3 * i;
    after.impulse = VectorX::Zero(4);
    after.impulse[2] = 10;
    frames.step(before, after, {}, {});
    before = after;
  }
  CHECK(frames.frames() == 6);
  const std::string collection = file_text(folder / "frames.pvd");
  CHECK(count(collection, "<DataSet") == 6);
  CHECK(collection.find("timestep=\"0.004\"") != std::string::npos);
  CHECK(collection.find("</VTKFile>") != std::string::npos);  // complete at any time, not only after finish()
  const auto grid = read_frame(folder / "frames/frame_000001.vtu");
  vtkDataArray* impulse = grid->GetCellData()->GetArray("impulse");
  double sum = 0;
  for (vtkIdType i = 0; i < impulse->GetNumberOfTuples(); ++i) sum += impulse->GetComponent(i, 0);
  CHECK(sum == 40);
  CHECK(impulse->GetFiniteRange(0)[1] == 40);  // also as the file says it, where ParaView takes its colours from
  double displacement[2];
  grid->GetPointData()->GetArray("displacement")->GetRange(displacement, -1);
  CHECK(displacement[1] > 0);
  vtkDataArray* gap = grid->GetCellData()->GetArray("gap");
  const VectorX expected = model.contacts.jacobian * before.displacement + model.contacts.initial_gap;
  CHECK(gap->GetComponent(grid->GetNumberOfCells() - 4, 0) == doctest::Approx(expected[0]).epsilon(1e-14));
}

TEST_CASE("every kind of contact geometry is a line between its two points in the frames, with gap and impulse") {
  struct Kind {
    ContactKind kind;
    double shift_y, shift_z;  // of the right frame [m]
    int pairs;
  };
  const Kind kinds[] = {{ContactKind::slab_edges, 0.3, 0, 4},
                        {ContactKind::slab_columns, 0, 1.1, 6},  // levels 2.5 and 5.0 on right's columns, 3.6 on left's
                        {ContactKind::facing, 0, 1.1, 6},
                        {ContactKind::wall, 0, 0, 4}};
  for (const auto& [kind, shift_y, shift_z, pairs] : kinds) {
    CAPTURE(static_cast<int>(kind));
    ModelDescription description = sample_description();
    for (NodeDescription& node : description.structures[1].nodes) {
      node.position.y() += shift_y;
      if (node.position.z() > 0) node.position.z() += shift_z;
    }
    ContactDescription& contact = description.contacts[0];
    contact.kind = kind;
    contact.gap.clear();
    if (kind == ContactKind::wall) {
      contact.b.reset();
      contact.wall = Vector3(span_x + 0.02, 0, 0);
    }
    Diagnostics diagnostics;
    const Model model = build_model(description, diagnostics);
    REQUIRE(model.contacts.size() == pairs);
    const TemporaryFolder folder;
    VtkFrames frames(folder.path(), at_rate(100));
    State before = sample_state(model), after = sample_state(model, 0.01);
    frames.start(model, before);
    for (int i = 0; i < pairs; ++i) after.impulse[i] = 1 + i;
    frames.step(before, after, {}, {});
    frames.finish();
    const auto grid = read_frame(folder / "frames/frame_000001.vtu");
    vtkDataArray *displacement = grid->GetPointData()->GetArray("displacement"), *gap = grid->GetCellData()->GetArray("gap"),
                 *impulse = grid->GetCellData()->GetArray("impulse"), *pair = grid->GetCellData()->GetArray("pair");
    REQUIRE(displacement);
    const VectorX expected = model.contacts.jacobian * after.displacement + model.contacts.initial_gap;
    int found = 0;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
      const auto i = static_cast<int>(pair->GetComponent(cell, 0));
      if (i < 0) continue;
      ++found;
      REQUIRE(grid->GetCellType(cell) == static_cast<int>(CellType::line));
      const ContactPair& drawn = model.contacts.pairs[static_cast<std::size_t>(i)];
      const vtkIdType first = grid->GetCell(cell)->GetPointId(0), last = grid->GetCell(cell)->GetPointId(1);
      CHECK((point_at(grid, first) - drawn.a.position).norm() < 1e-12);
      CHECK((point_at(grid, last) - drawn.b.position).norm() < 1e-12);
      // the points move as the rows of the Jacobian say
      const double closing = drawn.normal.dot(value_at(displacement, last) - value_at(displacement, first));
      CHECK(model.contacts.initial_gap[i] + closing == doctest::Approx(expected[i]).epsilon(1e-12));
      CHECK(gap->GetComponent(cell, 0) == doctest::Approx(expected[i]).epsilon(1e-14));
      CHECK(impulse->GetComponent(cell, 0) == 1 + i);
    }
    CHECK(found == pairs);
  }
}

TEST_CASE("section forces are in equilibrium with the load that a cantilever column carries") {
  ModelDescription description;
  description.sections = {sample_section("HEA100")};
  StructureDescription mast = sample_frame("mast", 0, 1000);
  mast.nodes = {{"1", {}, Vector3::Zero()}, {"2", {}, Vector3(0, 0, 3)}};
  mast.supports.resize(1);
  mast.masses = {{{"2", {}}, Vector3::Constant(1000), Vector3::Zero()}};
  mast.elements.resize(1);
  mast.elements[0].node_i = {"1", {}};
  mast.elements[0].node_j = {"2", {}};
  mast.slabs.clear();
  description.structures = {mast};
  Diagnostics diagnostics;
  const Model model = build_model(description, diagnostics);
  State state = sample_state(model);
  const CatalogueShape& shape = *find_shape("HEA100");
  const ElementShape drawn = model.groups[0]->shape(0);
  // a unit force along global x at the top: deflection F L^3 / 3 E I, rotation ry = F L^2 / 2 E I
  const bool strong = std::abs(drawn.axes(1, 0)) > 0.5;
  const double EI = 210e9 * (strong ? shape.I_strong : shape.I_weak);
  for (int dof = 0; dof < model.dofs.size(); ++dof) {
    const int direction = model.dofs.free[static_cast<std::size_t>(dof)].direction;
    state.displacement[dof] = direction == 0 ? 9 / EI : direction == 4 ? 4.5 / EI : 0;
  }
  const FrameGeometry geometry = frame_geometry(model);
  FrameFields fields;
  evaluate_frame(geometry, model, state, state.impulse, fields);
  for (std::size_t cell = 0; cell < geometry.type.size(); ++cell) {
    const Vector3 force = drawn.axes.transpose() * Eigen::Map<const Vector3>(&fields.force[3 * cell]);
    const Vector3 moment = drawn.axes.transpose() * Eigen::Map<const Vector3>(&fields.moment[3 * cell]);
    CHECK((force - Vector3(1, 0, 0)).norm() < 1e-9);
    CHECK((moment - Vector3(0, 3 * (1 - geometry.along[cell]), 0)).norm() < 1e-9);
  }
}

TEST_CASE("an exaggerated displacement is a field of its own and leaves the true one alone") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  OutputOptions options = at_rate(10);
  options.amplification = 25;
  VtkFrames frames(folder.path(), options);
  frames.start(model, sample_state(model));
  frames.finish();
  const auto grid = read_frame(folder / "frames/frame_000000.vtu");
  const Vector3 truly = value_at(grid->GetPointData()->GetArray("displacement"), 100);
  REQUIRE(truly.norm() > 0);
  CHECK((value_at(grid->GetPointData()->GetArray("displacement_exaggerated"), 100) - 25 * truly).norm() < 1e-15);
  CHECK(file_text(folder / "open_in_paraview.py").find("SCALE = 25") != std::string::npos);
}

TEST_CASE("frames of an earlier run disappear, other files stay") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "frames");
  std::ofstream(folder / "frames/frame_000777.vtu") << "old";
  std::ofstream(folder / "frames/notes.txt") << "mine";
  const Model model = sample_pair();
  VtkFrames frames(folder.path(), at_rate(10));
  CHECK(std::filesystem::exists(folder / "frames/frame_000777.vtu"));  // nothing happens before the run starts
  frames.start(model, sample_state(model));
  CHECK_FALSE(std::filesystem::exists(folder / "frames/frame_000777.vtu"));
  CHECK(std::filesystem::exists(folder / "frames/notes.txt"));
}

TEST_CASE("no frames asked for, none written; a folder in the way of them is an I/O error") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  VtkFrames none(folder.path(), at_rate(0));
  none.start(model, sample_state(model));
  none.finish();
  CHECK(std::filesystem::is_empty(folder.path()));
  std::ofstream(folder / "frames") << "a file";
  VtkFrames frames(folder.path(), at_rate(10));
  CHECK_THROWS_AS(frames.start(model, sample_state(model)), IoError);
}

#endif
