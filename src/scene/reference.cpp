// docs/scene-reference.md from the schema.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/writer.hpp"

namespace nsframe {

namespace {

std::string number_kind(const Field& field) {
  const std::string unit = si_unit(field.dimension);
  return unit.empty() ? "number" : unit;
}

std::string kind_of(const Field& field, const double*) { return number_kind(field); }
std::string kind_of(const Field&, const int*) { return "whole number"; }
std::string kind_of(const Field&, const bool*) { return "true, false"; }
std::string kind_of(const Field&, const std::string*) { return "text"; }
std::string kind_of(const Field&, const Reference*) { return "name"; }
std::string kind_of(const Field&, const InnerLaw*) { return "name"; }
std::string kind_of(const Field&, const Direction*) { return "\"x\", \"-y\" ... or vector"; }
std::string kind_of(const Field&, const KeyQuantity*) { return "number, or text with the unit of the keys"; }
std::string kind_of(const Field&, const DofSet*) { return "DOFs"; }
std::string kind_of(const Field& field, const Vector3*) { return number_kind(field) + ", three"; }
std::string kind_of(const Field&, const RatioTable*) { return "list, or table by mode"; }
std::string kind_of(const Field& field, const PairValues*) { return number_kind(field) + ", one or more"; }

template <class Enum>
requires std::is_enum_v<Enum> std::string kind_of(const Field&, const Enum*) {
  std::string out;
  for (const auto& [name, choice] : names_of(Enum{})) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", name);
  return out;
}
template <class T>
std::string kind_of(const Field& field, const std::vector<T>*);
template <class T, std::size_t n>
std::string kind_of(const Field& field, const std::array<T, n>*);
template <class T>
std::string kind_of(const Field& field, const std::optional<T>*) {
  return kind_of(field, static_cast<const T*>(nullptr));
}
template <class T, std::size_t n>
std::string kind_of(const Field& field, const std::array<T, n>*) {
  static_assert(n >= 2 && n <= 4);
  constexpr std::array<std::string_view, 5> numbers{"", "", "two", "three", "four"};
  return fmt::format("{}, {}", kind_of(field, static_cast<const T*>(nullptr)), numbers[n]);
}
template <class T>
std::string kind_of(const Field& field, const std::vector<T>*) {
  return kind_of(field, static_cast<const T*>(nullptr)) + ", one or more";
}

template <class T>
struct ListItem {
  using type = T;
  static constexpr bool list = false;
};
template <class T>
struct ListItem<std::vector<T>> {
  using type = T;
  static constexpr bool list = true;
};
template <class T>
struct ListItem<std::optional<T>> : ListItem<T> {};

// Names of the tables below a structure or section, as the headings of the reference.
constexpr std::string_view title_of(const NodeTable*) { return "a node"; }
constexpr std::string_view title_of(const SupportTable*) { return "a support"; }
constexpr std::string_view title_of(const MassTable*) { return "a mass"; }
constexpr std::string_view title_of(const BeamTable*) { return "a beam"; }
constexpr std::string_view title_of(const WallTable*) { return "a wall"; }
constexpr std::string_view title_of(const BarTable*) { return "a truss or cable"; }
constexpr std::string_view title_of(const InfillTable*) { return "an infill"; }
constexpr std::string_view title_of(const SpringTable*) { return "a spring"; }
constexpr std::string_view title_of(const LinkTable*) { return "a link"; }
constexpr std::string_view title_of(const StiffnessTable*) { return "stiffness by direction"; }
constexpr std::string_view title_of(const DashpotTable*) { return "dashpots by direction"; }
constexpr std::string_view title_of(const LawTable*) { return "laws by direction"; }
constexpr std::string_view title_of(const TieTable*) { return "a rigid link"; }
constexpr std::string_view title_of(const DiaphragmTable*) { return "a diaphragm"; }
constexpr std::string_view title_of(const EqualDofTable*) { return "equal DOFs"; }
constexpr std::string_view title_of(const SlabTable*) { return "a slab"; }
constexpr std::string_view title_of(const InitialDisplacement*) { return "an initial displacement"; }
constexpr std::string_view title_of(const InitialVelocity*) { return "an initial velocity"; }
constexpr std::string_view title_of(const StageLoadTable*) { return "a load"; }
constexpr std::string_view title_of(const ControlDofTable*) { return "a control DOF"; }
constexpr std::string_view title_of(const WaveTable*) { return "a wave"; }
constexpr std::string_view title_of(const DampingTable*) { return "damping"; }
constexpr std::string_view title_of(const FrameColumns*) { return "columns"; }
constexpr std::string_view title_of(const FrameBeams*) { return "beams"; }
constexpr std::string_view title_of(const Integration*) { return "integration along beams"; }
constexpr std::string_view title_of(const MemberMass*) { return "mass of beams"; }
constexpr std::string_view title_of(const EndReleases*) { return "releases"; }
constexpr std::string_view title_of(const LoadTable*) { return "a load on beams"; }
constexpr std::string_view title_of(const FrameSlab*) { return "slabs of a story frame"; }
constexpr std::string_view title_of(const FrameBraces*) { return "braces"; }
constexpr std::string_view title_of(const FrameBase*) { return "base"; }

constexpr std::string_view title_of(const CalibrationParameterTable*) { return "a parameter"; }
constexpr std::string_view title_of(const CalibrationTargetTable*) { return "a target"; }
constexpr std::string_view title_of(const CalibrationShapeTable*) { return "a measured shape"; }
constexpr std::string_view title_of(const FloorSpectraOptions*) { return "floor spectra"; }

template <class T>
concept HasTitle = requires(const T* table) {
  title_of(table);
};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// Writes the rows of one table and collects the tables that its keys hold.
class Rows {
 public:
  template <class T>
  void operator()(const Field& field, const T& value) {
    std::string kind;
    using Item = typename ListItem<T>::type;
    constexpr const Item* item = nullptr;
    if constexpr (HasTitle<Item>) {
      kind = fmt::format("{}: {}", ListItem<T>::list ? "list of tables" : "table", title_of(item));
      auto table = section<Item>();
      if (std::find(below_.begin(), below_.end(), table) == below_.end()) below_.push_back(std::move(table));
    } else {
      kind = kind_of(field, &value);
    }
    if (const std::string interval = field.range.interval(); !interval.empty()) kind += " " + interval;
    std::string standard(field.default_text);
    if constexpr (!HasTitle<Item>)
      if (standard.empty()) standard = ValueWriter().write(value);
    if (field.presence == Presence::required) standard = "**required**";
    text_ += fmt::format("| `{}` | {} | {} | {} |\n", field.key, escaped(kind), escaped(standard), escaped(field.text));
  }

