#include "models/materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace nsframe {

namespace {

class Resolver {
 public:
  Resolver(const std::vector<MaterialDescription>& materials, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const MaterialDescription& material : materials) {
      names_.push_back(material.name);
      if (!described_.emplace(material.name, &material).second && !material.faulty)
        diagnostics.error(material.at, fmt::format("material '{}' is defined twice", material.name));
    }
  }

  Materials resolve() {
    for (const auto& [name, material] : described_) resolve(name);
    return std::move(resolved_);
  }
  bool failed(const MaterialDescription& material) const {
    return failed_.contains(material.name) || described_.at(material.name) != &material;
  }

 private:
  // The law, its inner laws resolved before it.
  const UniaxialLaw& resolve(const std::string& name) {
    if (const auto found = resolved_.find(name); found != resolved_.end()) return found->second;
    const MaterialDescription& material = *described_.at(name);
    UniaxialLaw law = material.law;
    bool valid = !material.faulty;
    open_.push_back(name);
    if (valid) for_each_inner(law, [&](InnerLaw& inner) { valid = find(inner) && valid; });
    open_.pop_back();
    valid = valid && is_acceptable(law, material);
    if (!valid) failed_.insert(name);
    return resolved_.emplace(name, valid || is_plain(law) ? law : UniaxialLaw(Elastic{1})).first->second;
  }

  bool find(InnerLaw& inner) {
    if (inner.law) return true;  // built in C++
    const std::string& name = inner.reference.name;
    if (!described_.contains(name)) {
      diagnostics_.error(inner.reference.at,
                         fmt::format("material '{}' is not defined{}", name, did_you_mean(name, names_)));
      return false;
    }
    if (const auto start = std::find(open_.begin(), open_.end(), name); start != open_.end()) {
      diagnostics_.error(inner.reference.at, fmt::format("material '{}' is made of itself: {}, {}", name,
                                                         fmt::join(start, open_.end(), ", "), name));
      return false;
    }
    const UniaxialLaw& law = resolve(name);
    if (failed_.contains(name)) return false;
    if (is_rate_dependent(law)) {
      diagnostics_.error(inner.reference.at, fmt::format("the stress of material '{}' depends on the rate of strain: no law can be made "
                                                         "of it; put it in a spring, link or truss of its own", name));
      return false;
    }
    inner.law = std::make_shared<const WrappedLaw>(WrappedLaw{law});
    return true;
  }

  bool is_acceptable(const UniaxialLaw& law, const MaterialDescription& material) {
    try {
      check_parameters(law);
    } catch (const std::invalid_argument& problem) {
      diagnostics_.error(material.at, fmt::format("material '{}': {}", material.name, problem.what()));
      return false;
    }
    if (history_size(law) <= max_history) return true;
    diagnostics_.error(material.at, fmt::format("material '{}' remembers {} numbers, {} is the most", material.name,
                                                history_size(law), max_history));
    return false;
  }

  static bool is_plain(const UniaxialLaw& law) {
    return std::visit([](const auto& l) { return PlainLaw<std::decay_t<decltype(l)>>; }, law);
  }

  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::map<std::string, const MaterialDescription*> described_;
  Materials resolved_;
  std::set<std::string> failed_;
  std::vector<std::string> open_;  // names from the outermost law to the one at hand
};

}  // namespace

Materials resolve_materials(const std::vector<MaterialDescription>& materials, Diagnostics& diagnostics) {
  return Resolver(materials, diagnostics).resolve();
}

void resolve_in_place(std::vector<MaterialDescription>& materials, Diagnostics& diagnostics) {
  Resolver resolver(materials, diagnostics);
  const Materials laws = resolver.resolve();
  for (MaterialDescription& material : materials) {
    material.law = laws.at(material.name);
    material.faulty = resolver.failed(material);
  }
}

}  // namespace nsframe
