#include "output/history_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include "base/diagnostics.hpp"
#include "base/errors.hpp"
#include "models/snapshot.hpp"
#include "output/files.hpp"
#include "output/hdf5_file.hpp"
#include "output/history_parts.hpp"
#include "output/model_tables.hpp"
#include "output/poundings.hpp"
#include "output/sample_clock.hpp"

namespace nsframe {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t block_bytes = 1U << 18U;  // of the widest data set
constexpr double flush_interval = 5;            // [s] of wall time, for runs with slow steps

const std::vector<std::string> known_histories(history_names.begin(), history_names.end());

void check_names(const std::vector<std::string>& histories) {
  std::string errors;
  for (const auto& name : histories) {
    if (std::find(known_histories.begin(), known_histories.end(), name) != known_histories.end()) continue;
    errors += fmt::format("{}output.history: unknown history '{}'{}", errors.empty() ? "" : "\n", name,
                          did_you_mean(name, known_histories));
  }
  if (!errors.empty()) throw InputError(errors);
}

}  // namespace

class HistoryFile::Writer : public StageObserver {
 public:
  Writer(std::filesystem::path path, const OutputOptions& options, std::string scene_text, const FloorSpectra* spectra)
      : path_(std::move(path)), options_(options), scene_(std::move(scene_text)), spectra_(spectra), clock_(options.history_rate) {
    check_names(options_.history);
  }
  ~Writer() override;

  // A static stage: its own rows below /static/<stage>.
  void start(const Model& model, const StaticStage& stage, const State& state) override;
  void point(const StagePoint& point, const State& state) override;
  void finish(const StageResult& result) override;
  void close();

  void start(const Model& model, const State& state);
  void step(const State& before, const State& after, const Energy& energy);
  void impact(const Impact& impact) {
    impacts_.push_back(impact);
    if (impact_rows_) impact_rows_->add(impact);
  }
  void finish();
  void save(Snapshot& snapshot);
  void resume(const Model& model, const State& state, const Snapshot& snapshot);

  double seconds() const { return seconds_; }
  double next_history_time() const {
    const bool reads = asked("elements") || asked("sections") || asked("fibers");
    return reads ? clock_.next_time() : std::numeric_limits<double>::infinity();
  }

 private:
  bool asked(const char* name) const {
    return std::find(options_.history.begin(), options_.history.end(), name) != options_.history.end();
  }
  void open_file(const Model& model, Hdf5File::Mode mode);
  void open(const Model& model, const State& state, Hdf5File::Mode mode);
  void publish();
  void add_row(const Sample& sample);
  void write_block();

  std::filesystem::path path_;
  OutputOptions options_;
  std::string scene_;
  const FloorSpectra* spectra_;
  SampleClock clock_;
  const Model* model_ = nullptr;
  std::optional<Hdf5File> file_;  // before the series, which refer to it
  std::optional<Hdf5Series<double>> time_;
  std::vector<std::unique_ptr<HistoryPart>> parts_, stage_parts_;
  std::vector<Hdf5Series<double>> stage_columns_;
  std::unique_ptr<ImpactRows> impact_rows_;
  std::vector<Impact> impacts_;
  bool published_ = false;
  VectorX impulse_;  // since the last row [N s]
  Energy energy_;
  std::size_t rows_ = 0, block_ = 1;  // rows buffered, and buffered at most
  Clock::time_point last_write_;
  double seconds_ = 0;
};

HistoryFile::Writer::~Writer() {
  // The run was given up by an exception: keep what is still buffered, if the disk lets us.
  if (!file_ || !impact_rows_) return;
  try {
    write_block();
  } catch (const IoError&) {
  }
}

void HistoryFile::Writer::open_file(const Model& model, Hdf5File::Mode mode) {
  if (file_) return;
  make_folder(path_.parent_path());
  file_.emplace(path_, mode);
  file_->set_attribute("/", "program", "nsframe");
  file_->set_attribute("/", "version", NSFRAME_VERSION);
  file_->set_attribute("/", "finished", 0.0);
  file_->write_text("/scene", scene_);
  write_model_tables(*file_, model);
  if (mode == Hdf5File::Mode::create) file_->make_group("/static");
}

