#include "output/vtk_frames.hpp"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <string>

#include "base/errors.hpp"
#include "models/snapshot.hpp"
#include "output/files.hpp"
#include "output/frame_geometry.hpp"
#include "output/paraview_script.hpp"
#include "output/sample_clock.hpp"

namespace nsframe {
namespace {

using Clock = std::chrono::steady_clock;

// A VTK array that looks at memory owned by us; it must not be resized afterwards.
template <class Array, class Value>
void attach(vtkFieldData* owner, const char* name, std::vector<Value>& values, int components) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
  owner->AddArray(array);
}

void attach_strings(vtkFieldData* owner, const char* name, const std::vector<std::string>& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const auto& value : values) array->InsertNextValue(value);
  owner->AddArray(array);
}

void keep_message(vtkObject*, unsigned long, void* target, void* text) {
  if (text) *static_cast<std::string*>(target) = static_cast<const char*>(text);
}

vtkSmartPointer<vtkPoints> make_points(const FrameGeometry& geometry) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(geometry.points());
  for (int i = 0; i < geometry.points(); ++i)
    points->SetPoint(i, geometry.position[static_cast<std::size_t>(i)].data());
  return points;
}

void set_cells(const FrameGeometry& geometry, vtkUnstructuredGrid* grid) {
  vtkNew<vtkTypeInt32Array> offsets, connectivity;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(geometry.offset.size()));
  std::copy(geometry.offset.begin(), geometry.offset.end(), offsets->GetPointer(0));
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(geometry.connectivity.size()));
  std::copy(geometry.connectivity.begin(), geometry.connectivity.end(), connectivity->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(geometry.cells());
  for (int i = 0; i < geometry.cells(); ++i) {
    types->SetValue(i, static_cast<unsigned char>(geometry.type[static_cast<std::size_t>(i)]));
  }
  grid->SetCells(types, cells);
}

double largest_norm(const std::vector<double>& vectors) {
  double largest = 0;
  for (std::size_t i = 0; i + 2 < vectors.size(); i += 3) {
    largest = std::max(largest, std::hypot(vectors[i], vectors[i + 1], vectors[i + 2]));
  }
  return largest;
}

std::string frame_name(std::size_t frame) { return fmt::format("frame_{:06d}.vtu", frame); }

