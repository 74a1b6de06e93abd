// Which scheme a run takes, and why.
#pragma once

#include "integrators/scheme.hpp"

namespace nsframe {

struct SchemeChoice {
  std::unique_ptr<Scheme> scheme;
  std::string reason;  // a phrase
};

// The scheme that the options name. "auto": `exact` where it can take the scene from `start`, else `moreau-jean`.
SchemeChoice choose_scheme(const AnalysisOptions& options, const System& system, const State& start);

}  // namespace nsframe
