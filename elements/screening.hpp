// Exact elastic screening of fiber sections (theory.md, "Quiet sections"). A section is quiet while all its fibers are
// virgin and where their laws are linear to rounding, or to a relative error of stress that the section was given: it then answers with its virgin tangent, and only what decides how
// a fiber would leave the line later (Steel02: the point of its last reversal) is kept up to date fiber by fiber.
//
// History of a section: four doubles of its own, [is quiet, e0, kz, ky], then those of its blocks. While it is quiet the
// deformation stands in the first four, and each block has only the law's QuietHistory, in the place of the first
// components of its History; the rest is stale. open_history() makes an ordinary history of it.
#pragma once

#include "elements/fiber_section.hpp"

namespace nsframe {

// Its own doubles in a section's history.
inline constexpr int section_head = 4;

inline bool is_quiet(const double* history) { return history[0] != 0; }

// The law's quiet_limit(), 0 for a law that has none.
double quiet_limit(const UniaxialLaw& law, double error);

// True when all laws of the section can be screened.
bool can_be_quiet(const FiberSection& section);

// Makes `history` that of a quiet, undeformed section.
void start_quiet(const FiberSection& section, double* history);

// The ordinary history of a section that is quiet in `quiet`; the two may not overlap.
void open_history(const FiberSection& section, const double* quiet, double* history);

// Brings the quiet history of a section to `deformation`; false when a fiber leaves the line there (`trial` then holds
// no history).
bool stay_quiet(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial);

}  // namespace nsframe
