#include "output/paraview_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nsframe {
namespace {

struct Box {
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();
  double diagonal() const { return (high - low).norm(); }
};

Box bounds(const Model& model) {
  Box box;
  if (model.nodes.size() == 0) return box;
  box.low = box.high = model.nodes.position[0];
  for (const auto& position : model.nodes.position) {
    box.low = box.low.cwiseMin(position);
    box.high = box.high.cwiseMax(position);
  }
  return box;
}

// Doubled braces are fmt's; the script itself has single ones.
constexpr const char* script = R"py(# Opens the frames of this run in ParaView:  paraview --script=open_in_paraview.py
import os

from paraview.simple import *

SCALE = {scale:g}  # displacements are drawn this many times larger

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
frames = PVDReader(registrationName="frames", FileName=os.path.join(folder, "frames.pvd"))
frames.UpdatePipeline()

view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()

deformed = WarpByVector(registrationName="deformed", Input=frames)
deformed.Vectors = ["POINTS", "displacement"]
deformed.ScaleFactor = SCALE


def threshold(name, source, array, lowest):
    """Cells or points of `source` whose `array` is at least `lowest`, in ParaView before and after 5.10."""
    chosen = Threshold(registrationName=name, Input=source)
    chosen.Scalars = array
    if hasattr(chosen, "LowerThreshold"):
        chosen.LowerThreshold, chosen.UpperThreshold = lowest, 1e300
    else:
        chosen.ThresholdRange = [lowest, 1e300]
    return chosen


# The structures: everything but the contact pairs (kind 0).
members = threshold("structures", deformed, ["CELLS", "kind"], 1)
shown = Show(members, view)
shown.Representation = "Surface"
ColorBy(shown, ("POINTS", "displacement", "Magnitude"))
colors = GetColorTransferFunction("displacement")
LARGEST = {largest:g}  # displacement of the whole run (m)
if LARGEST > 0:
    colors.RescaleTransferFunction(0, LARGEST)
else:
    shown.RescaleTransferFunctionToDataRange(True, False)
colors.ApplyPreset("Viridis (matplotlib)", True)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colors, view)
bar.Title = "displacement (m)"
bar.ComponentTitle = ""

# For the parts that have yielded: ColorBy(shown, ("CELLS", "yielded")) or ("CELLS", "peak_strain_ratio").

# Contact pairs, marked where they have transmitted an impulse since the frame before.
marks = CellCenters(registrationName="contact pairs", Input=deformed)
hits = threshold("impacts", marks, ["POINTS", "impulse"], 1e-12)
glyphs = Glyph(registrationName="impact marks", Input=hits, GlyphType="Sphere")
glyphs.ScaleArray = ["POINTS", "No scale array"]
glyphs.ScaleFactor = {mark:g}
glyphs.GlyphMode = "All Points"
spheres = Show(glyphs, view)
ColorBy(spheres, None)
spheres.AmbientColor = spheres.DiffuseColor = [0.84, 0.37, 0.0]

clock = AnnotateTimeFilter(registrationName="time", Input=frames)
clock.Format = "{title}   t = {{time:.3f}} s   displacements x {scale:g}"
Show(clock, view)

view.AxesGrid.Visibility = 1
view.AxesGrid.XTitle, view.AxesGrid.YTitle, view.AxesGrid.ZTitle = "x (m)", "y (m)", "z (m)"
view.CameraFocalPoint = [{cx:g}, {cy:g}, {cz:g}]
view.CameraPosition = [{px:g}, {py:g}, {pz:g}]
view.CameraViewUp = [0, 0, 1]
GetAnimationScene().AnimationTime = {time:g}  # the largest displacement
view.ResetCamera()
Render()
)py";

// Within a quoted Python string that str.format reads.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    if (c == '{' || c == '}') safe += c;
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

}  // namespace

std::string paraview_script(const Model& model, const ParaviewView& view) {
  const Box box = bounds(model);
  const Vector3 center = 0.5 * (box.low + box.high);
  const double distance = 2 * std::max(box.diagonal(), 1e-3);
  const Vector3 camera = center + distance * Vector3(0.5, -0.8, 0.35).normalized();
  using fmt::arg;
  return fmt::format(fmt::runtime(script), arg("scale", view.scale), arg("title", quoted(view.title)),
                     arg("largest", view.largest_displacement), arg("time", view.time),
                     arg("mark", 0.04 * std::max(box.diagonal(), 1e-3)), arg("cx", center.x()), arg("cy", center.y()),
                     arg("cz", center.z()), arg("px", camera.x()), arg("py", camera.y()), arg("pz", camera.z()));
}

double visible_scale(const Model& model, double largest_displacement) {
  const double wanted = 0.04 * bounds(model).diagonal();
  if (!(largest_displacement > 0) || wanted <= largest_displacement) return 1;
  const double ratio = wanted / largest_displacement;
  const double decade = std::pow(10.0, std::floor(std::log10(ratio)));
  const double leading = ratio / decade;
  return std::max(1.0, decade * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10));
}

}  // namespace nsframe
