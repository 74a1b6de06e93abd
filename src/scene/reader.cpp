#include "scene/reader.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

namespace nsframe {

Location location(const toml::source_region& source) {
  if (!source.path) return {};
  if (source.path->starts_with("--set ")) return {*source.path, 0, 0};
  return {*source.path, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::vector<Entry> table_entries(const toml::table& table) {
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) {
    const Location at = location(node.source());
    Location key_at = location(key.source());
    if (key_at.file.empty()) key_at = at;
    entries.push_back({std::string(key.str()), key_at, {{&node}, std::nullopt, at}});
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    const auto order = [](const Entry& e) { return std::tuple(e.at.line == 0, e.at.line, e.at.column); };
    return order(a) < order(b);
  });
  return entries;
}

std::vector<Entry> row_entries(const std::vector<const toml::node*>& values, RowKeys keys) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::string_view key = keys[std::min(i, keys.size() - 1)];
    if (key.ends_with("...")) key.remove_suffix(3);
    const Location at = location(values[i]->source());
    const auto same = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    if (same == entries.end())
      entries.push_back({std::string(key), at, {{values[i]}, std::nullopt, at}});
    else
      same->value.nodes.push_back(values[i]);
  }
  return entries;
}

Entry* TableReader::find(std::string_view key) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

void TableReader::report_unknown_keys(std::string_view also_known) {
  for (const Entry& entry : entries_)
    if (!entry.used && entry.key != also_known)
      reader_.error(entry.at, fmt::format("unknown key '{}'{}", entry.key, did_you_mean(entry.key, known_)));
}

void TableReader::error(std::string_view key, std::string message) {
  const Entry* entry = find(key);
  reader_.error(entry ? entry->value.at : at_, std::move(message));
}

void Reader::wrong_type(const Value& value, const Field& field, std::string_view expected) {
  const toml::node* node = value.single();
  error(value.at, fmt::format("{} must be {}, not {}", field.key, expected, node ? type_name(*node) : "a list"));
}

std::vector<Value> Reader::items(const Value& value) const {
  std::vector<Value> out;
  const auto add = [&out](const toml::node& node) { out.push_back({{&node}, std::nullopt, location(node.source())}); };
  if (const toml::node* node = value.single(); node && node->is_array()) {
    for (const toml::node& item : *node->as_array()) add(item);
  } else if (value.nodes.size() > 1) {
    for (const toml::node* item : value.nodes) add(*item);
  } else {
    out.push_back(value);
  }
  return out;
}

void Reader::read(const Value& value, const Field& field, double& out) {
  const toml::node* node = value.single();
  const std::string unit = si_unit(field.dimension);
  if (!node || !(node->is_number() || node->is_string()))
    return wrong_type(value, field,
                      unit.empty() ? "a number" : fmt::format("a number or a quantity as \"1 {}\"", unit));
  std::string shown;
  double number = 0;
  if (node->is_string()) {
    const std::string& text = node->as_string()->get();
    shown = fmt::format("{} = \"{}\"", field.key, text);
    try {
      number = parse_quantity(text, field.dimension);
    } catch (const QuantityError& fault) {
      return error(value.at, shown + fault.what());
    }
  } else {
    number = *node->value<double>();
    shown = fmt::format("{} = {}", field.key, number);
    if (!std::isfinite(number)) return error(value.at, shown + ", must be a finite number");
  }
  if (!field.range.contains(number)) return error(value.at, shown + ", " + field.range.rule());
  out = number;
}

void Reader::read(const Value& value, const Field& field, int& out) {
  const toml::node* node = value.single();
  const auto number = node && node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!number) {
    if (node && node->is_number())
      return error(value.at, fmt::format("{} = {}, must be a whole number", field.key, *node->value<double>()));
    return wrong_type(value, field, "a whole number");
  }
  constexpr Range representable{-2e9, 2e9};
  const Range& range = field.range.is_everything() ? representable : field.range;
  if (!range.contains(static_cast<double>(*number)))
    return error(value.at, fmt::format("{} = {}, {}", field.key, *number, range.rule()));
  out = static_cast<int>(*number);
}

void Reader::read(const Value& value, const Field& field, bool& out) {
  const toml::node* node = value.single();
  if (!node || !node->is_boolean()) return wrong_type(value, field, "true or false");
  out = node->as_boolean()->get();
}

void Reader::read(const Value& value, const Field& field, std::string& out) {
  const toml::node* node = value.single();
  if (!node || !node->is_string()) return wrong_type(value, field, "a text");
  out = node->as_string()->get();
}

