// What a time history sums over its steps, and what of it a snapshot keeps.
#pragma once

#include <vector>

#include "models/results.hpp"

namespace nsframe {

// Sums over the accepted steps.
struct RunSums {
  int steps = 0;
  long newton_iterations = 0, halved_steps = 0, laddered_steps = 0;
  long guessed_steps = 0, solves = 0, evaluations = 0, rejected_parts = 0, stiffened_steps = 0;
  double quiet_fibers = 0;           // sum over the steps looked at
  long quiet_samples = 0;
  Energy energy;
  double largest_energy = 0;         // of all kinds and steps so far [J]
  double worst_balance_error = 0;    // relative to the largest energy so far
  double max_penetration = 0;        // [m]
  double max_complementarity_error = 0;
  Accumulations accumulations;
  std::vector<Slip> slips;           // one a pair with friction
  CreatedEnergy created;
};

// All but the slips by name, for snapshots.
template <class Sums, class Visit>
void visit_sums(Sums& sums, const Visit& visit) {
  visit("steps", sums.steps);
  visit("newton_iterations", sums.newton_iterations);
  visit("halved_steps", sums.halved_steps);
  visit("laddered_steps", sums.laddered_steps);
  visit("guessed_steps", sums.guessed_steps);
  visit("solves", sums.solves);
  visit("evaluations", sums.evaluations);
  visit("rejected_parts", sums.rejected_parts);
  visit("stiffened_steps", sums.stiffened_steps);
  visit("quiet_fibers", sums.quiet_fibers);
  visit("quiet_samples", sums.quiet_samples);
  visit("kinetic", sums.energy.kinetic);
  visit("strain", sums.energy.strain);
  visit("damping", sums.energy.damping);
  visit("contact", sums.energy.contact);
  visit("friction", sums.energy.friction);
  visit("created", sums.created.sum);
  visit("created_largest", sums.created.largest);
  visit("created_largest_time", sums.created.largest_time);
  visit("numerical", sums.energy.numerical);
  visit("input", sums.energy.input);
  visit("initial", sums.energy.initial);
  visit("largest_energy", sums.largest_energy);
  visit("worst_balance_error", sums.worst_balance_error);
  visit("max_penetration", sums.max_penetration);
  visit("max_complementarity_error", sums.max_complementarity_error);
  visit("accumulations_ended", sums.accumulations.ended);
  visit("accumulations_largest_bounce", sums.accumulations.largest_bounce);
  visit("accumulations_plastic", sums.accumulations.plastic);
}

}  // namespace nsframe
