#include "elements/fiber_section.hpp"

#include <algorithm>
#include <cmath>

#include "elements/screening.hpp"

namespace nsframe {

namespace {

double strain_at(const FiberSection& section, const Vector3& deformation, std::size_t i) {
  return deformation[0] - section.y[i] * deformation[1] + section.z[i] * deformation[2];
}

// Calls visit(block, index into y/z/area, first history double, stride) for every real fiber.
template <class Visit>
void for_each_fiber(const FiberSection& section, Visit&& visit) {
  for (const FiberBlock& block : section.blocks) {
    for (int i = 0; i < block.fibers; ++i) {
      visit(block, static_cast<std::size_t>(block.first + i), block.history_begin + i, block.count);
    }
  }
}

void gather(const double* from, int stride, int components, double* to) {
  for (int k = 0; k < components; ++k) to[k] = from[k * stride];
}

SectionResponse virgin_response(const FiberSection& section) {
  SectionResponse sum;
  double before[max_history], after[max_history];
  for_each_fiber(section, [&](const FiberBlock& block, std::size_t i, int, int) {
    initialize_history(block.law, before);
    const Vector3 lever(1.0, -section.y[i], section.z[i]);
    sum.force += respond(block.law, 0.0, before, after).stress * section.area[i] * lever;
    sum.tangent += initial_tangent(block.law) * section.area[i] * lever * lever.transpose();
  });
  return sum;
}

}  // namespace

FiberSection::FiberSection(const std::vector<Fiber>& all, double gj, AddedLaws laws, double screening)
    : torsion_stiffness(laws[2] ? nsframe::initial_tangent(*laws[2]) : gj), added(std::move(laws)), history_size(section_head) {
  std::vector<std::vector<const Fiber*>> by_law;
  for (const Fiber& fiber : all) {
    auto same = std::find_if(by_law.begin(), by_law.end(),
                             [&](const auto& block) { return same_law(block.front()->law, fiber.law); });
    if (same == by_law.end()) same = by_law.insert(by_law.end(), std::vector<const Fiber*>());
    same->push_back(&fiber);
  }
  for (const auto& members : by_law) {
    FiberBlock block{members.front()->law, static_cast<int>(y.size()), 0, static_cast<int>(members.size()), history_size,
                     nsframe::quiet_limit(members.front()->law, screening)};
    require(nsframe::history_size(block.law) <= max_history, "a law keeps too many history variables");
    block.count = (block.fibers + fiber_padding - 1) / fiber_padding * fiber_padding;
    for (const Fiber* fiber : members) {
      y.push_back(fiber->y);
      z.push_back(fiber->z);
      largest_y = std::max(largest_y, std::abs(fiber->y));
      largest_z = std::max(largest_z, std::abs(fiber->z));
      area.push_back(fiber->area);
      material.push_back(fiber->material);
    }
    for (auto* column : {&y, &z, &area}) column->resize(static_cast<std::size_t>(block.first + block.count), 0.0);
    material.resize(y.size());
    history_size += block.count * nsframe::history_size(block.law);
    fibers += block.fibers;
    blocks.push_back(block);
  }
  added_begin = history_size;
  for (const auto& law : added) history_size += law ? nsframe::history_size(*law) : 0;
  virgin = virgin_response(*this);
  screened = can_be_quiet(*this);
}

namespace {

// Where the history of an added law begins.
int added_begin(const FiberSection& section, std::size_t which) {
  int begin = section.added_begin;
  for (std::size_t i = 0; i < which; ++i) begin += section.added[i] ? history_size(*section.added[i]) : 0;
  return begin;
}

}  // namespace

UniaxialPoint respond_added(const FiberSection& section, std::size_t which, double deformation, const double* committed,
                            double* trial) {
  const int begin = added_begin(section, which);
  return respond(*section.added[which], deformation, committed + begin, trial + begin);
}

void initialize_history(const FiberSection& section, double* history) {
  for (std::size_t i = 0; i < section.added.size(); ++i) {
    if (section.added[i]) initialize_history(*section.added[i], history + added_begin(section, i));
  }
  if (section.screened) return start_quiet(section, history);
  std::fill_n(history, section_head, 0.0);
  double virgin[max_history];
  for (const FiberBlock& block : section.blocks) {
    initialize_history(block.law, virgin);
    for (int k = 0; k < history_size(block.law); ++k) {
      std::fill_n(history + block.history_begin + k * block.count, block.count, virgin[k]);
    }
  }
}

void add_wrapped_block(const FiberSection& section, const FiberBlock& block, const Vector3& deformation,
                       const double* committed, double* trial, SectionResponse& sum) {
  double strain[wrapped_points], stress[wrapped_points], tangent[wrapped_points];
  for (int begin = 0; begin < block.fibers; begin += wrapped_points) {
    const int count = std::min(wrapped_points, block.fibers - begin), history = block.history_begin + begin;
    const auto first = static_cast<std::size_t>(block.first + begin);
    for (int i = 0; i < count; ++i) strain[i] = strain_at(section, deformation, first + static_cast<std::size_t>(i));
    respond_points_simd(block.law,
                        {count, strain, committed + history, trial + history, block.count, stress, tangent});
    for (int i = 0; i < count; ++i) {
      const std::size_t at = first + static_cast<std::size_t>(i);
      const Vector3 lever(1.0, -section.y[at], section.z[at]);
      sum.force += stress[i] * section.area[at] * lever;
      sum.tangent += tangent[i] * section.area[at] * lever * lever.transpose();
    }
  }
  // the padding is not evaluated, but written, so that states are the same bits in every run
  for (int k = 0; k < history_size(block.law); ++k) {
    const int row = block.history_begin + k * block.count;
    std::copy(committed + row + block.fibers, committed + row + block.count, trial + row + block.fibers);
  }
}

SectionResponse respond_scalar(const FiberSection& section, const Vector3& deformation, const double* committed,
                               double* trial) {
  if (is_quiet(committed)) {
    open_history(section, committed, trial);
    committed = trial;  // a fiber's history is read before it is written
  }
  trial[0] = 0;
  SectionResponse sum;
  double before[max_history], after[max_history];
  for_each_fiber(section, [&](const FiberBlock& block, std::size_t i, int begin, int stride) {
    const int components = history_size(block.law);
    gather(committed + begin, stride, components, before);
    const UniaxialPoint point = respond(block.law, strain_at(section, deformation, i), before, after);
    for (int k = 0; k < components; ++k) trial[begin + k * stride] = after[k];
    const Vector3 lever(1.0, -section.y[i], section.z[i]);
    sum.force += point.stress * section.area[i] * lever;
    sum.tangent += point.tangent * section.area[i] * lever * lever.transpose();
  });
  return sum;
}

Matrix3 initial_tangent(const FiberSection& section) { return section.virgin.tangent; }

double peak_strain_ratio(const FiberSection& section, const Vector3& deformation) {
  double peak = 0;
  for_each_fiber(section, [&](const FiberBlock& block, std::size_t i, int, int) {
    peak = std::max(peak, std::abs(strain_at(section, deformation, i)) / yield_strain(block.law));
  });
  return peak;
}

std::vector<FiberPlace> fiber_places(const FiberSection& section) {
  std::vector<FiberPlace> places;
  for_each_fiber(section, [&](const FiberBlock&, std::size_t i, int, int) {
    places.push_back({0, 0, section.y[i], section.z[i], section.area[i], section.material[i]});
  });
  return places;
}

std::vector<FiberState> fiber_states(const FiberSection& section, const Vector3& deformation, const double* committed) {
  if (is_quiet(committed)) {
    std::vector<double> opened(static_cast<std::size_t>(section.history_size));
    open_history(section, committed, opened.data());
    return fiber_states(section, deformation, opened.data());
  }
  std::vector<FiberState> states;
  states.reserve(static_cast<std::size_t>(section.fibers));
  double before[max_history], after[max_history];
  for_each_fiber(section, [&](const FiberBlock& block, std::size_t i, int begin, int stride) {
    gather(committed + begin, stride, history_size(block.law), before);
    const double strain = strain_at(section, deformation, i), stress = respond(block.law, strain, before, after).stress;
    states.push_back({strain, stress, has_yielded(block.law, strain, stress)});
  });
  return states;
}

bool has_yielded(const FiberSection& section, const Vector3& deformation, const double* committed) {
  const std::vector<FiberState> states = fiber_states(section, deformation, committed);
  return std::any_of(states.begin(), states.end(), [](const FiberState& state) { return state.yielded; });
}

}  // namespace nsframe
