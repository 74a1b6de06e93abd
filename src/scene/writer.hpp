// Writes the structs of tables.hpp as TOML by their visit(), with every default; absent optional keys and empty lists
// are left out. Numbers have the shortest form that reads back to the same bits.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/schema_scene.hpp"

namespace nsframe {

std::string toml_text(std::string_view text);  // quoted
std::string toml_key(std::string_view key);    // bare where TOML allows it
std::string toml_number(double value);
std::string toml_name(const Reference& reference);

// The value of a key; an empty text means that there is nothing to write.
class ValueWriter {
 public:
  std::string write(double value) const { return toml_number(value); }
  std::string write(int value) const { return std::to_string(value); }
  std::string write(bool value) const { return value ? "true" : "false"; }
  std::string write(const std::string& value) const { return toml_text(value); }
  std::string write(const Reference& value) const { return value.name.empty() ? "" : toml_name(value); }
  std::string write(const InnerLaw& value) const { return write(value.reference); }
  std::string write(const Direction& value) const;
  std::string write(const DofSet& value) const;
  std::string write(const KeyQuantity& value) const { return value.text.empty() ? write(value.number) : write(value.text); }
  std::string write(const Vector3& value) const;
  std::string write(const RatioTable& value) const;
  std::string write(const PairValues& value) const { return write(value.values); }

  template <class Enum>
  requires std::is_enum_v<Enum> std::string write(Enum value)
  const {
    for (const auto& [name, choice] : names_of(Enum{}))
      if (choice == value) return toml_text(name);
    return "";
  }
  template <class T>
  std::string write(const std::optional<T>& value) const {
    return value ? write(*value) : "";
  }
  template <class T>
  std::string write(const std::vector<T>& values) const {
    if (values.empty()) return "";
    if constexpr (!std::is_class_v<T> || std::is_same_v<T, Reference> || std::is_same_v<T, InnerLaw>)
      if (values.size() == 1) return write(values.front());
    return list(values);
  }
  template <class T, std::size_t n>
  std::string write(const std::array<T, n>& values) const {
    return list(values);
  }
  template <class Table>
  requires std::is_class_v<Table> std::string write(const Table& value)
  const;

 private:
  template <class List>
  std::string list(const List& values) const {
    constexpr bool rows = std::is_class_v<typename List::value_type> &&
                          !std::is_same_v<typename List::value_type, Reference> &&
                          !std::is_same_v<typename List::value_type, InnerLaw> &&
                          !std::is_same_v<typename List::value_type, KeyQuantity> &&
                          !std::is_same_v<typename List::value_type, std::string> &&
                          !std::is_same_v<typename List::value_type, std::vector<double>> &&
                          !std::is_same_v<typename List::value_type, std::array<double, 2>>;
    std::string out = "[";
    for (const auto& value : values) {
      if (out.size() > 1) out += rows ? "," : ", ";
      out += (rows ? "\n  " : "") + write(value);
    }
    return out + (rows ? ",\n]" : "]");
  }
};

// Collects the keys and values of one table.
class TableWriter {
 public:
  explicit TableWriter(const ValueWriter& values) : values_(values) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    ++fields_;
    std::string text = values_.write(value);
    if constexpr (requires(T copy) { copy.pop_back(); })
      if (text.empty() && field.presence == Presence::required) text = "[]";
    if (!text.empty()) entries_.emplace_back(field.key, std::move(text));
  }
  std::string lines() const;
  std::string inline_table() const;
  // As a row when the row's keys are all the table has.
  std::optional<std::string> row(RowKeys keys) const;

 private:
  const ValueWriter& values_;
  std::vector<std::pair<std::string, std::string>> entries_;
  std::size_t fields_ = 0;
};

template <class Table>
requires std::is_class_v<Table> std::string ValueWriter::write(const Table& value)
const {
  Table copy = value;
  TableWriter table(*this);
  visit(table, copy);
  if (auto row = table.row(row_keys(&value))) return *row;
  return table.inline_table();
}

}  // namespace nsframe
