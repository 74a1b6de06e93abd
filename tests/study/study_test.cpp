#include <doctest/doctest.h>

#include "base/errors.hpp"
#include "study/report.hpp"

using namespace nsframe;

TEST_CASE("values with commas in quotes and brackets stay whole, and the last key varies fastest") {
  const auto axes = parse_axes({"dt=1e-3,5e-4,contact.gap=[\"1 cm\", \"2 cm\"],\"3,5 cm\""});
  REQUIRE(axes.size() == 2);
  CHECK(axes[0].key == "analysis.dt");
  CHECK_FALSE(axes[0].physical());
  CHECK(axes[1].values == std::vector<std::string>{"[\"1 cm\", \"2 cm\"]", "\"3,5 cm\""});
  CHECK(axes[1].physical());
  const auto all = combinations(axes);
  REQUIRE(all.size() == 4);
  CHECK(all[1] == Combination{"analysis.dt=1e-3", "contact.gap=\"3,5 cm\""});
}

TEST_CASE("histories of steps of 2 and 3 ms share the times 6 ms apart") {
  CHECK(common_interval({2e-3, 3e-3}, 1) == doctest::Approx(6e-3).epsilon(1e-12));
  CHECK_THROWS_AS(common_interval({2e-3, 3e-3}, 0.05), InputError);
}

TEST_CASE("a pounding is matched once, by the nearest of the same pair within the window") {
  const auto at = [](double time, int pair) { Pounding p; p.time = time; p.pair = pair; return p; };
  const Matches m = match({at(1, 0), at(2, 0), at(3, 1)}, {at(0.99, 0), at(1.002, 0), at(2.03, 0), at(3, 0)}, 0.02);
  CHECK(m.matched == 1);
  CHECK(m.missed == 2);
  CHECK(m.extra == 3);
}

TEST_CASE("the diagram leaves out runs that failed, and escapes names") {
  Study study;
  study.references.resize(1);
  StudyRow row;
  row.settings = {"analysis.dt=1e-3", "motion.file=a<b"};
  row.error = 1e-3, row.seconds = 0.1;
  study.rows = {row};
  CHECK(study_svg(study).find("motion.file=a&lt;b") != std::string::npos);
  study.rows[0].failure = "did not converge";
  CHECK(study_svg(study).empty());
  CHECK(study_csv(study).find("did not converge") != std::string::npos);
}
