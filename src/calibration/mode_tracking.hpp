// Which mode of the model a measured frequency belongs to: by its name and measured shape at first, then by likeness of shapes
// from one iteration to the next, whatever the order of the frequencies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/eigenproblem.hpp"

namespace nsframe {

// Modal assurance criterion (a' W b)^2 / ((a' W a) (b' W b)), in [0, 1] (Allemang and Brown 1982).
double modal_assurance(const VectorX& a, const VectorX& b);
double modal_assurance(const VectorX& a, const VectorX& b, const SparseMatrix& weight);

// The lowest `count` modes; those of equal frequency turned until each moves in one direction (theory.md, 328).
Modes separated_modes(const RestingModel& resting, std::size_t structure, int count);

// The same, turned to what is most like `reference` (columns in the structure's free DOFs).
Modes aligned_modes(const RestingModel& resting, std::size_t structure, int count, const MatrixX& reference);

struct IdentifiedMode {
  std::size_t structure = 0;
  int mode = -1;             // index; -1: no mode has a shape like the measured one
  std::string name;          // of the mode, or of the one that comes closest
  std::optional<double> likeness;  // MAC with the measured shape
};

struct Identification {
  std::vector<IdentifiedMode> targets;
  std::vector<Modes> modes;                      // of every structure that is measured; others are empty
  std::vector<std::vector<std::string>> names;
};

inline constexpr double alike = 0.5;  // MAC from which two shapes may be one mode: no other mode can be as like

// The mode of every target by its name and measured shape, each mode once. Throws InputError, with the place, for a name that no mode
// of the model has.
Identification identify(const CalibrationProblem& problem, const RestingModel& resting);

// MAC of a mode with the measured shape of a target, where that was measured.
double likeness_to_measured(const RestingModel& resting, std::size_t structure, const CalibrationTarget& target, const VectorX& shape);

// For every column of `before` the column of `after` that is most like it, each once; -1 where none has a MAC of `least`.
std::vector<int> match_shapes(const MatrixX& before, const MatrixX& after, const SparseMatrix& mass, double least = alike);

}  // namespace nsframe