void Reader::read(const Value& value, const Field& field, Reference& out) {
  out.at = value.at;
  const toml::node* node = value.single();
  if (value.text && !node && !value.text->empty()) {
    out.name = *value.text;
  } else if (node && node->is_integer()) {
    out.name = std::to_string(node->as_integer()->get());
  } else if (node && node->is_string() && !node->as_string()->get().empty()) {
    out.name = node->as_string()->get();
  } else if (value.text || (node && node->is_string())) {
    error(value.at, fmt::format("{} is empty, must be a name", field.key));
  } else {
    wrong_type(value, field, "a name or a whole number");
  }
}

std::string Reader::name_of(const Value& value, const Field& field, const std::vector<std::string>& choices) {
  const toml::node* node = value.single();
  if (!node || !node->is_string()) {
    wrong_type(value, field, "a text");
    return "";
  }
  std::string name = node->as_string()->get();
  if (std::find(choices.begin(), choices.end(), name) == choices.end())
    error(value.at, fmt::format("{} = \"{}\" is not known{}", field.key, name, did_you_mean(name, choices)));
  return name;
}

void Reader::read(const Value& value, const Field& field, Vector3& out) {
  std::array<double, 3> numbers{out.x(), out.y(), out.z()};
  read(value, field, numbers);
  out = Vector3(numbers[0], numbers[1], numbers[2]);
}

void Reader::read(const Value& value, const Field& field, Direction& out) {
  const toml::node* node = value.single();
  if (node && node->is_string()) {
    std::string name = node->as_string()->get();
    if (name.starts_with('+')) name.erase(0, 1);
    const bool negative = name.starts_with('-');
    const std::string_view axis = std::string_view(name).substr(negative ? 1 : 0);
    if (axis != "x" && axis != "y" && axis != "z")
      return error(value.at, fmt::format("{} = \"{}\", must be x, -x, y, -y, z, -z or three numbers", field.key, name));
    out.vector = (negative ? -1 : 1) * Vector3::Unit(axis[0] - 'x');
    return;
  }
  Vector3 vector = Vector3::Zero();
  const std::size_t errors = diagnostics_.messages().size();
  read(value, field, vector);
  if (diagnostics_.messages().size() > errors) return;
  if (vector.norm() == 0) return error(value.at, fmt::format("{} has no length", field.key));
  // A vector of unit length but for its rounding keeps its bits, so that written scenes read back the same.
  out.vector = std::abs(vector.norm() - 1) < 1e-15 ? vector : vector.normalized();
}

void Reader::read(const Value& value, const Field& field, KeyQuantity& out) {
  out.at = value.at;
  const toml::node* node = value.single();
  if (!node || !node->is_string()) return read(value, field, out.number);
  out.text = node->as_string()->get();
  try {
    out.number = parse_quantity(out.text).value;
  } catch (const QuantityError& fault) {
    error(value.at, fmt::format("{} = \"{}\"{}", field.key, out.text, fault.what()));
  }
}

void Reader::read(const Value& value, const Field& field, DofSet& out) {
  const toml::node* node = value.single();
  if (node && node->is_string() && node->as_string()->get() == "fixed") {
    out.dofs.fill(true);
    return;
  }
  if (node && node->is_string() && node->as_string()->get() == "pinned") {
    out.dofs = {true, true, true, false, false, false};
    return;
  }
  out.dofs.fill(false);
  std::vector<std::string> choices(node_dof_names.begin(), node_dof_names.end());
  if (node && node->is_string()) choices.insert(choices.begin(), {"fixed", "pinned"});
  for (const Value& item : items(value)) {
    const std::string name = name_of(item, field, choices);
    for (std::size_t dof = 0; dof < 6; ++dof)
      if (name == node_dof_names[dof]) out.dofs[dof] = true;
  }
}

void Reader::read(const Value& value, const Field& field, RatioTable& out) {
  const toml::node* node = value.single();
  if (!node || !node->is_table()) return read(value, field, out.list);
  for (const Entry& item : table_entries(*node->as_table())) {
    Field named = field;
    named.key = item.key;
    auto& [name, ratio] = out.named.emplace_back(Reference{item.key, item.at}, 0.0);
    read(item.value, named, ratio);
  }
}

void Reader::read(const Value& value, const Field& field, PairValues& out) {
  out.values.clear();
  for (const Value& item : items(value)) {
    const toml::node* node = item.single();
    std::vector<double> row;
    read(item, field, row);
    if (node && node->is_array() && row.empty()) error(item.at, fmt::format("{} has an empty row", field.key));
    out.values.insert(out.values.end(), row.begin(), row.end());
  }
}

