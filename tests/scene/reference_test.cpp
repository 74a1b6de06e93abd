#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "scene/scene.hpp"

TEST_CASE("docs/scene-reference.md is what the schema says") {
  std::ifstream file(NSFRAME_SOURCE_DIR "/docs/scene-reference.md");
  std::ostringstream committed;
  committed << file.rdbuf();
  INFO("run `nsframe reference > docs/scene-reference.md` and commit the file");
  CHECK((committed.str() == nsframe::scene_reference()));
}
