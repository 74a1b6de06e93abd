// Errors of sections and materials that building a model reports, with their words and places.
#include <doctest/doctest.h>

#include "tests/models/descriptions.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("an elastic member needs a section centred on its principal axes, a fiber member needs fibers") {
  ModelDescription d = column();
  d.materials = {{"steel", {}, Elastic{210e9}}};
  d.sections.push_back(fibers("centred", 0, "steel"));
  d.sections.push_back(fibers("shifted", 0.02, "steel"));
  only(d).elements[0].section = {"centred", at(6)};
  only(d).elements[0].at = at(5);
  CHECK(error_of(d) == "no error");
  only(d).elements[0].section.name = "shifted";
  CHECK(error_of(d) ==
        "s.toml:6:3: error: element 'a.e1' is elastic, but the fibers of section 'shifted' are not centred on their principal axes; "
        "use a fiber element, or give A, Iz, Iy, J");
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    only(d).elements[0].kind = kind;
    CHECK(error_of(d) == "no error");
    only(d).elements[0].points = 2;
    CHECK(error_of(d) == "s.toml:5:3: error: element 'a.e1': points = 2, must lie in [3, 10]");
    only(d).elements[0].points = 5;
    only(d).elements[0].section.name = "c";
    CHECK(error_of(d) == "s.toml:6:3: error: element 'a.e1' needs fibers, section 'c' has elastic constants only");
    only(d).elements[0].section.name = "shifted";
  }
}

TEST_CASE("a section without fibers, or with impossible constants, is an error, and members of it raise no others") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam, ElementKind::elastic_beam}) {
    ModelDescription d = column();
    FiberSectionDescription empty;
    empty.torsion_stiffness = 1e4;
    d.sections[0] = {"c", at(31), empty, {}};
    only(d).elements[0].kind = kind;
    CHECK(error_of(d) == "s.toml:31:3: error: section 'c' has no fibers");
  }
  ModelDescription d = column();
  d.materials = {{"steel", {}, Elastic{210e9}}};
  SectionDescription bad = fibers("f", 0, "steel");
  std::get<FiberSectionDescription>(bad.kind).torsion_stiffness = 0;
  std::get<FiberSectionDescription>(bad.kind).fibers[1].area = -1e-3;
  d.sections.push_back(bad);
  CHECK(error_of(d) ==
        "s.toml:31:3: error: section 'f': a fiber's area must be positive\n"
        "s.toml:31:3: error: section 'f': the torsion stiffness GJ must be positive");
  d = column();
  d.sections[0] = elastic_section("c", {210e9, 81e9, 0, 1e-5, 4e-6, -1});
  d.sections[0].at = at(31);
  CHECK(error_of(d) ==
        "s.toml:31:3: error: section 'c': A must be positive\n"
        "s.toml:31:3: error: section 'c': J must be positive");
}

TEST_CASE("a law with an impossible parameter is an error, and its members raise no others") {
  for (const ElementKind kind : {ElementKind::displacement_beam, ElementKind::force_beam}) {
    ModelDescription d = column();
    d.materials = {{"steel", at(29), Steel02{235e6, 0, 0.01}}};
    d.sections.push_back(fibers("f", 0, "steel"));
    only(d).elements[0].section.name = "f";
    only(d).elements[0].kind = kind;
    const auto errors = errors_of(d);
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].starts_with("s.toml:29:3: error: material 'steel': "));
  }
}

TEST_CASE("wrappers of laws that are not there, or of themselves, are errors at the place") {
  ModelDescription d = column();
  const auto around = [](const std::string& name, int line) { return MinMax{{{name, at(line)}, nullptr}, {}, 0.1}; };
  d.materials = {{"steel", at(28), Elastic{210e9}}, {"brittle", at(29), around("steal", 30)}};
  CHECK(error_of(d) == "s.toml:30:3: error: material 'steal' is not defined; did you mean 'steel'?");
  d.materials[1].law = around("steel", 30);
  CHECK(error_of(d) == "no error");
  // three in a ring, met from outside
  d.materials = {{"a", at(25), around("b", 26)}, {"b", at(27), around("c", 28)}, {"c", at(29), around("d", 30)},
                 {"d", at(31), around("b", 32)}};
  CHECK(error_of(d) == "s.toml:32:3: error: material 'b' is made of itself: b, c, d, b");
  d.materials = {{"a", at(25), around("a", 26)}};
  CHECK(error_of(d) == "s.toml:26:3: error: material 'a' is made of itself: a, a");
  // an error inside is reported once, where it is
  d.materials = {{"a", at(25), around("b", 26)}, {"b", at(27), Elastic{-1}}};
  CHECK(error_of(d) == "s.toml:27:3: error: material 'b': E must be positive");
  d.materials = {{"a", at(25), InitStress{{{"b", at(26)}, nullptr}, 2e8}}, {"b", at(27), ElasticPP{2e11, 5e-4}}};
  CHECK(error_of(d) == "s.toml:25:3: error: material 'a': sigInit is not reached by the material's first loading");
  // a section of such a material raises no others
  d.sections.push_back(fibers("f", 0, "a"));
  CHECK(errors_of(d).size() == 1);
}