  template <class T>
  static std::pair<std::string, std::string> section() {
    constexpr const T* type = nullptr;
    std::string note;
    if (!row_keys(type).empty()) {
      note = "As a row: `[";
      for (const std::string_view key : row_keys(type))
        note += fmt::format("{}{}", note.back() == '[' ? "" : ", ", key);
      note += "]`.";
    }
    if (is_map(type) && row_keys(type).size() == 2) note += fmt::format(" As a map: `{{ {} = {} }}`.", row_keys(type)[0], row_keys(type)[1]);
    if (is_map(type) && row_keys(type).size() > 2) note += fmt::format(" As a map: `{{ {} = {{ {} = ... }} }}`.", row_keys(type)[0], row_keys(type)[1]);
    if (!scalar_key(type).empty())
      note += fmt::format("{}A bare value stands for `{}`.", note.empty() ? "" : " ", scalar_key(type));
    return {std::string(title_of(type)), keys<T>(note)};
  }

  template <class T>
  static std::string keys(const std::string& note) {
    Rows rows;
    T table;
    visit(rows, table);
    std::string out = note.empty() ? "" : note + "\n\n";
    out += "| key | value | default | |\n| --- | --- | --- | --- |\n" + rows.text_;
    for (const auto& [title, text] : rows.below_) out += "\n#### " + title + "\n\n" + text;
    return out;
  }

