// Reads TOML values into the structs of tables.hpp by their visit(): types, units, ranges, unknown and missing keys,
// each error with its place.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "scene/checks.hpp"
#include "scene/schema_scene.hpp"

namespace nsframe {

Location location(const toml::source_region& source);

// What stands for one key: a TOML value, several values of a row, or the key of a map.
struct Value {
  std::vector<const toml::node*> nodes;
  std::optional<std::string> text;
  Location at;

  const toml::node* single() const { return nodes.size() == 1 ? nodes.front() : nullptr; }
};

struct Entry {
  std::string key;
  Location at;  // of the key
  Value value;
  bool used = false;
};

template <class T>
concept HasNames = requires(T value) {
  names_of(value);
};

class TableReader;

template <class T>
concept IsTable = requires(TableReader& archive, T& table) {
  visit(archive, table);
};

class Reader {
 public:
  explicit Reader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void read(const Value& value, const Field& field, double& out);
  void read(const Value& value, const Field& field, int& out);
  void read(const Value& value, const Field& field, bool& out);
  void read(const Value& value, const Field& field, std::string& out);
  void read(const Value& value, const Field& field, Reference& out);
  void read(const Value& value, const Field& field, InnerLaw& out) { read(value, field, out.reference); }
  void read(const Value& value, const Field& field, Direction& out);
  void read(const Value& value, const Field& field, KeyQuantity& out);
  void read(const Value& value, const Field& field, DofSet& out);
  void read(const Value& value, const Field& field, Vector3& out);
  void read(const Value& value, const Field& field, RatioTable& out);
  void read(const Value& value, const Field& field, PairValues& out);
  void read(const Value& value, const Field& field, MaterialTable& out);
  void read(const Value& value, const Field& field, SectionTable& out);
  void read(const Value& value, const Field& field, StructureTable& out);

  template <HasNames Enum>
  void read(const Value& value, const Field& field, Enum& out);
  template <class T>
  void read(const Value& value, const Field& field, std::optional<T>& out);
  template <class T>
  void read(const Value& value, const Field& field, std::vector<T>& out);
  template <class T, std::size_t n>
  void read(const Value& value, const Field& field, std::array<T, n>& out);
  template <class Table>
  requires std::is_class_v<Table>
  void read(const Value& value, const Field& field, Table& out);

  void error(const Location& at, std::string message) { diagnostics_.error(at, std::move(message)); }

 private:
  void wrong_type(const Value& value, const Field& field, std::string_view expected);
  std::string name_of(const Value& value, const Field& field, const std::vector<std::string>& choices);
  std::vector<Value> items(const Value& value) const;
  template <class Table>
  std::optional<std::vector<Entry>> entries(const Value& value, const Field& field);
  template <class Table>
  void read_map(const toml::table& map, const Field& field, std::vector<Table>& out);
  template <class Table>
  void read_named(const toml::table& map, const Field& field, std::vector<Table>& out);
  // `also_known` is a key that only says which schema the table has.
  template <class Table>
  void read_entries(std::vector<Entry> entries, const Location& at, Table& out, std::string_view also_known = {});
  template <class Law>
  void read_law(const toml::table& table, const Location& at, UniaxialLaw& out);

  Diagnostics& diagnostics_;
};

// The archive that visit() sees while a table is read.
class TableReader {
 public:
  TableReader(Reader& reader, std::vector<Entry> entries, Location at)
      : reader_(reader), entries_(std::move(entries)), at_(std::move(at)) {}

  template <class T>
  void operator()(const Field& field, T& out) {
    known_.emplace_back(field.key);
    if (Entry* entry = find(field.key)) {
      entry->used = true;
      reader_.read(entry->value, field, out);
    } else if (field.presence == Presence::required) {
      reader_.error(at_, "missing key '" + std::string(field.key) + "'");
    }
  }

  void report_unknown_keys(std::string_view also_known);

  // For checks.hpp: an error at the value of `key`, or at the table when it isn't there.
  void error(std::string_view key, std::string message);
  void error(const Reference& reference, std::string message) { reader_.error(reference.at, std::move(message)); }
  bool has(std::string_view key) { return find(key) != nullptr; }

 private:
  Entry* find(std::string_view key);

