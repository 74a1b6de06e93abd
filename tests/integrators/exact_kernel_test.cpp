// The inner loops of the scheme `exact` against plain sums, on every SIMD target this machine has.
#include "integrators/exact_kernel.hpp"

#include <doctest/doctest.h>

#include <array>

#include "base/block_operator.hpp"
#include "base/dense_kernel.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/simd_targets.hpp"

using namespace nsframe;

TEST_CASE("exact kernel: a block operator multiplies one vector, and two in one pass, as plain products do") {
  std::srand(1);
  test::on_every_simd_target([](const std::string&) {
    for (const int size : {1, 7, 8, 9, 16, 40, 68, 72, 73, 136}) {
      CAPTURE(size);
      const MatrixX A = MatrixX::Random(size, size), B = MatrixX::Random(3, 3);
      const BlockOperator both({A, B}, {{0, size}, {size, size + 3}});
      const VectorX start = VectorX::Random(size + 3), x = VectorX::Random(size + 3), x2 = VectorX::Random(size + 3);
      VectorX expected(size + 3), expected2(size + 3), y, y2, once;
      expected << A * x.head(size), B * x.tail(3);
      expected2 << A * x2.head(size), B * x2.tail(3);
      both.multiply(start, x, x2, y, y2);
      both.multiply(x, once);
      CHECK((y - start - expected).cwiseAbs().maxCoeff() <= (size + 1) * epsilon);
      CHECK((y2 - expected2).cwiseAbs().maxCoeff() <= size * epsilon);
      CHECK((once - expected).cwiseAbs().maxCoeff() <= size * epsilon);
    }
  });
}

TEST_CASE("exact kernel: two right-hand sides with a sparse block") {
  const SparseMatrix identity = 2 * MatrixX::Identity(40, 40).sparseView();
  const BlockOperator doubled(identity, {{0, 40}}, 8);
  const VectorX x = VectorX::LinSpaced(40, 1, 40), x2 = -x;
  VectorX y, y2;
  doubled.multiply(x, x, x2, y, y2);
  CHECK(y == 3 * x);
  CHECK(y2 == 2 * x2);
}

TEST_CASE("exact kernel: work, strain and kinetic energy of a flight are plain sums") {
  std::srand(2);
  test::on_every_simd_target([](const std::string&) {
    constexpr int n = 4 * dense_row_padding;
    const double s = 0.3;
    const auto random = [] { return VectorX(VectorX::Random(n)); };
    const VectorX square = random().cwiseAbs(), decay = random().cwiseAbs(), flexibility = random(), x = random(), y = random(), f0 = random(),
                  f1 = random(), x2 = random(), y2 = random(), load0 = random(), load1 = random();
    double work = 0, strain = 0, kinetic = 0;
    for (int i = 0; i < n; ++i) {
      const double integral = flexibility[i] * (s * f0[i] + s * s * f1[i] / 2 - (y2[i] - y[i]) - 2 * decay[i] * (x2[i] - x[i]));
      work += (load0[i] + s * load1[i]) * x2[i] - load0[i] * x[i] - load1[i] * integral;
      strain += square[i] * (x2[i] * x2[i] - x[i] * x[i]) / 2;
      kinetic += (y2[i] * y2[i] - y[i] * y[i]) / 2;
    }
    const FlightEnergy energy = sum_energy(
        n, s, {square.data(), decay.data(), flexibility.data(), x.data(), y.data(), f0.data(), f1.data(), x2.data(), y2.data()}, load0.data(),
        load1.data());
    CHECK(energy.work == doctest::Approx(work).epsilon(1e-13));
    CHECK(energy.strain == doctest::Approx(strain).epsilon(1e-13));
    CHECK(energy.kinetic == doctest::Approx(kinetic).epsilon(1e-13));
  });
}

TEST_CASE("exact kernel: step, energies and size in one pass are those of three") {
  std::srand(3);
  test::on_every_simd_target([](const std::string&) {
    constexpr int n = 3 * dense_row_padding;
    const double s = 0.3;
    std::array<VectorX, 20> a;
    for (VectorX& array : a) array = VectorX::Random(n);
    const StepArrays step{a[0].data(), a[1].data(), a[2].data(), a[3].data(), a[4].data(),  a[5].data(),
                          a[6].data(), a[7].data(), a[8].data(), a[9].data(), a[10].data(), a[11].data()};
    const VectorX &f0 = a[12], &f1 = a[13], &x = a[14], &y = a[15], &raised = a[16];
    FlightArrays flight{a[17].data(), a[18].data(), a[19].data(), x.data(), y.data(), f0.data(), f1.data(), nullptr, nullptr};
    VectorX x1(n), y1(n), x2(n), y2(n);
    apply_step(n, step, x.data(), y.data(), f0.data(), f1.data(), x1.data(), y1.data());
    const ModalSize size = modal_size(n, flight, raised.data());
    const FlightSums sums = step_and_sum(n, s, step, flight, raised.data(), x2.data(), y2.data());
    flight.x_after = x1.data();
    flight.y_after = y1.data();
    const FlightEnergy energy = sum_energy(n, s, flight, f0.data(), f1.data());
    CHECK(x1 == x2);
    CHECK(y1 == y2);
    CHECK(sums.energy.work == doctest::Approx(energy.work).epsilon(1e-13));
    CHECK(sums.energy.strain == doctest::Approx(energy.strain).epsilon(1e-13));
    CHECK(sums.energy.kinetic == doctest::Approx(energy.kinetic).epsilon(1e-13));
    CHECK(sums.size.energy == doctest::Approx(size.energy).epsilon(1e-13));
    CHECK(sums.size.square == doctest::Approx(size.square).epsilon(1e-13));
  });
}
