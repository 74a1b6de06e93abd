// Screened sections against sections evaluated fiber by fiber, over random histories with reversals.
#include "elements/screening.hpp"

#include <doctest/doctest.h>

#include <random>

#include "tests/support/simd_targets.hpp"

using namespace nsframe;

namespace {

constexpr double yield = 235e6 / 210e9;  // [-]

FiberSection section_of(const std::vector<UniaxialLaw>& laws, double screening = 0) {
  std::vector<Fiber> fibers;
  for (int i = 0; i < 45; ++i) {
    fibers.push_back({0.01 * (i % 9 - 4), 0.012 * (i % 5 - 2), 1e-4 * (1 + i % 3), laws[static_cast<std::size_t>(i) % laws.size()]});
  }
  return FiberSection(fibers, 1e4, {}, screening);
}

struct NamedSection {
  const char* name;
  FiberSection section;
};

const std::vector<NamedSection>& sections() {
  static const std::vector<NamedSection> all{
      {"Elastic", section_of({Elastic{210e9}})},
      {"ElasticPP", section_of({ElasticPP{210e9, yield, -0.8 * yield, 0.05 * yield}})},
      {"Steel01", section_of({Steel01{235e6, 210e9, 0.01}})},
      {"Steel02", section_of({Steel02{235e6, 210e9, 0.01}})},
      {"Steel02, initial stress", section_of({Steel02{235e6, 210e9, 0.01, 20, 0.925, 0.15, 0, 1, 0, 1, 10e6}})},
      {"mixed", section_of({Elastic{30e9}, Steel01{235e6, 210e9, 0.01}, Steel02{355e6, 205e9, 0.02, 18.5}})},
  };
  return all;
}

struct Comparison {
  double difference = 0;      // of force and tangent, relative to those at yield and to the virgin section
  int quiet = 0, opened = 0;  // steps that ended quiet, and not
};

// Extreme fibers go to about `amplitude` yield strains to either side; after `steps`, ten times as far.
Comparison compare(const FiberSection& section, double amplitude, int steps, unsigned seed) {
  VectorX screened(section.history_size), full(section.history_size), next(section.history_size);
  initialize_history(section, screened.data());
  open_history(section, screened.data(), full.data());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vector3 scale(yield / 3, yield / 3 / 0.04, yield / 3 / 0.024);
  Comparison result;
  Vector3 deformation = Vector3::Zero();
  for (int step = 0; step < 2 * steps; ++step) {
    const double reach = step < steps ? amplitude : 10 * amplitude;
    const Vector3 target = reach * Vector3(uniform(random), uniform(random), uniform(random)).cwiseProduct(scale);
    // now and then a repeated deformation, or one changed by rounding errors only: a fiber that yields then stands on a
    // corner, and rounding chooses its tangent
    const bool repeated = step % 17 == 0 || step % 13 == 0;
    if (step % 17 == 0) {
      deformation *= 1 + 1e-16;
    } else if (!repeated) {
      deformation += 0.4 * (target - deformation);
    }
    const SectionResponse a = respond(section, deformation, screened.data(), next.data());
    screened.swap(next);
    const SectionResponse b = respond_scalar(section, deformation, full.data(), next.data());
    full.swap(next);
    const Matrix3& virgin = section.virgin.tangent;
    for (int i = 0; i < 3; ++i) {
      result.difference = std::max(result.difference, std::abs(a.force[i] - b.force[i]) / (virgin(i, i) * 3 * scale[i]));
      for (int j = 0; j < 3 && !repeated; ++j) {
        result.difference = std::max(result.difference, std::abs(a.tangent(i, j) - b.tangent(i, j)) / std::sqrt(virgin(i, i) * virgin(j, j)));
      }
    }
    ++(is_quiet(screened.data()) ? result.quiet : result.opened);
  }
  return result;
}

}  // namespace

TEST_CASE("a screened section answers like its fibers, before and after it leaves the elastic range") {
  test::on_every_simd_target([](const std::string&) {
    for (const NamedSection& named : sections()) {
      CAPTURE(std::string(named.name));
      CHECK(named.section.screened);
      for (const double amplitude : {0.05, 0.3, 3.0}) {
        for (unsigned seed = 1; seed < 6; ++seed) {
          CAPTURE(amplitude);
          // rounding of some hundred sums of stress, and of powers x^R, about R |log x| epsilons
          CHECK(compare(named.section, amplitude, 150, seed).difference < 2e-12);
        }
      }
    }
  });
}

TEST_CASE("a section is quiet while its strains are small, and no longer once a fiber left the line") {
  for (const NamedSection& named : sections()) {
    CAPTURE(std::string(named.name));
    const Comparison small = compare(named.section, 0.03, 150, 3);
    CHECK(small.quiet >= 150);
    const Comparison large = compare(named.section, 3.0, 150, 3);
    if (std::string(named.name) == "Elastic") {
      CHECK(large.opened == 0);
    } else {
      CHECK(large.opened > 250);
    }
  }
}

