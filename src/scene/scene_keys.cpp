#include "scene/scene_keys.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "scene/schema_scene.hpp"

namespace nsframe {

namespace {

struct KeyPart {
  std::string name;
  std::vector<std::size_t> positions;  // from 1
};

// Takes "[2]" from the front of `text`.
std::size_t take_position(std::string_view& text) {
  const std::size_t close = text.find(']');
  std::size_t position = 0;
  const char* const end = text.data() + std::min(close, text.size());
  const auto [stop, code] = std::from_chars(text.data() + 1, end, position);
  if (close == std::string_view::npos || code != std::errc{} || stop != end || position == 0)
    throw SceneKeyError(fmt::format("'{}' is not a place in a list: [1] is the first", text));
  text.remove_prefix(close + 1);
  return position;
}

std::vector<KeyPart> split(std::string_view text) {
  std::vector<KeyPart> parts;
  while (true) {
    KeyPart part;
    if (text.starts_with('"')) {
      const std::size_t close = text.find('"', 1);
      if (close == std::string_view::npos) throw SceneKeyError("a quotation mark is not closed");
      part.name = text.substr(1, close - 1);
      text.remove_prefix(close + 1);
    } else {
      part.name = text.substr(0, text.find_first_of(".["));
      text.remove_prefix(part.name.size());
    }
    while (text.starts_with('[')) part.positions.push_back(take_position(text));
    if (part.name.empty() || (!text.empty() && (text.front() != '.' || text.size() == 1)))
      throw SceneKeyError("not a dotted key, as section.beam.Iz");
    parts.push_back(std::move(part));
    if (text.empty()) return parts;
    text.remove_prefix(1);
  }
}

class NumberFinder;

template <class T>
concept HoldsKeys = std::is_class_v<T> && requires(NumberFinder& finder, T& table) {
  visit(finder, table);
};

// What a list's members are called by: the first name among their keys (id, node, master).
class FirstName {
 public:
  template <class T>
  void operator()(const Field&, const T& value) {
    if constexpr (std::is_same_v<T, Reference>)
      if (!name_) name_ = value.name;
  }
  const std::optional<std::string>& name() const { return name_; }

 private:
  std::optional<std::string> name_;
};

// The archive that visit() sees: follows one key from table to table.
class NumberFinder {
 public:
  NumberFinder(const std::vector<KeyPart>& parts, SceneNumbers& found) : parts_(parts), found_(found) {}

  template <class T>
  void operator()(const Field& field, T& value) {
    if (at_ >= parts_.size() || done_) return;
    known_.emplace_back(field.key);
    if (field.key != parts_[at_].name) return;
    done_ = true;
    field_ = &field;
    take(value, 0);
  }

  template <class Table>
  void descend(Table& table) {
    need();
    known_.clear();
    done_ = false;
    visit(*this, table);
    if (!done_) throw SceneKeyError(fmt::format("there is no key '{}'{}", parts_[at_].name, did_you_mean(parts_[at_].name, known_)));
  }
  template <class... Kinds>
  void descend(std::variant<Kinds...>& kind) {
    std::visit([this](auto& table) { descend(table); }, kind);
  }

  // The member of this name of [material], [section] or [structure].
  template <class Table, class Name>
  Table& named(std::vector<Table>& list, std::string_view what, const Name& name_of) {
    std::vector<std::string> names;
    for (const Table& table : list) names.push_back(name_of(table));
    const std::string& wanted = need().name;
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) throw SceneKeyError(fmt::format("there is no {} '{}'{}", what, wanted, did_you_mean(wanted, names)));
    enter();
    return list[static_cast<std::size_t>(found - names.begin())];
  }

  // Past the present part, which is no list.
  void enter() {
    if (!parts_[at_].positions.empty()) throw SceneKeyError(fmt::format("'{}' is not a list of numbers", parts_[at_].name));
    ++at_;
  }

 private:
  const KeyPart& need() const {
    if (at_ >= parts_.size()) throw SceneKeyError(fmt::format("'{}' is a table: name a number in it", parts_.back().name));
    return parts_[at_];
  }

