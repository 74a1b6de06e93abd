#pragma once

#include <doctest/doctest.h>
#include <hwy/targets.h>

#include <string>

namespace nsframe::test {

// Calls check(name) with every SIMD target that this machine has, one after the other, in use.
template <class Check>
void on_every_simd_target(const Check& check) {
  const auto supported = hwy::SupportedTargets();
  for (auto left = supported; left != 0; left &= left - 1) {
    const auto lowest = left & (~left + 1);
    hwy::SetSupportedTargetsForTest(lowest);
    const std::string name = hwy::TargetName(lowest);
    CAPTURE(name);
    check(name);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace nsframe::test
