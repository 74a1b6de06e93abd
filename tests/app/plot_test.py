#!/usr/bin/env python3
"""nsframe plot: values read off the figures by their ticks are those of the run, wrong names are refused, PNG has its size and ink.

    plot_test.py PROGRAM SOURCE png|no-png [--keep FOLDER]      (png: the program was built with librsvg; for the figures)
"""
import math
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from png_pixels import pixels
from program import SOURCE, nsframe, run

PNG = sys.argv[3] == "png"
KEEP = pathlib.Path(sys.argv[5]).resolve() if len(sys.argv) > 5 else None
HISTORY = 'output.history=["nodes", "contacts", "energy", "ground", "sections"]'


def number(text):
    return float(text.replace("−", "-"))


class Axis:
    """Values of pixels, from the labels of two ticks; of decades where `log`."""

    def __init__(self, ticks, log=False):
        (self.p, first), (q, second) = ticks[0], ticks[-1]
        self.log = log
        self.first = math.log10(first) if log else first
        self.slope = ((math.log10(second) if log else second) - self.first) / (q - self.p)

    def value(self, pixel):
        value = self.first + self.slope * (pixel - self.p)
        return 10**value if self.log else value


class Panel:
    """One chart of an SVG: its axes as a reader sees them, its curves in their values."""

    def __init__(self, root, frame, log_x):
        x, y, width, height = (float(frame.get(key)) for key in ("x", "y", "width", "height"))
        self.frame = (x, y, width, height)
        texts = [t for t in root.iter("text")]
        self.texts = ["".join(t.itertext()) for t in texts]
        foot, xs, ys = y + height, [], []
        for t in texts:
            if t.get("x") is None:
                continue
            if t.get("text-anchor") == "middle" and abs(float(t.get("y")) - foot - 20) < 0.2:
                power = t.find("tspan")
                xs.append((float(t.get("x")), 10 ** number(power.text) if power is not None else number(t.text)))
            if t.get("text-anchor") == "end" and abs(float(t.get("x")) - x + 8) < 0.2 and y - 1 < float(t.get("y")) - 5 < foot + 1:
                ys.append((float(t.get("y")) - 5, number(t.text)))
        self.x, self.y = Axis(xs, log_x), Axis(ys)
        inside = lambda py: y - 0.5 <= py <= foot + 0.5
        self.curves, self.dashed, self.marks = [], [], []
        for line in root.iter("polyline"):
            points = [tuple(map(float, point.split(","))) for point in line.get("points").split()]
            if all(inside(py) for _, py in points):
                self.curves.append([(self.x.value(px), self.y.value(py)) for px, py in points])
                self.dashed.append(line.get("stroke-dasharray") is not None)
        for path in root.iter("path"):
            px, py = map(float, re.match(r"M([-\d.]+) ([-\d.]+)", path.get("d")).groups())
            if inside(py + 8) and px <= x + width + 0.5:
                self.marks.append(self.x.value(px))
        self.stems = [(self.x.value(float(c.get("cx"))), self.y.value(float(c.get("cy")))) for c in root.iter("circle")
                      if inside(float(c.get("cy"))) and float(c.get("cx")) <= x + width]

    def peak(self, curve):
        return max(abs(y) for _, y in self.curves[curve])

    @property
    def pixel(self):  # value of a tenth of a pixel, to which points are written, on the vertical axis
        return abs(self.y.slope) * 0.1


def panels(path, log_x=False):
    text = pathlib.Path(path).read_text(encoding="utf-8")
    root = xml.etree.ElementTree.fromstring(text.replace(' xmlns="http://www.w3.org/2000/svg"', "", 1))
    frames = [r for r in root.iter("rect") if r.get("fill") == "none"]
    return [Panel(root, frame, log_x) for frame in frames], root


class PlotTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.held = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.held.name) / "pair"
        cls.summary = run(cls.folder, "two_story_elastic", "analysis.duration=8", "output.floor_spectra=floors", HISTORY)
        cls.peaks = {peak["node"]: peak for peak in cls.summary["peaks"]}

    @classmethod
    def tearDownClass(cls):
        cls.held.cleanup()

    def plot(self, *options, folder=None, log_x=False, name="figure.svg"):
        target = pathlib.Path(self.held.name) / name
        made = nsframe("plot", folder or self.folder, "-o", target, *options)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(made.stdout, "%s\n" % target)
        if KEEP:
            KEEP.mkdir(parents=True, exist_ok=True)
            shutil.copy(target, KEEP / (self.id().split(".")[-1] + target.suffix))
        return panels(target, log_x) if target.suffix == ".svg" else target

    def refused(self, expected, *options, folder=None):
        target = pathlib.Path(self.held.name) / "refused.svg"
        made = nsframe("plot", folder or self.folder, "-o", target, *options)
        self.assertEqual(made.returncode, 2, options)
        self.assertIn(expected, made.stderr)
        self.assertFalse(target.exists())

    def test_peaks_of_nodes_and_times_of_poundings_can_be_read_off(self):
        (panel,), root = self.plot("--quantity", "displacement", "--nodes", "left.25,right.21", "--direction", "x")
        for curve, node in enumerate(("left.25", "right.21")):
            self.assertAlmostEqual(panel.peak(curve), 1e3 * self.peaks[node]["displacement"][0], delta=1.5 * panel.pixel)
        self.assertIn("displacement, mm", panel.texts)
        self.assertIn("time, s", panel.texts)
        self.assertIn("left.25", panel.texts)
        self.assertAlmostEqual(panel.curves[0][0][0], 0, delta=0.01)
        self.assertAlmostEqual(panel.curves[0][-1][0], 8, delta=0.01)
        times = [p["t"] for p in self.summary["poundings"]]
        self.assertGreater(len(times), 2)
        self.assertEqual(len(panel.marks), len(times))
        for drawn, known in zip(sorted(panel.marks), sorted(times)):
            self.assertAlmostEqual(drawn, known, delta=2e-3 * 8)

    def test_without_options_the_largest_displacement_and_impulses_are_drawn(self):
        (above, below), root = self.plot()
        self.assertIn("Displacement along x, relative to the base", above.texts)
        roof = max(self.peaks[n]["displacement"][0] for n in ("left.25", "right.25"))
        self.assertAlmostEqual(max(map(above.peak, range(len(above.curves)))), 1e3 * roof, delta=1.5 * above.pixel)
        self.assertEqual(len(below.stems), len(self.summary["poundings"]))
        largest = max(p["impulse"] for p in self.summary["poundings"])
        self.assertAlmostEqual(max(y for _, y in below.stems), largest, delta=1.5 * below.pixel)
        self.assertEqual(root.get("width"), "1000")
        self.assertFalse((self.folder / "plot.svg").exists())
        self.assertEqual(nsframe("plot", self.folder).returncode, 0)
        self.assertTrue((self.folder / "plot.svg").exists())

    def test_a_window_in_time_is_drawn_to_its_ends_and_with_its_own_peaks(self):
        first = self.summary["poundings"][0]["t"]
        (panel,), _ = self.plot("--quantity", "gap", "--from", "%g s" % (first - 0.05), "--to", first + 0.05)
        for curve in panel.curves:
            self.assertGreater(len(curve), 50)  # of 101 rows, some within a tenth of a pixel of the row before
            self.assertAlmostEqual(curve[0][0], first - 0.05, delta=2e-3)
            self.assertAlmostEqual(curve[-1][0], first + 0.05, delta=2e-3)
        least = min(y for curve in panel.curves for _, y in curve)
        self.assertLess(abs(least), 1e3 * self.summary["max_penetration"] + 1.5 * panel.pixel + 1)  # it closes: mm
        self.assertTrue(all(first - 0.06 < mark < first + 0.06 for mark in panel.marks))

    def test_drifts_twists_and_accelerations_are_those_of_the_summary(self):
        (drift, twist, acceleration), _ = self.plot("--quantity", "drift,twist,acceleration", "--floors", "left.1,left.2")
        for curve, story in enumerate((1, 2)):
            known = next(d for d in self.summary["drifts"] if (d["structure"], d["story"]) == ("left", story))
            self.assertAlmostEqual(drift.peak(curve), 100 * known["drift"][0], delta=1.5 * drift.pixel)
        self.assertAlmostEqual(twist.peak(1), 1e3 * self.peaks["left.25"]["twist"], delta=1.5 * twist.pixel)
        self.assertAlmostEqual(acceleration.peak(1), self.peaks["left.25"]["acceleration"][0], delta=1.5 * acceleration.pixel)

    def test_floor_spectra_energy_and_ground(self):
        (panel,), _ = self.plot("--quantity", "spectrum", "--nodes", "left.25", log_x=True)
        known = next(s for s in self.summary["floor_spectra"] if (s["node"], s["direction"]) == ("left.25", "x"))
        self.assertAlmostEqual(panel.peak(0), known["psa"], delta=1.5 * panel.pixel)
        period = max(panel.curves[0], key=lambda point: point[1])[0]
        self.assertAlmostEqual(period / known["psa_period"], 1, delta=0.01)
        (energy, error, base, velocity), _ = self.plot("--quantity", "energy,ground")
        final = {text: curve[-1][1] for text, curve in zip(("input", "kinetic", "strain", "damping", "contact", "numerical"), energy.curves)}
        scale = 1e-3 if "energy, kJ" in energy.texts else 1
        for name, value in final.items():
            self.assertAlmostEqual(value, scale * self.summary["energy"][name], delta=1.5 * energy.pixel, msg=name)
        self.assertAlmostEqual(base.peak(0), 0.3 * 9.80665, delta=0.01)

    def test_an_orbit_has_one_scale_along_both_axes(self):
        (panel,), _ = self.plot("--quantity", "orbit", "--nodes", "left.25")
        self.assertAlmostEqual(abs(panel.x.slope / panel.y.slope), 1, delta=2e-3)
        self.assertAlmostEqual(max(abs(x) for x, _ in panel.curves[0]), 1e3 * self.peaks["left.25"]["displacement"][0],
                               delta=3 * panel.pixel)

    def test_a_second_run_is_drawn_with_dashes_in_the_same_colour(self):
        other = pathlib.Path(self.held.name) / "half"
        summary = run(other, "two_story_elastic", "analysis.duration=8", "analysis.theta=0.5", HISTORY)
        (panel,), root = self.plot("--quantity", "displacement", "--nodes", "left.25", "--direction", "x", "--compare", other,
                                   "--labels", "one,half")
        peak = next(p for p in summary["peaks"] if p["node"] == "left.25")["displacement"][0]
        self.assertEqual(panel.dashed, [False, True])
        self.assertAlmostEqual(panel.peak(0), 1e3 * self.peaks["left.25"]["displacement"][0], delta=1.5 * panel.pixel)
        self.assertAlmostEqual(panel.peak(1), 1e3 * peak, delta=1.5 * panel.pixel)
        self.assertEqual(len({line.get("stroke") for line in root.iter("polyline")}), 1)
        self.assertTrue({"left.25, one", "left.25, half"} <= set(panel.texts))
        self.refused("in the first run only", "--compare", self.quiet())

    def quiet(self):
        """The first second of the pair, when nothing pounds, with node histories only."""
        folder = pathlib.Path(self.held.name) / "quiet"
        if not folder.exists():
            run(folder, "two_story_elastic", "analysis.duration=1", 'output.history=["nodes"]', "output.floor_spectra=none")
        return folder

    def test_hysteresis_is_the_recorded_force_over_the_recorded_deformation(self):
        folder = pathlib.Path(self.held.name) / "yielding"
        run(folder, "two_story", "analysis.duration=4", 'output.history=["sections"]')
        (panel,), _ = self.plot("--quantity", "hysteresis", "--sections", "left.1:1", folder=folder)
        loop = panel.curves[0]
        width, force = max(abs(x) for x, _ in loop), max(abs(y) for _, y in loop)
        # HEA100 of S235 about its strong axis: 2.1e11 Pa * 3.492e-6 m4 elastic; fy W_pl with some hardening, less axial force
        self.assertGreater(width, 1.05 * force * 1e3 / (2.1e11 * 3.49e-6))  # it has yielded
        self.assertTrue(16 < force < 25, force)
        area = 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(loop, loop[1:] + loop[:1]))
        self.assertGreater(abs(area), 0.05 * width * force)  # a loop, not a line
        self.refused("has 5 integration points", "--quantity", "hysteresis", "--sections", "left.1:6", folder=folder)
        self.refused("did you mean 'left.", "--quantity", "hysteresis", "--sections", "lft.1", folder=folder)
        self.refused("number of an integration point", "--quantity", "hysteresis", "--sections", "left.1:a", folder=folder)

    def test_what_does_not_move_is_drawn_as_a_line_at_zero(self):
        (panel,), _ = self.plot("--quantity", "twist", "--nodes", "left.25", folder=self.quiet())
        self.assertLess(panel.peak(0), 0.01)  # mrad: nothing has pounded yet, so nothing twists

    def test_static_stages(self):
        folder = pathlib.Path(self.held.name) / "push"
        summary = run(folder, "pushover")
        (panel,), _ = self.plot(folder=folder)
        self.assertAlmostEqual(panel.curves[0][-1][0], 0.25, delta=1e-3)
        self.assertAlmostEqual(panel.curves[0][-1][1], summary["stages"][0]["load_factor"], delta=1.5 * panel.pixel)
        self.refused("static stages only", "--quantity", "gap", folder=folder)
        self.refused("static stages only", "--quantity", "displacement", folder=folder)

    def test_wrong_names_are_refused_with_the_nearest(self):
        self.refused("did you mean 'displacement'", "--quantity", "displacment")
        self.refused("did you mean 'left.25'", "--nodes", "left.255")
        self.refused("did you mean 'right.2'", "--floors", "rihgt.2")
        self.refused("did you mean 'left.25'", "--quantity", "spectrum", "--nodes", "left.26")
        self.refused("is not known; known: x, y, z", "--direction", "north")
        self.refused("give one of --nodes and --floors", "--nodes", "left.25", "--floors", "left.2")
        self.refused("give --floors", "--quantity", "drift", "--nodes", "left.25")
        self.refused("no histories from 50", "--from", "50", "--to", "60")
        self.refused("is not before", "--from", "5", "--to", "4")
        self.refused("--from", "--from", "5 kg")
        self.refused("--compare", "--labels", "a,b")
        self.refused("--quantity hysteresis", "--sections", "left.1")
        self.refused("too small", "--width", "150")
        self.refused("too small", "--height", "120")
        self.refused("there is no folder", folder=self.folder / "none")

    def test_what_was_not_recorded_is_named_with_its_key(self):
        quiet = self.quiet()
        for quantity, key in (("gap", 'history = ["contacts"]'), ("energy", 'history = ["energy"]'), ("ground", 'history = ["ground"]'),
                              ("spectrum", 'floor_spectra = "floors"'), ("hysteresis", 'history = ["sections"]'),
                              ("impulse", "no poundings"), ("static", "no static stages")):
            self.refused(key, "--quantity", quantity, folder=quiet)

    def test_other_files_are_refused(self):
        for name in ("figure.pdf", "figure"):
            made = nsframe("plot", self.folder, "-o", pathlib.Path(self.held.name) / name)
            self.assertEqual((made.returncode, ".svg or .png" in made.stderr), (2, True))
        made = nsframe("plot", self.folder, "-o", self.folder / "none" / "figure.svg")
        self.assertEqual(made.returncode, 4)

    def test_png_has_its_size_and_ink(self):
        if not PNG:
            made = nsframe("plot", self.folder, "-o", pathlib.Path(self.held.name) / "figure.png")
            self.assertEqual(made.returncode, 2)
            self.assertIn("built without librsvg", made.stderr)
            return
        path = self.plot("--width", "820", "--height", "640", name="figure.png")
        width, height, channels, rows = pixels(path)
        self.assertEqual((width, height), (820, 640))
        colours = {row[i:i + 3] for row in rows for i in range(0, len(row), channels)}
        for colour in ("ffffff", "0072b2", "d55e00", "8c1d40"):  # paper, both structures, poundings
            self.assertIn(bytes.fromhex(colour), colours)
        white = sum(row[i:i + 3] == b"\xff\xff\xff" for row in rows for i in range(0, len(row), channels))
        self.assertTrue(0.5 < white / (820 * 640) < 0.98, white)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
