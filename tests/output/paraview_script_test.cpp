#include <doctest/doctest.h>

#include <cstdlib>

#include "output/gap_offsets.hpp"
#include "output/paraview_script.hpp"
#ifdef NSFRAME_HAS_VTK
#include "output/vtk_frames.hpp"
#endif
#include "tests/output/sample_pair.hpp"
#include "tests/support/files.hpp"

using namespace nsframe;
using namespace nsframe::test;

TEST_CASE("gaps along a row of neighbours add up, and pairs of the same two structures share their mean") {
  const Vector3 x = Vector3::UnitX();
  const auto offsets = gap_offsets(4, {{0, 1, 0.02 * x}, {0, 1, 0.04 * x}, {2, 1, -0.05 * x}, {2, -1, 0.3 * x}});
  CHECK(offsets[0].norm() == 0);
  CHECK((offsets[1] - 0.03 * x).norm() < 1e-15);
  CHECK((offsets[2] - 0.08 * x).norm() < 1e-15);  // 2 touches 1 from the other side
  CHECK(offsets[3].norm() == 0);                  // alone
}

TEST_CASE("the scale of the ParaView script makes the largest displacement visible") {
  const Model model = sample_pair();
  CHECK(visible_scale(model, 0) == 1);
  CHECK(visible_scale(model, 10) == 1);
  const double scale = visible_scale(model, 0.01);
  CHECK(scale * 0.01 > 0.02 * 8.6);  // the diagonal of the pair is 8.6 m
  CHECK(scale * 0.01 < 0.08 * 8.6);
}

TEST_CASE("the ParaView script draws gaps as much wider as displacements larger") {
  const std::string script = paraview_script(sample_pair(), {5, 0.01, 0});  // gaps of 5 and 5.5 cm, on the mean 4 times 5.25 cm wider
  CHECK(script.find("(\"left\", [0, 0, 0], [0.105, 0, 0])") != std::string::npos);
  CHECK(script.find("(\"right\", [0.21, 0, 0], [0.21, 0, 0])") != std::string::npos);
  CHECK(paraview_script(sample_pair(), {1, 0.01, 0}).find("(\"right\", [0, 0, 0], [0, 0, 0])") != std::string::npos);
}

#ifdef NSFRAME_HAS_VTK
TEST_CASE("the ParaView script is valid Python that names the frames and starts at the largest displacement") {
  const TemporaryFolder folder;
  const Model model = sample_pair();
  OutputOptions options;
  options.frames = 1000;
  VtkFrames frames(folder.path(), options);
  const State rest = sample_state(model);
  frames.start(model, rest);
  State peak = rest;
  peak.time = 1e-3;
  peak.displacement *= 3;
  frames.step(rest, peak, {}, {});
  frames.finish();
  const std::string script = file_text(folder / "open_in_paraview.py");
  CHECK(script.find("AnimationTime = 0.001") != std::string::npos);
  CHECK(script.find("\"frames.pvd\"") != std::string::npos);
  CHECK(script.find("t = {time:.3f} s") != std::string::npos);
  CHECK(script.find("{scale") == std::string::npos);
  const std::string command = "python3 -m py_compile '" + (folder / "open_in_paraview.py").string() + "' 2>&1";
  if (std::system("python3 --version > /dev/null 2>&1") == 0) CHECK(std::system(command.c_str()) == 0);
}

#endif
