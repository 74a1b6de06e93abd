#include "output/gap_offsets.hpp"

#include <map>

namespace nsframe {

std::vector<Vector3> gap_offsets(std::size_t structures, const std::vector<StructureGap>& gaps) {
  struct Sum {
    Vector3 gap = Vector3::Zero();
    int count = 0;
  };
  std::map<std::pair<int, int>, Sum> sums;
  for (const StructureGap& gap : gaps) {
    if (gap.from < 0 || gap.to < 0 || gap.from == gap.to) continue;
    Sum& sum = sums[{gap.from, gap.to}];
    sum.gap += gap.gap;
    ++sum.count;
  }
  std::vector<Vector3> offsets(structures, Vector3::Zero());
  std::vector<bool> known(structures, false);
  for (std::size_t start = 0; start < structures; ++start) {
    if (known[start]) continue;
    known[start] = true;
    for (bool found = true; found;) {
      found = false;
      for (const auto& [between, sum] : sums) {
        const auto a = static_cast<std::size_t>(between.first), b = static_cast<std::size_t>(between.second);
        if (known[a] == known[b]) continue;
        const Vector3 mean = sum.gap / sum.count;
        offsets[known[a] ? b : a] = known[a] ? Vector3(offsets[a] + mean) : Vector3(offsets[b] - mean);
        known[a] = known[b] = found = true;
      }
    }
  }
  return offsets;
}

}  // namespace nsframe