void HistoryFile::Writer::publish() {
  if (!published_) file_->publish();
  published_ = true;
}

void HistoryFile::Writer::start(const Model& model, const StaticStage& stage, const State& state) {
  constexpr hsize_t block = 64;
  model_ = &model;
  open_file(model, Hdf5File::Mode::create);
  const std::string group = "/static/" + stage.name;
  file_->make_group(group);
  file_->set_attribute(group, "control", stage.options.control);
  file_->set_attribute(group, "at", stage.control_name);
  file_->set_folder(group);
  for (const auto& [name, units] : {std::pair{"/load_factor", "1"}, {"/control_displacement", "m or rad"}, {"/iterations", "1"}}) {
    stage_columns_.emplace_back(*file_, name, std::vector<hsize_t>{}, block);
    file_->set_attribute(name, "units", units);
  }
  if (asked("nodes")) stage_parts_.push_back(node_history(model, options_.nodes, true));
  if (asked("elements")) stage_parts_.push_back(member_history(model));
  if (asked("sections")) stage_parts_.push_back(section_history(model, state));
  if (asked("fibers")) stage_parts_.push_back(fiber_history(model, options_.fibers));
  for (auto& part : stage_parts_) part->create(*file_, block);
  file_->set_folder("");
}

void HistoryFile::Writer::point(const StagePoint& point, const State& state) {
  *stage_columns_[0].add_row() = point.load_factor;
  *stage_columns_[1].add_row() = point.displacement;
  *stage_columns_[2].add_row() = point.iterations;
  for (auto& part : stage_parts_) part->add_row(*model_, {state, state, 0, energy_, impulse_});
  if (++rows_ < 64) return;
  for (auto& column : stage_columns_) column.write();
  for (auto& part : stage_parts_) part->write();
  file_->flush();
  publish();
  rows_ = 0;
}

void HistoryFile::Writer::finish(const StageResult& result) {
  for (auto& column : stage_columns_) column.write();
  for (auto& part : stage_parts_) part->write();
  file_->set_attribute("/static/" + result.name, "completed", result.completed ? 1.0 : 0.0);
  file_->flush();
  publish();
  rows_ = 0;
  stage_columns_.clear();
  stage_parts_.clear();
}

void HistoryFile::Writer::close() {
  if (!file_) return;
  mark_finished(*file_);
  file_->close();
  file_.reset();
}

// The file with all its data sets, new or as they are.
void HistoryFile::Writer::open(const Model& model, const State& state, Hdf5File::Mode mode) {
  model_ = &model;
  open_file(model, mode);
  if (asked("nodes")) parts_.push_back(node_history(model, options_.nodes));
  if (asked("elements")) parts_.push_back(member_history(model));
  if (asked("sections")) parts_.push_back(section_history(model, state));
  if (asked("fibers")) parts_.push_back(fiber_history(model, options_.fibers));
  if (asked("contacts")) parts_.push_back(contact_history(model));
  if (asked("energy")) parts_.push_back(energy_history());
  if (asked("ground")) parts_.push_back(ground_history(model));
  std::size_t widest = sizeof(double);
  for (const auto& part : parts_) widest = std::max(widest, sizeof(double) * part->widest_row());
  block_ = std::clamp<std::size_t>(block_bytes / widest, 16, 1024);

  time_.emplace(*file_, "/time", std::vector<hsize_t>{}, block_);
  file_->set_attribute("/time", "units", "s");
  for (auto& part : parts_) part->create(*file_, block_);
  if (!asked("energy")) file_->make_group("/energy");
  impact_rows_ = std::make_unique<ImpactRows>(*file_, model.contacts);
  impulse_ = VectorX::Zero(model.contacts.size());
}

void HistoryFile::Writer::start(const Model& model, const State& state) {
  open(model, state, Hdf5File::Mode::create);
  clock_.start(state.time);
  energy_.initial = energy_.kinetic = 0.5 * state.velocity.dot(model.mass * state.velocity);
  if (!parts_.empty()) add_row({state, state, 0, energy_, impulse_});
  last_write_ = Clock::now();
  write_block();
  publish();
}