TEST_CASE("a section screened to an error of stress stays quiet for longer, and within that error") {
  const FiberSection exact = sections()[3].section;
  for (const double error : {1e-12, 1e-10, 1e-6}) {
    const FiberSection screened = section_of({Steel02{235e6, 210e9, 0.01}}, error);
    int quiet = 0, quiet_exact = 0;
    double difference = 0;
    for (unsigned seed = 1; seed < 6; ++seed) {
      const Comparison a = compare(exact, 0.3, 300, seed), b = compare(screened, 0.3, 300, seed);
      quiet += b.quiet;
      quiet_exact += a.quiet;
      difference = std::max(difference, b.difference);
    }
    CHECK(quiet > quiet_exact);
    CHECK(difference < std::max(2e-12, 20 * error));  // of the tangent: R + 1 times that of the stress
    if (error > 1e-7) CHECK(difference > 1e-9);
  }
}

TEST_CASE("a section with a law that has no elastic range to rounding is never quiet") {
  // isotropic hardening moves the asymptotes at the first reversal
  const FiberSection isotropic = section_of({Elastic{30e9}, Steel02{235e6, 210e9, 0.01, 18.5, 0.925, 0.15, 0.04, 1, 0.02, 1, 0}});
  CHECK_FALSE(isotropic.screened);
  VectorX history(isotropic.history_size);
  initialize_history(isotropic, history.data());
  CHECK_FALSE(is_quiet(history.data()));
}

TEST_CASE("trial responses of a quiet section leave its committed history as it was") {
  const FiberSection& section = sections()[3].section;
  VectorX committed(section.history_size), trial(section.history_size);
  initialize_history(section, committed.data());
  respond(section, Vector3(2e-5, 1e-3, -1e-3), committed.data(), trial.data());
  committed.swap(trial);
  const VectorX before = committed;
  respond(section, Vector3(1e-5, -1e-3, 1e-3), committed.data(), trial.data());
  CHECK(is_quiet(trial.data()));
  respond(section, Vector3(1e-3, 0.1, 0.1), committed.data(), trial.data());
  CHECK_FALSE(is_quiet(trial.data()));
  CHECK(committed == before);
}

TEST_CASE("fibers of a quiet section that are visited now and then are those that are visited at every step, to the last bit") {
  int deferred = 0, opened = 0;
  for (const NamedSection& named : sections()) {
    CAPTURE(std::string(named.name));
    const FiberSection& section = named.section;
    for (unsigned seed = 1; seed < 4; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-1, 1);
      // several trial buffers with leftovers of refused trials, as halved and repeated steps leave them
      std::vector<VectorX> buffers(4, VectorX(section.history_size));
      for (VectorX& buffer : buffers) initialize_history(section, buffer.data());
      VectorX eager = buffers[0], next = eager, a = eager, b = eager;
      std::size_t committed = 0;
      const Vector3 scale(yield / 3, yield / 3 / 0.04, yield / 3 / 0.024);
      Vector3 deformation = Vector3::Zero(), target = Vector3::Zero();
      for (int step = 0; step < 600; ++step) {
        if (step % 20 == 0) target = (0.05 + 0.001 * step) * Vector3(uniform(random), uniform(random), uniform(random)).cwiseProduct(scale);
        const Vector3 before = deformation;
        deformation += 0.05 * (target - deformation);
        std::size_t trial = committed;
        while (trial == committed) trial = random() % buffers.size();
        if (step % 3 == 0) {  // a refused trial
          respond(section, 3 * deformation, buffers[committed].data(), buffers[trial].data());
        }
        if (step % 5 == 0) {
          while (trial == committed) trial = random() % buffers.size();
        }
        respond(section, deformation, buffers[committed].data(), buffers[trial].data());
        committed = trial;
        QuietPath path;
        path.steps = 1;
        std::copy_n(before.data(), 3, path.deformation[0]);
        std::copy_n(deformation.data(), 3, path.deformation[1]);
        double reach = 0;
        const bool quiet = follow_path(section, path, eager.data(), next.data(), reach);
        REQUIRE(quiet == is_quiet(buffers[committed].data()));
        if (!quiet) {
          ++opened;
          break;
        }
        eager.swap(next);
        auto& head = *reinterpret_cast<QuietHead*>(eager.data());
        head = {1, 0, 0, 0, 0, {deformation[0], deformation[1], deformation[2]}, {{deformation[0], deformation[1], deformation[2]}}};
        deferred += reinterpret_cast<const QuietHead*>(buffers[committed].data())->pending() > 0 ? 1 : 0;
        open_history(section, eager.data(), a.data());
        open_history(section, buffers[committed].data(), b.data());
        REQUIRE(a == b);
      }
    }
  }
  CHECK(deferred > 1000);
  CHECK(opened > 5);
}
