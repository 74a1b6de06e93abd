// The SIMD twin of every registered law against its scalar definition, on every instruction set of this machine.
#include <doctest/doctest.h>


#include <random>
#include <set>

#include "tests/materials/point.hpp"
#include "tests/support/simd_targets.hpp"

using namespace nsframe;
using namespace nsframe::test;

namespace {

// Arrays for some points of one law.
struct Points {
  int count;
  std::vector<double> strain, committed, scalar, simd, stress[2], tangent[2];

  Points(const UniaxialLaw& law, int n) : count(n) {
    const auto size = static_cast<std::size_t>(n), components = static_cast<std::size_t>(history_size(law));
    strain.resize(size);
    for (auto* column : {&stress[0], &stress[1], &tangent[0], &tangent[1]}) column->resize(size);
    std::vector<double> virgin(components);
    initialize_history(law, virgin.data());
    for (const double value : virgin) committed.insert(committed.end(), size, value);
    scalar = simd = committed;
  }
  PointArrays arrays(bool vector) {
    return {count, strain.data(), committed.data(), vector ? simd.data() : scalar.data(),
            count, stress[vector].data(), tangent[vector].data()};
  }
};

// Largest differences of stress and tangent over random histories, relative to the largest stress of the history and
// to the largest tangent. Both twins start every step from the same history, so that roundings don't pile up.
Difference largest_difference(const Sample& sample) {
  Points points(sample.law, 37);  // no multiple of a register
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-20, 20);
  Difference difference;
  double peak = 0, stiffest = initial_tangent(sample.law);
  for (int step = 0; step < 200; ++step) {
    for (double& strain : points.strain) strain = sample.strain * uniform(random);
    respond_points(sample.law, points.arrays(false));
    respond_points_simd(sample.law, points.arrays(true));
    for (std::size_t i = 0; i < points.strain.size(); ++i) {
      peak = std::max(peak, std::abs(points.stress[0][i]));
      stiffest = std::max(stiffest, std::abs(points.tangent[0][i]));
      difference.stress = std::max(difference.stress, std::abs(points.stress[0][i] - points.stress[1][i]));
      difference.tangent = std::max(difference.tangent, std::abs(points.tangent[0][i] - points.tangent[1][i]));
    }
    points.committed = points.scalar;
  }
  // both are zero in laws at rest
  return {peak > 0 ? difference.stress / peak : difference.stress, stiffest > 0 ? difference.tangent / stiffest : difference.tangent};
}

}  // namespace

TEST_CASE("SIMD laws equal their scalar twins within 4 ulp times their conditioning on every instruction set") {
  std::set<std::string> names;
  test::on_every_simd_target([&](const std::string& target) {
    names.insert(target);
    for (const Sample& sample : samples()) {
      CAPTURE(std::string(sample.name));
      const double tolerance = 4 * epsilon * (1 + sample.conditioning);
      const Difference difference = largest_difference(sample);
      CHECK(difference.stress <= tolerance);
      CHECK(difference.tangent <= tolerance);
    }
  });
  std::string list;
  for (const std::string& name : names) list += " " + name;
  MESSAGE("instruction sets:" << list);
#if HWY_ARCH_X86
  // the emulation in plain C++ is always compiled in
  CHECK(names.contains("EMU128"));
  CHECK(names.size() >= 2);
#endif
}