// Frames of an earlier run, or from `first` on, must not mix with those of this one.
void remove_frames(const std::filesystem::path& folder, std::size_t first) {
  std::error_code ignored;
  std::filesystem::remove(folder / "frames.pvd", ignored);
  const std::string kept = frame_name(first);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames", ignored)) {
    const std::string name = entry.path().filename().string();
    const bool later = name.size() > kept.size() || (name.size() == kept.size() && name >= kept);
    if (later && name.rfind("frame_", 0) == 0 && entry.path().extension() == ".vtu") {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

}  // namespace

class VtkFrames::Writer {
 public:
  Writer(std::filesystem::path folder, const OutputOptions& options)
      : folder_(std::move(folder)), clock_(options.frames), amplification_(options.amplification) {}

  void start(const Model& model, const State& state) {
    const auto begin = Clock::now();
    prepare(model, state);
    remove_frames(folder_, 0);
    clock_.start(state.time);
    write(state);
    write_script();
    seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void step(const State& before, const State& after) {
    if (impulse_.size() > 0 && after.impulse.size() == impulse_.size()) impulse_ += after.impulse;
    if (!clock_.due(before.time, after.time)) return;
    const auto begin = Clock::now();
    write(after);
    impulse_.setZero();
    seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void finish() {
    if (model_) write_script();
  }

  void save(Snapshot& snapshot) const {
    snapshot.put("frames.times", times_);
    snapshot.put("frames.next_sample", clock_.next());
    snapshot.put("frames.impulse", impulse_);
    snapshot.put("frames.largest_displacement", largest_displacement_);
    snapshot.put("frames.largest_time", largest_time_);
  }

  void resume(const Model& model, const State& state, const Snapshot& snapshot) {
    prepare(model, state);
    times_ = snapshot.array("frames.times");
    clock_.resume(snapshot.number("frames.next_sample"));
    snapshot.read("frames.impulse", impulse_);
    largest_displacement_ = snapshot.number("frames.largest_displacement");
    largest_time_ = snapshot.number("frames.largest_time");
    remove_frames(folder_, times_.size());
    for (std::size_t frame = 0; frame < times_.size(); ++frame) add_to_collection(frame);
    write_collection();
  }

  double seconds() const { return seconds_; }
  double next_time() const { return clock_.next_time(); }
  int frames() const { return static_cast<int>(times_.size()); }

 private:
  void prepare(const Model& model, const State& state) {
    model_ = &model;
    make_folder(folder_ / "frames");
    geometry_ = frame_geometry(model);
    impulse_ = VectorX::Zero(model.contacts.size());
    evaluate_frame(geometry_, model, state, impulse_, fields_);
    exaggerated_ = fields_.displacement;
    build_grid();
  }
  void build_grid();
  void add_to_collection(std::size_t frame);
  void write_collection() const;
  void write(const State& state);
  void write_script() const;

  std::filesystem::path folder_;
  SampleClock clock_;
  double amplification_;
  const Model* model_ = nullptr;
  FrameGeometry geometry_;
  FrameFields fields_;
  std::vector<double> exaggerated_, time_{0.0};
  std::vector<std::string> structure_names_, pair_names_;
  VectorX impulse_;  // of each pair since the last frame [N s]
  vtkNew<vtkUnstructuredGrid> grid_;
  std::string collection_;           // the <DataSet> lines of frames.pvd
  double largest_displacement_ = 0;  // of all frames [m], and when [s]
  double largest_time_ = 0;
  double seconds_ = 0;
  std::vector<double> times_;        // of the frames [s]
};

void VtkFrames::Writer::build_grid() {
  grid_->SetPoints(make_points(geometry_));
  // The first file would lack the range that VTK keeps for the next ones.
  grid_->GetPoints()->GetData()->GetRange(-1);
  set_cells(geometry_, grid_);
  vtkPointData* points = grid_->GetPointData();
  attach<vtkDoubleArray>(points, "displacement", fields_.displacement, 3);
  attach<vtkDoubleArray>(points, "rotation", fields_.rotation, 3);
  attach<vtkDoubleArray>(points, "velocity", fields_.velocity, 3);
  if (amplification_ != 1) attach<vtkDoubleArray>(points, "displacement_exaggerated", exaggerated_, 3);
  vtkCellData* cells = grid_->GetCellData();
  attach<vtkIntArray>(cells, "kind", geometry_.kind, 1);
  attach<vtkIntArray>(cells, "element", geometry_.element, 1);
  attach<vtkIntArray>(cells, "pair", geometry_.pair, 1);
  attach<vtkIntArray>(cells, "structure", geometry_.structure, 1);
  attach<vtkDoubleArray>(cells, "force", fields_.force, 3);
  attach<vtkDoubleArray>(cells, "moment", fields_.moment, 3);
  attach<vtkDoubleArray>(cells, "peak_strain_ratio", fields_.peak_strain_ratio, 1);
  attach<vtkIntArray>(cells, "yielded", fields_.yielded, 1);
  attach<vtkDoubleArray>(cells, "gap", fields_.gap, 1);
  attach<vtkDoubleArray>(cells, "impulse", fields_.impulse, 1);
  vtkFieldData* run = grid_->GetFieldData();
  attach<vtkDoubleArray>(run, "TimeValue", time_, 1);
  attach_strings(run, "kind_names", geometry_.kind_names);
  attach_strings(run, "element_ids", geometry_.element_ids);
  for (const auto& structure : model_->structures) structure_names_.push_back(structure.name);
  for (const auto& pair : model_->contacts.pairs) pair_names_.push_back(pair.name);
  attach_strings(run, "structure_names", structure_names_);
  attach_strings(run, "pair_names", pair_names_);
}

void VtkFrames::Writer::write(const State& state) {
  evaluate_frame(geometry_, *model_, state, impulse_, fields_);
  if (amplification_ != 1) {
    std::transform(fields_.displacement.begin(), fields_.displacement.end(), exaggerated_.begin(),
                   [this](double value) { return amplification_ * value; });
  }
  time_[0] = state.time;
  if (const double largest = largest_norm(fields_.displacement); largest > largest_displacement_) {
    largest_displacement_ = largest;
    largest_time_ = state.time;
  }
  // VTK keeps the ranges of arrays until it is told that their values have changed.
  for (vtkFieldData* owner : std::initializer_list<vtkFieldData*>{grid_->GetPointData(), grid_->GetCellData()}) {
    for (int i = 0; i < owner->GetNumberOfArrays(); ++i) owner->GetArray(i)->Modified();
  }
  grid_->GetFieldData()->GetArray("TimeValue")->Modified();
  grid_->Modified();

  const std::filesystem::path path = folder_ / "frames" / frame_name(times_.size());
  std::string message;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetCallback(keep_message);
  on_error->SetClientData(&message);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, on_error);
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid_);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();
  const bool written = writer->Write() == 1;
  if (const unsigned long error = writer->GetErrorCode(); !written || error != 0) {
    // VTK's codes below 20000 are those of the operating system.
    const std::string reason = error != 0 && error < 20000 ? std::strerror(static_cast<int>(error)) : message;
    throw IoError(fmt::format("cannot write '{}': {}", path.string(), reason));
  }
  times_.push_back(state.time);
  add_to_collection(times_.size() - 1);
  write_collection();
}

void VtkFrames::Writer::add_to_collection(std::size_t frame) {
  collection_ += fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"0\" file=\"frames/{}\"/>\n",
                             times_[frame], frame_name(frame));
}

void VtkFrames::Writer::write_collection() const {
  write_text_file(folder_ / "frames.pvd",
                  "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                  "byte_order=\"LittleEndian\">\n  <Collection>\n" +
                      collection_ + "  </Collection>\n</VTKFile>\n");
}

void VtkFrames::Writer::write_script() const {
  const double scale = amplification_ != 1 ? amplification_ : visible_scale(*model_, largest_displacement_);
  write_text_file(folder_ / "open_in_paraview.py",
                  paraview_script(*model_, {scale, largest_displacement_, largest_time_}));
}

VtkFrames::VtkFrames(std::filesystem::path folder, const OutputOptions& options)
    : writer_(options.frames > 0 ? std::make_unique<Writer>(std::move(folder), options) : nullptr) {}

VtkFrames::~VtkFrames() = default;

void VtkFrames::start(const Model& model, const State& state) {
  if (writer_) writer_->start(model, state);
}

void VtkFrames::step(const State& before, const State& after, const StepReport&, const Energy&) {
  if (writer_) writer_->step(before, after);
}

double VtkFrames::next_history_time() const { return writer_ ? writer_->next_time() : std::numeric_limits<double>::infinity(); }

void VtkFrames::finish() {
  if (writer_) writer_->finish();
}

void VtkFrames::save(Snapshot& snapshot) {
  if (writer_) writer_->save(snapshot);
}

void VtkFrames::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  if (writer_) writer_->resume(model, state, snapshot);
}

double VtkFrames::seconds() const { return writer_ ? writer_->seconds() : 0; }

int VtkFrames::frames() const { return writer_ ? writer_->frames() : 0; }

}  // namespace nsframe