  Reader& reader_;
  std::vector<Entry> entries_;
  Location at_;
  std::vector<std::string> known_;
};

// The rules of a kind of section and of its small tables, by their faults().
template <class Kind>
requires requires(const Kind& kind) {
  { faults(kind) } -> std::same_as<SectionFaults>;
}
void check(TableReader& table, const Kind& kind) {
  for (const SectionFault& fault : faults(kind)) table.error(fault.key, fault.message);
}

std::vector<Entry> table_entries(const toml::table& table);  // in the order of the file
std::vector<Entry> row_entries(const std::vector<const toml::node*>& values, RowKeys keys);
std::string type_name(const toml::node& node);

template <HasNames Enum>
void Reader::read(const Value& value, const Field& field, Enum& out) {
  std::vector<std::string> choices;
  for (const auto& [name, choice] : names_of(Enum{})) choices.emplace_back(name);
  const std::string name = name_of(value, field, choices);
  for (const auto& [known, choice] : names_of(Enum{}))
    if (known == name) out = choice;
}

template <class T>
void Reader::read(const Value& value, const Field& field, std::optional<T>& out) {
  read(value, field, out.emplace());
}

template <class T>
void Reader::read(const Value& value, const Field& field, std::vector<T>& out) {
  out.clear();
  constexpr const T* type = nullptr;
  if (const toml::node* node = value.single(); node && node->is_table()) {
    if constexpr (is_named(type)) return read_named(*node->as_table(), field, out);
    if constexpr (is_map(type)) return read_map(*node->as_table(), field, out);
  }
  if constexpr (is_named(type)) return wrong_type(value, field, "a table of tables");
  if constexpr (IsTable<T>) {
    const toml::node* node = value.single();
    if (!node || !(node->is_array() || node->is_table())) return wrong_type(value, field, "a list of tables or rows");
  }
  for (const Value& item : items(value)) read(item, field, out.emplace_back());
}

template <class T, std::size_t n>
void Reader::read(const Value& value, const Field& field, std::array<T, n>& out) {
  const std::vector<Value> values = items(value);
  if (values.size() != n)
    return error(value.at, fmt::format("{} has {} values, must have {}", field.key, values.size(), n));
  for (std::size_t i = 0; i < n; ++i) read(values[i], field, out[i]);
}

// The table's keys and values, or those of its short forms; nothing, and an error, when it is neither.
template <class Table>
std::optional<std::vector<Entry>> Reader::entries(const Value& value, const Field& field) {
  constexpr const Table* type = nullptr;
  const toml::node* node = value.single();
  if (node && node->is_table()) return table_entries(*node->as_table());
  if (node && node->is_array() && !row_keys(type).empty()) {
    std::vector<const toml::node*> row;
    for (const toml::node& item : *node->as_array()) row.push_back(&item);
    const RowKeys keys = row_keys(type);
    if (row.size() > keys.size() && !keys.back().ends_with("...")) {
      error(value.at, fmt::format("a row of {} has at most {} values, not {}", field.key, keys.size(), row.size()));
      return std::nullopt;
    }
    return row_entries(row, keys);
  }
  if (node && !node->is_array() && !scalar_key(type).empty())
    return std::vector<Entry>{{std::string(scalar_key(type)), value.at, value}};
  wrong_type(value, field, row_keys(type).empty() ? "a table" : "a table or a row of values");
  return std::nullopt;
}

template <class Table>
requires std::is_class_v<Table>
void Reader::read(const Value& value, const Field& field, Table& out) {
  auto found = entries<Table>(value, field);
  if (!found) return;
  read_entries(std::move(*found), value.at, out);
}

template <class Table>
void Reader::read_entries(std::vector<Entry> entries, const Location& at, Table& out, std::string_view also_known) {
  if constexpr (requires { out.at = at; }) out.at = at;
  TableReader table(*this, std::move(entries), at);
  const std::size_t errors = diagnostics_.messages().size();
  visit(table, out);
  table.report_unknown_keys(also_known);
  if (diagnostics_.messages().size() == errors) check(table, out);
}

// { node = value }: each key stands for the first key of a row, each value for the rest or for a table of the rest.
template <class Table>
void Reader::read_map(const toml::table& map, const Field&, std::vector<Table>& out) {
  constexpr const Table* type = nullptr;
  for (const Entry& item : table_entries(map)) {
    const toml::node& node = *item.value.single();
    std::vector<Entry> entries;
    if (node.is_table()) {
      entries = table_entries(*node.as_table());
    } else {
      std::string_view key = row_keys(type)[1];
      if (key.ends_with("...")) key.remove_suffix(3);
      entries.push_back({std::string(key), item.at, item.value});
    }
    entries.push_back({std::string(row_keys(type)[0]), item.at, {{}, item.key, item.at}});
    read_entries(std::move(entries), item.at, out.emplace_back());
  }
}

template <class Table>
void Reader::read_named(const toml::table& map, const Field& field, std::vector<Table>& out) {
  for (const Entry& item : table_entries(map)) {
    Field named = field;
    const std::string key = std::string(field.key) + "." + item.key;
    named.key = key;
    Value value = item.value;
    value.text = item.key;
    value.at = item.at;
    read(value, named, out.emplace_back());
  }
}

}  // namespace nsframe
