#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/describe.hpp"
#include "scene/writer.hpp"

namespace nsframe {

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '-' || c == '_');
  });
  return bare ? std::string(key) : toml_text(key);
}

// TOML reads -0 as a whole number without sign.
std::string toml_number(double value) { return value == 0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value); }

// A whole number where that reads back as the same name.
std::string toml_name(const Reference& reference) {
  const std::string& name = reference.name;
  const bool number = !name.empty() && name.size() <= 18 && (name == "0" || name.front() != '0') &&
                      std::all_of(name.begin(), name.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  return number ? name : toml_text(name);
}

std::string ValueWriter::write(const Vector3& v) const { return write(std::array{v.x(), v.y(), v.z()}); }

std::string ValueWriter::write(const Direction& value) const {
  for (int axis = 0; axis < 3; ++axis) {
    const char name = static_cast<char>('x' + axis);
    if (value.vector == Vector3(Vector3::Unit(axis))) return fmt::format("\"{}\"", name);
    if (value.vector == Vector3(-Vector3::Unit(axis))) return fmt::format("\"-{}\"", name);
  }
  return write(value.vector);
}

std::string ValueWriter::write(const DofSet& value) const {
  if (std::count(value.dofs.begin(), value.dofs.end(), true) == 6) return "\"fixed\"";
  std::string out = "[";
  for (std::size_t dof = 0; dof < 6; ++dof)
    if (value.dofs[dof]) out += (out.size() > 1 ? ", " : "") + toml_text(node_dof_names[dof]);
  return out + "]";
}

std::string ValueWriter::write(const RatioTable& value) const {
  if (value.named.empty()) return write(value.list);
  std::string out = "{ ";
  for (const auto& [name, ratio] : value.named)
    out += (out.size() > 2 ? ", " : "") + toml_key(name.name) + " = " + toml_number(ratio);
  return out + " }";
}

std::string TableWriter::lines() const {
  std::string out;
  for (const auto& [key, value] : entries_) out += key + " = " + value + "\n";
  return out;
}

std::string TableWriter::inline_table() const {
  std::string out = "{";
  for (const auto& [key, value] : entries_) out += (out.size() > 1 ? ", " : " ") + key + " = " + value;
  return out + " }";
}

std::optional<std::string> TableWriter::row(RowKeys keys) const {
  if (keys.size() != fields_ || keys.size() != entries_.size()) return std::nullopt;
  std::string out = "[";
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (entries_[i].first != keys[i]) return std::nullopt;
    out += (i > 0 ? ", " : "") + entries_[i].second;
  }
  return out + "]";
}

namespace {

// Visits the scene itself: its members become tables of the file.
class SceneWriter {
 public:
  explicit SceneWriter(const ValueWriter& values) : values_(values) {}

  void operator()(const Field& field, const std::string& value) {
    if (!value.empty()) text_ += fmt::format("{} = {}\n", field.key, toml_text(value));
  }
  void operator()(const Field&, const std::vector<MaterialTable>& materials) {
    for (const MaterialTable& material : materials) {
      std::visit(
          [&](auto law) {
            text_ += fmt::format("\n[material.{}]\nlaw = {}\n", toml_key(material.name), toml_text(law.name));
            keys(law);
          },
          material.law);
    }
  }
  void operator()(const Field&, const std::vector<SectionTable>& sections) {
    for (const SectionTable& section : sections) {
      text_ += fmt::format("\n[section.{}]\n", toml_key(section.name));
      std::visit([&](auto kind) { keys(kind); }, section.kind);
    }
  }
  void operator()(const Field&, const std::vector<StructureTable>& structures) {
    for (const StructureTable& structure : structures)
      std::visit([&](const auto& s) { write_structure(s); }, structure);
  }
  template <class Table>
  void operator()(const Field& field, const std::vector<Table>& list) {
    for (const Table& table : list) {
      text_ += fmt::format("\n[[{}]]\n", field.key);
      keys(table);
    }
  }
  template <class Table>
  void operator()(const Field& field, const std::optional<Table>& table) {
    if (table) (*this)(field, *table);
  }
  template <class Table>
  void operator()(const Field& field, const Table& table) {
    text_ += fmt::format("\n[{}]\n", field.key);
    keys(table);
  }
  const std::string& text() const { return text_; }

 private:
  void write_structure(const ExplicitStructure& structure) {
    text_ += fmt::format("\n[structure.{}]\n", toml_key(structure.name));
    keys(structure);
  }
  void write_structure(const StoryFrameTable& table) {
    text_ += fmt::format("\n[structure.{}]\nmodel = \"story_frame\"\n", toml_key(table.frame.name));
    keys(table);
  }
  template <class Table>
  void keys(Table table) {
    TableWriter writer(values_);
    visit(writer, table);
    text_ += writer.lines();
  }

  const ValueWriter& values_;
  std::string text_;
};

// The same files, as seen from `target`.
void move_files(Scene& scene, const std::filesystem::path& target) {
  if (target.empty()) return;
  const auto move = [&](Reference& name) {
    const std::filesystem::path file = std::filesystem::absolute(scene.directory / name.name).lexically_normal();
    const std::filesystem::path relative =
        file.lexically_relative(std::filesystem::absolute(target).lexically_normal());
    name.name = (relative.empty() ? file : relative).generic_string();
  };
  for (MotionTable& motion : scene.tables.motions) move(motion.file);
  for (StageTable& stage : scene.tables.stages)
    if (stage.file) move(*stage.file);
}

}  // namespace

std::string write_scene(const Scene& scene, const std::filesystem::path& directory) {
  Scene copy = scene;
  move_files(copy, directory);
  const ValueWriter values;
  SceneWriter writer(values);
  visit(writer, copy);
  return writer.text();
}

std::string write_expanded_scene(const Scene& scene, const std::filesystem::path& directory) {
  Scene expanded = scene;
  for (StructureTable& structure : expanded.tables.structures)
    if (const auto* frame = std::get_if<StoryFrameTable>(&structure)) structure = tables(describe(*frame));
  return write_scene(expanded, directory);
}

}  // namespace nsframe
