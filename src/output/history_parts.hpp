// The parts of results.h5, one a name in OutputOptions::history: each creates its data sets and fills a row of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/results.hpp"
#include "output/floor_spectra.hpp"
#include "output/hdf5_file.hpp"

namespace nsframe {

// What a row is made of.
struct Sample {
  const State& before;  // at the start of the step; the same as `after` for the first row
  const State& after;
  double dt = 0;  // [s]; 0 for the first row
  const Energy& energy;
  const VectorX& impulse;  // of each pair since the row before [N s]
};

class HistoryPart {
 public:
  virtual ~HistoryPart() = default;
  virtual std::size_t widest_row() const = 0;  // doubles of its largest data set
  virtual void create(Hdf5File& file, std::size_t block) = 0;
  virtual void add_row(const Model& model, const Sample& sample) = 0;
  void write() {
    for (auto& series : series_) series.write();
  }
  void truncate(hsize_t rows) {
    for (auto& series : series_) series.truncate(rows);
  }

 protected:
  Hdf5Series<double>& add_series(Hdf5File& file, const std::string& name, std::vector<hsize_t> shape, std::size_t block,
                                 const std::string& units, const std::vector<std::string>& components = {});
  std::vector<Hdf5Series<double>> series_;
};

// `at_rest`: displacements only.
std::unique_ptr<HistoryPart> node_history(const Model& model, const std::vector<std::string>& nodes, bool at_rest = false);
std::unique_ptr<HistoryPart> member_history(const Model& model);
std::unique_ptr<HistoryPart> section_history(const Model& model, const State& state);
// `elements`: as choose_fibers() reads them. Throws InputError for wrong ones.
std::unique_ptr<HistoryPart> fiber_history(const Model& model, const std::vector<std::string>& elements);
std::unique_ptr<HistoryPart> contact_history(const Model& model);
std::unique_ptr<HistoryPart> energy_history();
std::unique_ptr<HistoryPart> ground_history(const Model& model);

// /impacts, written with every block.
class ImpactRows {
 public:
  ImpactRows(Hdf5File& file, const Contacts& contacts);
  void add(const Impact& impact);
  void write();
  void truncate(hsize_t rows);

 private:
  std::vector<Hdf5Series<double>> columns_;
  Hdf5Series<int> pair_;
};

void write_poundings(Hdf5File& file, const std::vector<Pounding>& poundings);
void write_final_energy(Hdf5File& file, const Energy& energy);
void write_floor_spectra(Hdf5File& file, const FloorSpectra& spectra);
void mark_finished(Hdf5File& file);

}  // namespace nsframe
