// Typed errors. Library code throws them with their context; only src/app turns them into text and exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace nsframe {

// The input is wrong; what() holds every message, one a line (exit code 2).
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Iterations did not converge; what() names the time and the element or contact pair to look at (exit code 3).
struct ConvergenceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file could not be read or written (exit code 4).
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace nsframe
