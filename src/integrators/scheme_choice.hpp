// Which scheme a run takes, and why.
#pragma once

#include "integrators/scheme.hpp"

namespace nsframe {

struct SchemeChoice {
  std::unique_ptr<Scheme> scheme;
  std::string reason;  // a phrase
};

// The scheme that the options name. "auto": `exact` for a linear scene and `exponential` for another where they can take it from
// `start`, else `moreau-jean`. Throws InputError where an accuracy is asked of Moreau-Jean.
SchemeChoice choose_scheme(const AnalysisOptions& options, const System& system, const State& start);

}  // namespace nsframe
