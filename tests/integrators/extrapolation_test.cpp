// Extrapolation: exact on polynomials, careful on noise, the same after a snapshot.
#include <doctest/doctest.h>

#include "integrators/extrapolation.hpp"

using namespace nsframe;

namespace {

VectorX cubic(int i) {
  const double t = 0.1 * i;
  return Vector3(1 + t, 2 - t * t, 3 * t * t * t - t);
}

}  // namespace

TEST_CASE("a sequence of cubics is foretold exactly once its differences are known, constants at once") {
  Extrapolation extrapolation;
  CHECK(extrapolation.empty());
  extrapolation.add(Vector3(1, 2, 3));
  CHECK(extrapolation.next() == VectorX(Vector3(1, 2, 3)));
  extrapolation.clear();
  for (int i = 0; i < 8; ++i) {
    if (i >= 5) CHECK((extrapolation.next() - cubic(i)).norm() < 1e-13);
    extrapolation.add(cubic(i));
  }
}

TEST_CASE("what alternates is not extrapolated: the guess stays within what was seen") {
  Extrapolation extrapolation;
  for (int i = 0; i < 20; ++i) {
    extrapolation.add(VectorX::Constant(1, i % 2 == 0 ? 1 : -1));
    CHECK(extrapolation.next().cwiseAbs().maxCoeff() <= 1);
  }
}

TEST_CASE("an extrapolation goes on from a snapshot with the same bits") {
  Extrapolation original, restored;
  for (int i = 0; i < 4; ++i) original.add(cubic(i));
  Snapshot snapshot;
  original.save("e", snapshot);
  restored.restore("e", 3, snapshot);
  for (int i = 4; i < 8; ++i) {
    CHECK(original.next() == restored.next());
    original.add(cubic(i));
    restored.add(cubic(i));
  }
}
