// Linear buckling of a cantilever by the number of its elements.
#include <fmt/format.h>

#include "integrators/buckling.hpp"
#include "integrators/static_analysis.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/small_models.hpp"
#include "tests/verification/registry.hpp"

using namespace nsframe;
using namespace nsframe::test;

VERIFICATION_CASE("Frames", "Buckling of a cantilever",
                  "2.5 m, E = 210 GPa, I = 1.033e-5 m4, elastic P-Delta elements; critical load by eigenvalues over Euler's pi^2 EI/(4 L^2). "
                  "OpenSees 3.7.1 with the same elements, whose loads were bisected to 1e-6; Euler's load itself within the elements' error.") {
  constexpr double height = 2.5, E = 210e9, I = 1.033e-5;  // [m], [Pa], [m4]
  for (const auto& row : read_reference("buckling")) {     // transformation, elements, load, ratio
    if (row[0] != 0) continue;                             // P-Delta
    const int elements = static_cast<int>(row[1]);
    ModelDescription d;
    d.sections = {elastic_section("c", {E, 81e9, 3.142e-3, I, I, 8e-8})};
    StructureDescription s;
    s.name = "a";
    s.nodes = {node("0", 0, 0, 0)};
    s.supports = {fixed("0")};
    for (int i = 1; i <= elements; ++i) {
      s.nodes.push_back(node(std::to_string(i), 0, 0, height * i / elements));
      s.supports.push_back(fixed(std::to_string(i), {false, true, false, true, false, true}));
      s.elements.push_back(beam(std::to_string(i), std::to_string(i - 1), std::to_string(i), "c"));
      s.elements.back().geometry = Geometry::p_delta;
    }
    d.structures = {s};
    const Model model = build(d);
    System system(model, 1);
    VectorX load = VectorX::Zero(model.dofs.full);
    load[6 * elements + 2] = -1;
    const double critical =
        buckling_modes(system, virgin_state(system), model.dofs.transformation_transposed * load, 1).at(0).load_factor;
    const double ratio = critical * 4 * height * height / (pi * pi * E * I);
    rows.add(fmt::format("{} element{}, OpenSees", elements, elements == 1 ? "" : "s"), ratio, row[3], relative(2e-6));
    if (elements == 16) rows.add("16 elements, Euler", ratio, 1, relative(1e-3));
  }
}