  // `depth`: positions of the present part that are used already.
  void take(double& value, std::size_t depth) {
    end(depth);
    found_.values.push_back(&value);
    found_.dimension = field_->dimension;
    found_.range = field_->range;
  }
  template <class T>
  void take(std::optional<T>& value, std::size_t depth) {
    if (!value) throw SceneKeyError(fmt::format("'{}' has no value in the scene", parts_[at_].name));
    take(*value, depth);
  }
  template <class T>
  void take(std::vector<T>& values, std::size_t depth) {
    if constexpr (HoldsKeys<T>) {
      take_member(values);
    } else {
      take_list(values, depth);
    }
  }
  template <class T, std::size_t n>
  void take(std::array<T, n>& values, std::size_t depth) {
    take_list(values, depth);
  }
  void take(PairValues& values, std::size_t depth) { take_list(values.values, depth); }
  void take(Vector3& values, std::size_t depth) {
    for (const Eigen::Index i : chosen(3, depth)) take(values[i], depth + 1);
  }
  template <class T>
  void take(T& value, std::size_t depth) {
    if constexpr (HoldsKeys<T>) {
      enter();
      descend(value);
    } else {
      throw SceneKeyError(fmt::format("'{}' is not a number that can be fitted", parts_[at_].name));
    }
    static_cast<void>(depth);
  }

  template <class List>
  void take_list(List& values, std::size_t depth) {
    if (values.empty()) throw SceneKeyError(fmt::format("'{}' has no value in the scene", parts_[at_].name));
    for (const Eigen::Index i : chosen(values.size(), depth)) take(values[static_cast<std::size_t>(i)], depth + 1);
  }
  // The wanted one, or all.
  std::vector<Eigen::Index> chosen(std::size_t size, std::size_t depth) const {
    const std::vector<std::size_t>& positions = parts_[at_].positions;
    std::vector<Eigen::Index> out;
    if (depth < positions.size()) {
      if (positions[depth] > size)
        throw SceneKeyError(
            fmt::format("'{}' has {} value{}, there is no [{}]", parts_[at_].name, size, size == 1 ? "" : "s", positions[depth]));
      return {static_cast<Eigen::Index>(positions[depth]) - 1};
    }
    for (std::size_t i = 0; i < size; ++i) out.push_back(static_cast<Eigen::Index>(i));
    return out;
  }
  template <class Table>
  void take_member(std::vector<Table>& members) {
    const std::string list = parts_[at_].name;
    enter();
    const std::string wanted = need().name;
    enter();
    std::vector<std::string> names;
    const std::size_t here = at_;
    bool any = false;
    for (Table& member : members) {
      FirstName first;
      visit(first, member);
      if (!first.name()) throw SceneKeyError(fmt::format("the members of '{}' have no names to choose one by", list));
      names.push_back(*first.name());
      if (names.back() != wanted) continue;
      any = true;
      at_ = here;
      descend(member);
    }
    if (!any) throw SceneKeyError(fmt::format("'{}' has no '{}'{}", list, wanted, did_you_mean(wanted, names)));
    done_ = true;
  }
  void end(std::size_t depth) const {
    if (depth < parts_[at_].positions.size()) throw SceneKeyError(fmt::format("'{}' is not a list of numbers", parts_[at_].name));
    if (at_ + 1 < parts_.size())
      throw SceneKeyError(fmt::format("'{}' is a number, it has no key '{}'", parts_[at_].name, parts_[at_ + 1].name));
  }

  const std::vector<KeyPart>& parts_;
  SceneNumbers& found_;
  const Field* field_ = nullptr;
  std::size_t at_ = 0;
  bool done_ = false;
  std::vector<std::string> known_;
};

}  // namespace

SceneNumbers find_numbers(SceneTables& tables, const std::string& key) {
  const std::vector<KeyPart> parts = split(key);
  SceneNumbers found;
  NumberFinder finder(parts, found);
  finder.enter();
  const std::string& root = parts.front().name;
  const auto name = [](const auto& table) { return table.name; };
  if (root == "material") {
    finder.descend(finder.named(tables.materials, root, name).law);
  } else if (root == "section") {
    finder.descend(finder.named(tables.sections, root, name).kind);
  } else if (root == "structure") {
    finder.descend(finder.named(tables.structures, root, [](const StructureTable& table) { return structure_name(table); }));
  } else if (root == "gravity") {
    if (!tables.gravity) throw SceneKeyError("the scene has no gravity");
    finder.descend(*tables.gravity);
  } else {
    throw SceneKeyError(fmt::format("'{}' cannot be fitted{}", root, did_you_mean(root, {"material", "section", "structure", "gravity"})));
  }
  return found;
}

}  // namespace nsframe