 private:
  std::string text_;
  std::vector<std::pair<std::string, std::string>> below_;
};

template <class T>
std::string chapter(std::string_view heading, std::string_view note = "") {
  return fmt::format("\n## {}\n\n{}", heading, Rows::keys<T>(std::string(note)));
}

template <class... Kinds>
std::string section_chapters(const std::variant<Kinds...>*) {
  return (chapter<Kinds>(fmt::format("[section.NAME] by {}", Kinds::title), Kinds::note) + ...);
}

constexpr std::string_view introduction = R"(# Scene reference

Written by `nsframe reference` from the schema in `src/scene/schema*.hpp`; a test compares the two.

A scene is a TOML file. Numbers are SI, or texts with a unit: `"2.5 cm"`, `"0.30 g"`, `"4600 kg"`, `"235 MPa"`,
`"2.2e7 N m/rad"`. Units: m cm mm km in ft, kg t, s ms us min, Hz kHz, rad deg, g (9.80665 m/s2) Gal, N kN MN kip,
Pa kPa MPa GPa ksi, %; blanks or `*` multiply, each `/` divides by the one unit behind it, powers are written `m2` or
`s^-1`. The value column gives the SI unit. Where "one or more" is said, a list of one may be written as its value.
Names and ids are texts or whole numbers; node and element ids are unique inside a structure, and a node is called
`structure.node` from outside. `--set key=value` replaces or adds a value, by its dotted key: `--set analysis.dt=1e-4`,
`--set structure.left.stories=3`; `contact.restitution` and other keys below `contact`, `static` and `motion` reach all of them.
In a material of a spring, stresses are forces or moments and strains are displacements or angles, as bare numbers in SI.
)";

}  // namespace

std::string scene_reference() {
  std::string out(introduction);
  out +=
      "\nTop level: `title`, `[material.NAME]`, `[section.NAME]`, `[structure.NAME]`, `[[contact]]`, `[gravity]`, "
      "`[[static]]`, `[motion]` or `[[motion]]`, `[analysis]`, `[output]`, `[calibration]`.\n";
  for_each_law([&out](const auto& law) {
    std::string variety;
    if constexpr (requires { law.variety; }) variety = fmt::format(", {}", law.variety);
    out += chapter<std::decay_t<decltype(law)>>(fmt::format("[material.NAME], law = \"{}\"{}", law.name, variety));
  });
  out += section_chapters(static_cast<const SectionKind*>(nullptr));
  out += chapter<ExplicitStructure>("[structure.NAME], explicit");
  out += chapter<StoryFrameTable>(
      "[structure.NAME], model = \"story_frame\"",
      "Nodes are called floor * 10 + i: i = 1 to 4 the outer corners (-x,-y), (+x,-y), "
      "(+x,+y), (-x,+y), 5 the slab's centre, 6 and on the other column lines; floor 0 is the base.");
  out += chapter<ContactTable>("[[contact]]");
  out += chapter<GravityTable>("[gravity]");
  out += chapter<StageTable>(
      "[[static]]",
      "Stages run in their order, after gravity and before the motion; the loads of a finished stage stay. Contacts don't "
      "act in them. A scene without motion and `analysis.duration` ends with its last stage.");
  out += chapter<MotionTable>("[motion]");
  out += chapter<AnalysisOptions>("[analysis]");
  out += chapter<OutputOptions>("[output]");
  out += chapter<CalibrationTable>(
      "[calibration]",
      "Of `nsframe calibrate`; other commands check it and leave it at that. Keys below `material`, `section`, `structure` and `gravity` "
      "can be fitted.");
  return out;
}

}  // namespace nsframe
