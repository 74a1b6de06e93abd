#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/thinning.hpp"

using namespace nsframe;

namespace {

Thinner thinned(const std::vector<double>& values, std::size_t parts) {
  Thinner thinner(values.size(), parts);
  for (const double value : values) thinner.add(value);
  return thinner;
}

}  // namespace

TEST_CASE("a thinned history keeps the extremes of every part, its first and its last value, at their rows") {
  rc::check([] {
    const auto values = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<double>>(rc::gen::map(rc::gen::inRange(-1000, 1000), [](int i) { return 0.5 * i; })));
    const auto parts = *rc::gen::inRange<std::size_t>(1, 20);
    Thinner thinner = thinned(values, parts);
    const auto& rows = thinner.rows();
    const auto& kept = thinner.values();
    RC_ASSERT(rows.size() == kept.size());
    RC_ASSERT(kept.size() <= 2 * parts + 2);
    RC_ASSERT(std::is_sorted(rows.begin(), rows.end()));
    RC_ASSERT(std::adjacent_find(rows.begin(), rows.end()) == rows.end());
    for (std::size_t i = 0; i < rows.size(); ++i) RC_ASSERT(values.at(rows[i]) == kept[i]);
    RC_ASSERT(rows.front() == 0U);
    RC_ASSERT(rows.back() == values.size() - 1);
    const std::size_t n = std::min(parts, values.size());
    for (std::size_t part = 0; part < n; ++part) {  // by another way than the thinner's: all rows of a part at once
      std::vector<double> all, some;
      for (std::size_t row = 0; row < values.size(); ++row) {
        if (row * n / values.size() == part) all.push_back(values[row]);
      }
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i] * n / values.size() == part) some.push_back(kept[i]);
      }
      RC_ASSERT(*std::max_element(some.begin(), some.end()) == *std::max_element(all.begin(), all.end()));
      RC_ASSERT(*std::min_element(some.begin(), some.end()) == *std::min_element(all.begin(), all.end()));
    }
  });
}

TEST_CASE("a single spike among a million rows is kept") {
  Thinner thinner(1000000, 100);
  for (int row = 0; row < 1000000; ++row) thinner.add(row == 765432 ? -3.5 : std::sin(1e-3 * row));
  const auto& kept = thinner.values();
  CHECK(kept.size() <= 202);
  CHECK(*std::min_element(kept.begin(), kept.end()) == -3.5);
  CHECK(thinner.rows()[static_cast<std::size_t>(std::min_element(kept.begin(), kept.end()) - kept.begin())] == 765432);
}

TEST_CASE("values that are not finite are left out, and a history of nothing else is empty") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  CHECK(thinned({nan, 1, infinity, 2, nan}, 10).values() == std::vector<double>{1, 2});
  CHECK(thinned({nan, nan}, 10).values().empty());
  CHECK(thinned({}, 10).values().empty());
}