void HistoryFile::Writer::step(const State& before, const State& after, const Energy& energy) {
  energy_ = energy;
  if (parts_.empty()) return;
  if (impulse_.size() > 0 && after.impulse.size() == impulse_.size()) impulse_ += after.impulse;
  if (!clock_.due(before.time, after.time)) return;
  add_row({before, after, after.time - before.time, energy, impulse_});
  impulse_.setZero();
  const bool waited = std::chrono::duration<double>(Clock::now() - last_write_).count() > flush_interval;
  if (rows_ >= block_ || waited) write_block();
}

void HistoryFile::Writer::add_row(const Sample& sample) {
  *time_->add_row() = sample.after.time;
  for (auto& part : parts_) part->add_row(*model_, sample);
  ++rows_;
}

void HistoryFile::Writer::write_block() {
  const auto begin = Clock::now();
  time_->write();
  for (auto& part : parts_) part->write();
  impact_rows_->write();
  file_->flush();
  rows_ = 0;
  last_write_ = Clock::now();
  seconds_ += std::chrono::duration<double>(last_write_ - begin).count();
}

void HistoryFile::Writer::save(Snapshot& snapshot) {
  write_block();
  file_->sync();
  snapshot.put("history.rows", static_cast<double>(time_->rows()));
  snapshot.put("history.next_sample", clock_.next());
  snapshot.put("history.impulse", impulse_);
  const Energy& e = energy_;
  snapshot.put("history.energy", std::vector<double>{e.kinetic, e.strain, e.damping, e.contact, e.friction, e.numerical, e.input, e.initial});
  nsframe::save("history.impacts", impacts_, snapshot);
}

void HistoryFile::Writer::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  open(model, state, Hdf5File::Mode::reopen);
  const auto rows = static_cast<hsize_t>(snapshot.number("history.rows"));
  clock_.resume(snapshot.number("history.next_sample"));
  snapshot.read("history.impulse", impulse_);
  std::array<double, 8> e{};
  snapshot.read("history.energy", e);
  energy_ = {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7]};
  impacts_ = restore_impacts("history.impacts", snapshot);
  time_->truncate(rows);
  for (auto& part : parts_) part->truncate(rows);
  impact_rows_->truncate(impacts_.size());
  file_->remove("/poundings");
  file_->remove("/floor_spectra");
  last_write_ = Clock::now();
  file_->flush();
}

void HistoryFile::Writer::finish() {
  if (!file_) return;
  write_block();
  write_poundings(*file_, merge_impacts(impacts_));
  write_final_energy(*file_, energy_);
  if (spectra_) write_floor_spectra(*file_, *spectra_);
  mark_finished(*file_);
  parts_.clear();
  impact_rows_.reset();
  time_.reset();
  file_->close();
  file_.reset();
}

HistoryFile::HistoryFile(std::filesystem::path path, const OutputOptions& options, std::string scene_text,
                         const FloorSpectra* spectra)
    : writer_(std::make_unique<Writer>(std::move(path), options, std::move(scene_text), spectra)) {}

HistoryFile::~HistoryFile() = default;

void HistoryFile::start(const Model& model, const State& state) { writer_->start(model, state); }

void HistoryFile::step(const State& before, const State& after, const StepReport&, const Energy& energy) {
  writer_->step(before, after, energy);
}

double HistoryFile::next_history_time() const { return writer_->next_history_time(); }

void HistoryFile::impact(const Impact& impact) { writer_->impact(impact); }

void HistoryFile::finish() { writer_->finish(); }

void HistoryFile::save(Snapshot& snapshot) { writer_->save(snapshot); }

void HistoryFile::resume(const Model& model, const State& state, const Snapshot& snapshot) {
  writer_->resume(model, state, snapshot);
}

StageObserver& HistoryFile::stages() { return *writer_; }

void HistoryFile::close() { writer_->close(); }

double HistoryFile::seconds() const { return writer_->seconds(); }

}  // namespace nsframe
