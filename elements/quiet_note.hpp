// What stands in a history while nothing in it leaves the elastic line and no fiber needs to be looked at (theory.md, "Quiet sections"):
// the deformations since its fibers were brought up to date, and how far they may still go. A section keeps such a note of its three
// deformations, a displacement-based member one of its five.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace nsframe {

inline constexpr int pending_deformations = 16;  // noted before the fibers are brought up to date

// All that an evaluation reads of it stands at its head. `stamp` and `path` name what the fibers' histories are and what was noted, by
// what made them: equal names, equal bits.
template <int n>
struct QuietNote {
  double quiet;        // 0: not quiet, the rest is stale; else 1 + deformations noted since the fibers were brought up to date
  double reach;        // what the strains may still move, summed up, with no fiber leaving the line [-]
  double stamp;        // of the fibers' histories
  double path;         // of those and all that was noted
  double path_before;  // the same without the last one noted; 0: none was
  double last[n];      // the last deformation
  double noted[pending_deformations + 1][n];  // that of the fibers' histories, then those noted
  int pending() const { return static_cast<int>(quiet) - 1; }
};

// The name of what some numbers make of what has a name: 52 bits, exact in a double, never 0.
inline double name_after(double name, const double* values, int count) {
  auto hash = std::bit_cast<std::uint64_t>(name);
  for (int i = 0; i < count; ++i) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(values[i])) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<double>(1 + (hash >> 12));
}

// One more deformation without a look at the fibers. `next` may be any note, or zeros; copy_fibers() copies the fibers' histories.
template <int n, class CopyFibers>
void note(const QuietNote<n>& now, QuietNote<n>& next, const double* deformation, double reach, const CopyFibers& copy_fibers) {
  const int pending = now.pending();
  const bool same_fibers = next.quiet != 0 && next.stamp == now.stamp;
  if (!same_fibers) copy_fibers();
  if (same_fibers && next.path == now.path_before) {  // all but the last one is there
    std::copy_n(now.last, n, next.noted[pending]);
  } else if (!same_fibers || next.path_before != now.path) {
    std::copy_n(now.noted[0], n * (pending + 1), next.noted[0]);
  }
  next.quiet = 2 + pending;
  next.reach = reach;
  next.stamp = now.stamp;
  next.path = name_after(now.path, deformation, n);
  next.path_before = now.path;
  std::copy_n(deformation, n, next.last);
  std::copy_n(deformation, n, next.noted[pending + 1]);
}

// The fibers were brought up to `deformation`; `name` tells by what.
template <int n>
void begin_note(QuietNote<n>& note, double name, const double* deformation, double reach) {
  note.quiet = 1;
  note.reach = reach;
  note.stamp = note.path = name;
  note.path_before = 0;
  std::copy_n(deformation, n, note.last);
  std::copy_n(deformation, n, note.noted[0]);
}

}  // namespace nsframe
