#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <optional>

#include "scene/writer.hpp"

namespace nsframe {

namespace {

std::vector<std::string> keys(const toml::table& table) {
  std::vector<std::string> out;
  for (const auto& [key, value] : table) out.emplace_back(key.str());
  return out;
}

class Override {
 public:
  Override(const std::string& key, const std::string& value, Diagnostics& diagnostics)
      : place_{"--set " + key, 0, 0}, diagnostics_(diagnostics) {
    text_ = key + " = " + value;
    // A line end would start a second key.
    if (value.find_first_of("\n\r") != std::string::npos || !parse()) text_ = key + " = " + toml_text(value);
    auto table = key.find_first_of("\n\r=") == std::string::npos ? parse() : std::nullopt;
    for (toml::table* branch = table ? &*table : nullptr; branch && branch->size() == 1 && !branch->is_inline();) {
      path_.emplace_back(branch->begin()->first.str());
      branch = branch->begin()->second.as_table();
    }
    if (path_.empty()) diagnostics_.error(place_, "not a key of a scene");
  }

  void apply(toml::table& scene) const {
    if (!path_.empty()) set(scene, 0);
  }

 private:
  std::optional<toml::table> parse() const {
    try {
      return toml::parse(text_, place_.file);
    } catch (const toml::parse_error&) {
      return std::nullopt;
    }
  }

  // Puts the value below path_[0..depth) into `target`. It is parsed anew each time, because copies of TOML nodes
  // forget where they were read.
  void put(toml::table& target, std::size_t depth) const {
    toml::table fresh = *parse();
    toml::table* branch = &fresh;
    for (std::size_t i = 0; i < depth; ++i) branch = branch->begin()->second.as_table();
    const toml::key key = branch->begin()->first;
    branch->begin()->second.visit([&](auto& value) { target.insert_or_assign(key, std::move(value)); });
  }

  void set(toml::table& target, std::size_t depth) const {
    const std::string& key = path_[depth];
    toml::node* existing = target.get(key);
    if (depth + 1 == path_.size()) return put(target, depth);
    if (!existing) {
      if (may_create(target, depth)) put(target, depth);
    } else if (toml::table* table = existing->as_table()) {
      set(*table, depth + 1);
    } else if (toml::array* list = existing->as_array(); list && list->is_array_of_tables()) {
      for (toml::node& item : *list) set(*item.as_table(), depth + 1);
    } else {
      diagnostics_.error(place_, fmt::format("'{}' is a value, it has no keys", key));
    }
  }

  // Materials, sections, structures, contacts and stages must exist: an override changes them, it doesn't make them.
  bool may_create(const toml::table& target, std::size_t depth) const {
    const auto is_named = [](std::string_view k) { return k == "material" || k == "section" || k == "structure"; };
    if (depth == 1 && is_named(path_[0])) {
      diagnostics_.error(
          place_, fmt::format("there is no {} '{}'{}", path_[0], path_[1], did_you_mean(path_[1], keys(target))));
      return false;
    }
    if (depth == 0 && (path_[0] == "contact" || path_[0] == "static" || is_named(path_[0]))) {
      diagnostics_.error(place_, fmt::format("the scene has no {}", path_[0]));
      return false;
    }
    return true;
  }

  std::string text_;
  std::vector<std::string> path_;
  Location place_;
  Diagnostics& diagnostics_;
};

}  // namespace

void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  for (const std::string& text : overrides) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      diagnostics.error({"--set " + text, 0, 0}, "must be written as key=value");
      continue;
    }
    Override(text.substr(0, equals), text.substr(equals + 1), diagnostics).apply(scene);
  }
}

}  // namespace nsframe
