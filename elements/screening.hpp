// Exact elastic screening of fiber sections (theory.md, "Quiet sections"). A section is quiet while all its fibers are
// virgin and where their laws are linear to rounding, or to a relative error of stress that the section was given: it then answers with
// its virgin tangent, and only what decides how a fiber would leave the line later (Steel02: the point of its last reversal) is kept
// fiber by fiber.
//
// That, too, is brought up to date only every so many evaluations: while the strains have moved by less than what certainly leaves every
// fiber on the line, deformations are noted and no fiber is looked at.
//
// History of a section: its QuietHead, then those of its blocks. While it is quiet each block has only the law's QuietHistory, in the
// place of the first components of its History, as it was at the first of the noted deformations; the rest is stale. open_history()
// makes an ordinary history of it.
#pragma once

#include "elements/fiber_section.hpp"
#include "elements/quiet_note.hpp"

namespace nsframe {

// The first doubles of a section's history.
using QuietHead = QuietNote<3>;

inline constexpr int section_head = aligned_size(sizeof(QuietHead) / sizeof(double));

inline bool is_quiet(const double* history) { return history[0] != 0; }

// A law that has what law.hpp asks for screening.
template <class Law>
concept Screened = requires(const Law& law) { law.quiet_limit(0.0); };

// The law's quiet_limit(), 0 for a law that has none.
double quiet_limit(const UniaxialLaw& law, double error);

// True when all laws of the section can be screened.
bool can_be_quiet(const FiberSection& section);

// Makes `history` that of a quiet, undeformed section.
void start_quiet(const FiberSection& section, double* history);

// The ordinary history of a section that is quiet in `quiet`; the two may not overlap.
void open_history(const FiberSection& section, const double* quiet, double* history);

// Brings the quiet history of a section to `deformation`; false when a fiber leaves the line there (`trial` then holds
// no history). `trial` may be any history of this section, or zeros.
bool stay_quiet(const FiberSection& section, const Vector3& deformation, const double* committed, double* trial);

// Makes `history`, whose blocks were brought up to `deformation`, that of a quiet section; `name` tells by what (QuietNote).
void begin_quiet(const Vector3& deformation, double name, double reach, double* history);

// Copies what the blocks keep while the section is quiet.
void copy_quiet(const FiberSection& section, const double* from, double* to);

// Deformations a section went through, from that of its blocks' histories on.
struct QuietPath {
  int steps = 0;  // without the first
  double deformation[pending_deformations + 2][3];
};
// Brings the blocks' quiet histories along the path, fiber by fiber; false when one leaves the line. `reach`: as in QuietHead, at its end.
// By SIMD, as respond().
bool follow_path(const FiberSection& section, const QuietPath& path, const double* committed, double* trial, double& reach);

}  // namespace nsframe
