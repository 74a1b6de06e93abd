// Going on with a run that stopped: which checkpoint fits, and stopping on a signal so that one is kept.
#pragma once

#include <filesystem>
#include <string>

#include "output/checkpoint.hpp"

namespace nsframe::app {

// The checkpoint in `folder`. Throws InputError when there is none, or it belongs to another scene or version. Scenes
// may differ in what changes no step: analysis.duration, analysis.threads, output.checkpoint.
Checkpoint checkpoint_to_resume(const std::filesystem::path& folder, const std::string& scene);

// While it lives, SIGINT and SIGTERM are noted instead of ending the program; a second one ends it.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  static int received();  // the signal, 0: none
};

}  // namespace nsframe::app
