#include "output/paraview_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/gap_offsets.hpp"

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
LARGEST = {largest:g}  # displacement of the whole run (m)
# Name of each structure, and by how much it and its contacts are moved (m), so that gaps are drawn SCALE times wider too: buildings that
# touch are drawn touching. All zeros: the true gaps.
STRUCTURES = [
{structures}]

folder = os.path.dirname(os.path.abspath(__file__)) if "__file__" in globals() else os.getcwd()
frames = PVDReader(registrationName="frames", FileName=os.path.join(folder, "frames.pvd"))
frames.UpdatePipeline()

view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()

deformed = WarpByVector(registrationName="deformed", Input=frames)
deformed.Vectors = ["POINTS", "displacement"]
deformed.ScaleFactor = SCALE


def threshold(name, source, array, lowest, highest=1e300):
    """Cells or points of `source` whose `array` lies in the range, in ParaView before and after 5.10."""
    chosen = Threshold(registrationName=name, Input=source)
    chosen.Scalars = array
    if hasattr(chosen, "LowerThreshold"):
        chosen.LowerThreshold, chosen.UpperThreshold = lowest, highest
    else:
        chosen.ThresholdRange = [lowest, highest]
    return chosen


def moved(name, source, offset):
    shifted = Transform(registrationName=name, Input=source)
    shifted.Transform.Translate = offset
    return shifted


def dark(proxy, *names):
    """Sets those of the properties that this ParaView has to the colour of text on white."""
    for name in names:
        if hasattr(proxy, name):
            setattr(proxy, name, [0.1, 0.1, 0.1])


colors = GetColorTransferFunction("displacement")
for number, (name, offset, mark_offset) in enumerate(STRUCTURES):
    own = threshold("cells of " + name, deformed, ["CELLS", "structure"], number, number)
    members = threshold("members of " + name, own, ["CELLS", "kind"], 1)  # kind 0: contact pairs
    shown = Show(moved(name, members, offset), view)
    shown.Representation = "Surface"
    ColorBy(shown, ("POINTS", "displacement", "Magnitude"))
    # For the parts that have yielded: ColorBy(shown, ("CELLS", "yielded")) or ("CELLS", "peak_strain_ratio").

    # Contact pairs, marked where they have transmitted an impulse since the frame before.
    contacts = threshold("contacts of " + name, own, ["CELLS", "kind"], 0, 0)
    hits = threshold("impacts on " + name, contacts, ["CELLS", "impulse"], 1e-12)
    centers = CellCenters(registrationName="contact points of " + name, Input=hits)
    glyphs = Glyph(registrationName="marks on " + name, Input=centers, GlyphType="Sphere")
    glyphs.ScaleArray = ["POINTS", "No scale array"]
    glyphs.ScaleFactor = {mark:g}
    glyphs.GlyphMode = "All Points"
    spheres = Show(moved("impact marks of " + name, glyphs, mark_offset), view)
    spheres.ColorArrayName = ["POINTS", ""]  # one colour
    spheres.AmbientColor = spheres.DiffuseColor = [0.84, 0.37, 0.0]

colors.ApplyPreset("Viridis (matplotlib)", True)
if LARGEST > 0:
    colors.RescaleTransferFunction(0, LARGEST)
else:
    shown.RescaleTransferFunctionToDataRange(True, False)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colors, view)
bar.Title, bar.ComponentTitle = "displacement (m)", ""
bar.TitleFontSize, bar.LabelFontSize = 14, 12
bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.3g"
dark(bar, "TitleColor", "LabelColor")

clock = AnnotateTimeFilter(registrationName="time", Input=frames)
gaps = " and gaps" if any(any(offset) for _, offset, _ in STRUCTURES) else ""
clock.Format = "%s,  t = {{time:.3f}} s,  displacements%s x %g" % (os.path.basename(folder).translate({{123: "{{{{", 125: "}}}}"}}), gaps, SCALE)
caption = Show(clock, view)
caption.FontSize = 14
dark(caption, "Color")

if hasattr(view, "UseColorPaletteForBackground"):
    view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
dark(view, "OrientationAxesLabelColor")
grid = view.AxesGrid
grid.Visibility = 1
grid.XTitle, grid.YTitle, grid.ZTitle = "x (m)", "y (m)", "z (m)"
for axis in "XYZ":
    dark(grid, axis + "TitleColor", axis + "LabelColor")
grid.GridColor = [0.6, 0.6, 0.6]
view.CameraFocalPoint = [{cx:g}, {cy:g}, {cz:g}]
view.CameraPosition = [{px:g}, {py:g}, {pz:g}]
view.CameraViewUp = [0, 0, 1]
GetAnimationScene().AnimationTime = {time:g}  # the largest displacement
view.ResetCamera()
Render()
)py";

// How far each structure is moved so that gaps are `scale` times as wide, and its contacts with it: to the middle of a gap.
struct Offsets {
  std::vector<Vector3> structure, contacts;
};

Offsets widened_gaps(const Model& model, double scale) {
  std::vector<StructureGap> gaps;
  const auto structure_of = [&](const ContactPoint& point) { return model.nodes.structure[static_cast<std::size_t>(point.first_node())]; };
  std::vector<Vector3> across(model.structures.size(), Vector3::Zero());
  std::vector<int> pairs(model.structures.size(), 0);
  for (int pair = 0; pair < model.contacts.size(); ++pair) {
    const ContactPair& contact = model.contacts.pairs[static_cast<std::size_t>(pair)];
    if (contact.a.fixed() || contact.b.fixed()) continue;
    gaps.push_back({structure_of(contact.a), structure_of(contact.b), model.contacts.initial_gap[pair] * contact.normal});
    across[static_cast<std::size_t>(gaps.back().from)] += gaps.back().gap;
    ++pairs[static_cast<std::size_t>(gaps.back().from)];
  }
  Offsets offsets{gap_offsets(model.structures.size(), gaps), {}};
  for (std::size_t s = 0; s < across.size(); ++s) {
    offsets.structure[s] *= scale - 1;
    offsets.contacts.push_back(offsets.structure[s] + 0.5 * (scale - 1) / std::max(1, pairs[s]) * across[s]);
  }
  return offsets;
}

// Within a quoted Python string.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string structures_text(const Model& model, double scale) {
  const Offsets offsets = widened_gaps(model, scale);
  const auto list = [](const Vector3& v) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v.x(), v.y(), v.z()); };
  std::string text;
  for (std::size_t s = 0; s < model.structures.size(); ++s)
    text += fmt::format("    (\"{}\", {}, {}),\n", quoted(model.structures[s].name), list(offsets.structure[s]), list(offsets.contacts[s]));
  return text;
}

}  // namespace

std::string paraview_script(const Model& model, const ParaviewView& view) {
  const Box box = bounds(model);
  const Vector3 center = 0.5 * (box.low + box.high);
  const double distance = 2 * std::max(box.diagonal(), 1e-3);
  const Vector3 camera = center + distance * Vector3(0.5, -0.8, 0.35).normalized();
  using fmt::arg;
  return fmt::format(fmt::runtime(script), arg("scale", view.scale), arg("structures", structures_text(model, view.scale)),
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