template <class Law>
void Reader::read_law(const toml::table& table, const Location& at, UniaxialLaw& out) {
  Law law;
  const std::size_t errors = diagnostics_.messages().size();
  read_entries(table_entries(table), at, law, "law");
  out = law;
  if (diagnostics_.messages().size() > errors) return;
  try {
    check_parameters(out);
  } catch (const std::invalid_argument& fault) {
    const std::string message = fault.what(), parameter = message.substr(0, message.find(' '));
    const toml::node* node = table.get(parameter);
    error(node ? location(node->source()) : at, message);
  }
}

namespace {

// Place in the registry of the first law of this name that knows all keys of the table; else of the last of this name.
std::size_t law_of(const std::string& name, const toml::table& table) {
  std::size_t i = 0, found = std::variant_size_v<UniaxialLaw>;
  bool complete = false;
  for_each_law([&](auto law) {
    if (law.name == name && !complete) {
      std::size_t known = table.contains("law") ? 1 : 0;
      law.visit_parameters([&](const Parameter& p, auto&) { known += table.contains(p.name) ? 1 : 0; }, law);
      complete = known == table.size();
      found = i;
    }
    ++i;
  });
  return found;
}

}  // namespace

namespace {

// Sets `faulty` at its end when there are more errors than at its beginning.
class FaultWatch {
 public:
  FaultWatch(const Diagnostics& diagnostics, bool& faulty)
      : diagnostics_(diagnostics), before_(diagnostics.messages().size()), faulty_(faulty) {}
  ~FaultWatch() { faulty_ = diagnostics_.messages().size() > before_; }

 private:
  const Diagnostics& diagnostics_;
  std::size_t before_;
  bool& faulty_;
};

}  // namespace

void Reader::read(const Value& value, const Field& field, MaterialTable& out) {
  const FaultWatch watch(diagnostics_, out.faulty);
  out.name = value.text.value_or("");
  out.at = value.at;
  const toml::node* node = value.single();
  if (!node || !node->is_table()) return wrong_type(value, field, "a table");
  const toml::table& table = *node->as_table();
  const std::vector<std::string> laws = law_names();
  const toml::node* law = table.get("law");
  if (!law) return error(value.at, "missing key 'law'; known: " + fmt::format("{}", fmt::join(laws, ", ")));
  const std::string name = name_of({{law}, std::nullopt, location(law->source())}, {"law", ""}, laws);
  const std::size_t kind = law_of(name, table);
  std::size_t i = 0;
  for_each_law([&](const auto& law_kind) {
    if (i++ == kind) read_law<std::decay_t<decltype(law_kind)>>(table, value.at, out.law);
  });
}

void Reader::read(const Value& value, const Field& field, SectionTable& out) {
  const FaultWatch watch(diagnostics_, out.faulty);
  out.name = value.text.value_or("");
  out.at = value.at;
  const toml::node* node = value.single();
  if (!node || !node->is_table()) return wrong_type(value, field, "a table");
  const toml::table& table = *node->as_table();
  const auto try_kinds = [&]<class... Kinds>(std::variant<Kinds...>& kind) {
    const auto chosen = [&table](const auto& keys) {
      return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return table.contains(key); });
    };
    return ((chosen(Kinds::chosen_by) &&
             (read_entries(table_entries(table), value.at, kind.template emplace<Kinds>()), true)) ||
            ...);
  };
  if (!try_kinds(out.kind)) error(value.at, "a section needs one of: " + section_choices());
}

void Reader::read(const Value& value, const Field& field, StructureTable& out) {
  const std::string name = value.text.value_or("");
  const toml::node* node = value.single();
  if (!node || !node->is_table()) return wrong_type(value, field, "a table");
  const toml::table& table = *node->as_table();
  if (const toml::node* model = table.get("model")) {
    auto& parametric = out.emplace<StoryFrameTable>();
    parametric.frame.name = name;
    parametric.frame.at = value.at;
    const Value at{{model}, std::nullopt, location(model->source())};
    if (name_of(at, {"model", ""}, {"story_frame"}) == "story_frame")
      read_entries(table_entries(table), value.at, parametric, "model");
    return;
  }
  for (const char* key : {"stories", "plan"})
    if (table.contains(key) && !table.contains("nodes"))
      return error(value.at, fmt::format("'{}' needs model = \"story_frame\"; an explicit structure has nodes", key));
  auto& structure = out.emplace<ExplicitStructure>();
  structure.name = name;
  read_entries(table_entries(table), value.at, structure);
}

}  // namespace nsframe
