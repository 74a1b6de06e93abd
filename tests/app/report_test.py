#!/usr/bin/env python3
"""nsframe report: the data in the page are those of the run, wrong folders are refused, and a browser draws it without an error.

    report_test.py PROGRAM SOURCE [--keep FOLDER]      (for the screenshots)
"""
import base64
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

from png_pixels import pixels
from program import nsframe, run

KEEP = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
BROWSER = next((found for found in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if found), None)
PAIR = ("two_story_elastic", "analysis.duration=6", "output.floor_spectra=floors",
        'output.history=["nodes", "contacts", "energy", "ground"]')


def make(folder, example, *settings):
    """Runs an example and makes its page: text of the page, its data, the summary."""
    summary = run(folder, example, *settings)
    made = nsframe("report", folder)
    assert made.returncode == 0, made.stderr
    page = (pathlib.Path(folder) / "report.html").read_text(encoding="utf-8")
    text = re.search(r'<script type="application/json" id="run">(.*?)</script>', page, re.S).group(1)
    data = json.loads(text, parse_constant=lambda word: (_ for _ in ()).throw(ValueError(word)))
    return page, data, summary


def charts_of(data):
    return {chart["title"]: chart for group in data["groups"] for chart in group["charts"]}


def largest(series):
    return max(abs(value) for value in series["y"])


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.page, cls.data, cls.summary = make(cls.folder.name, *PAIR)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_page_needs_nothing_else(self):
        head = self.page.split('<script type="application/json"')[0]
        self.assertEqual(re.findall(r'(?:src|href)\s*=\s*"(?!#)[^"]*"|url\(|@import|https?://', head), [])
        script = self.page.rsplit("<script>", 1)[1]
        self.assertEqual(re.findall(r"https?://|import\s|fetch\(|XMLHttpRequest", script), [])
        self.assertIn("default-src 'none'", self.page)
        self.assertLess(len(self.page), 5e6)
        self.assertNotRegex(self.page, r"\{\{\w+\}\}")

    def test_peaks_of_the_histories_are_those_of_the_summary(self):
        charts = charts_of(self.data)
        displacement = charts["Displacement along x, relative to the base"]
        roofs = {s["name"]: s for s in displacement["series"]}
        peaks = {peak["node"]: peak for peak in self.summary["peaks"]}
        for name, node in (("left, z = 5 m", "left.25"), ("right, z = 5 m", "right.25")):
            self.assertAlmostEqual(largest(roofs[name]) / peaks[node]["displacement"][0], 1, delta=1e-5, msg=name)
        accelerations = {s["name"]: s for s in charts["Absolute acceleration along x"]["series"]}
        self.assertAlmostEqual(largest(accelerations["left, z = 5 m"]) / peaks["left.25"]["acceleration"][0], 1, delta=1e-5)
        twists = {s["name"]: s for s in charts["Twist: rotation about z"]["series"]}
        self.assertAlmostEqual(largest(twists["right, z = 5 m"]) / peaks["right.25"]["twist"], 1, delta=1e-5)
        drifts = sorted(largest(s) for s in charts["Story drift along x"]["series"])
        for drawn, known in zip(drifts, sorted(d["drift"][0] for d in self.summary["drifts"])):
            self.assertAlmostEqual(drawn / known, 1, delta=1e-5)

    def test_every_number_is_one_and_times_ascend(self):
        for title, chart in charts_of(self.data).items():
            self.assertTrue(chart["series"], title)
            for series in chart["series"]:
                self.assertEqual(len(series["x"]), len(series["y"]), title)
                self.assertTrue(all(isinstance(v, (int, float)) for v in series["x"] + series["y"]), title)
                self.assertEqual(series["x"], sorted(series["x"]), title)
            self.assertTrue(chart["unit"] and chart["x_label"], title)
        for expected in ("Gap", "Impulses of the poundings", "Energy and where it went", "Pseudo-acceleration along x",
                         "Acceleration of the base"):
            self.assertIn(expected, charts_of(self.data))

    def test_poundings_are_all_there(self):
        self.assertGreater(len(self.summary["poundings"]), 1)
        drawn, known = ([(p["t"], p["impulse"]) for p in data["poundings"]] for data in (self.data, self.summary))
        self.assertEqual(drawn, known)
        self.assertEqual(self.data["summary"]["impacts_total"], len(self.summary["impacts"]))
        self.assertEqual(self.data["notes"], [])

    def test_frames_hold_the_motion_to_their_resolution(self):
        view = self.data["view"]
        values = struct.unpack("<%dh" % (len(view["times"]) * 6 * len(view["recorded"])), base64.b64decode(view["frames"]))
        self.assertEqual(max(abs(v) for i, v in enumerate(values) if i % 6 < 3), 32000)
        self.assertEqual(view["times"], sorted(view["times"]))
        self.assertEqual(view["times"][-1], 6.0)
        peaks = {peak["node"]: peak["displacement"][0] for peak in self.summary["peaks"]}
        found = max(abs(v) for i, v in enumerate(values) if i % 6 == 0) * view["unit"][0]
        self.assertLessEqual(found, max(peaks.values()) + view["unit"][0])
        self.assertGreater(found, 0.95 * max(peaks.values()))
        self.assertEqual(len(view["members"]), self.summary["elements"] - 8)  # the springs at the feet
        for node in (node for member in view["members"] for node in member["nodes"]):
            self.assertLess(node, self.summary["nodes"])

    def test_gaps_are_widened_by_their_mean_and_a_wall_stands_where_the_scene_says(self):
        self.assertEqual(self.data["view"]["walls"], [])
        left, right = self.data["view"]["offsets"]  # gaps of 5 and 5.5 cm
        self.assertEqual(left, [0, 0, 0])
        self.assertAlmostEqual(right[0], 0.0525, places=9)
        with tempfile.TemporaryDirectory() as folder:
            _, data, summary = make(folder, "stick_slip", "analysis.duration=0.2")
            (wall,) = data["view"]["walls"]
            for corner in wall["corners"]:
                self.assertAlmostEqual(corner[0], 10.04, places=9)
            for found, known in zip(wall["across"], (0.03, 0, 0)):
                self.assertAlmostEqual(found, known, places=9)
            self.assertEqual(wall["structure"], 1)
            self.assertEqual(sorted({corner[2] for corner in wall["corners"]})[0], 0)
            self.assertTrue(min(c[1] for c in wall["corners"]) < 0 and max(c[1] for c in wall["corners"]) > 4)
            self.assertEqual(len(summary["warnings"]), len(set(summary["warnings"])))

    def test_title_cannot_break_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            title = "</script><script>alert(1)</script> & <b>"
            page, data, _ = make(folder, "bouncing_ball", "title=" + json.dumps(title), "analysis.duration=0.1")
            self.assertEqual(data["summary"]["title"], title)
            self.assertNotIn("<script>alert", page)

    def test_static_stages_alone_make_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            _, data, summary = make(folder, "pushover")
            self.assertTrue(summary["stages"])
            self.assertEqual([group["id"] for group in data["groups"]][0], "static")

    def test_what_a_run_did_not_keep_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            _, data, _ = make(folder, "pull_back", "output.history=[]", "output.floor_spectra=none", "analysis.duration=0.5")
            self.assertEqual(len(data["notes"]), 5)
            self.assertIn('history = ["nodes"]', data["notes"][0])
            self.assertIn("the motion is not in these results", data["view"]["note"])

    def test_wrong_folders_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for expected in ("there is no folder", "has no summary.json", "is not a summary of nsframe", "is not a summary of nsframe",
                             "has no results.h5"):
                if expected == "has no summary.json":
                    (folder / "run").mkdir()
                elif "not a summary" in expected:
                    text = '{"program": "other"}' if (folder / "run/summary.json").exists() else "{"
                    (folder / "run/summary.json").write_text(text)
                elif expected == "has no results.h5":
                    (folder / "run/summary.json").write_text('{"program": "nsframe"}')
                result = nsframe("report", folder / "run")
                self.assertEqual(result.returncode, 2, expected)
                self.assertIn(expected, result.stderr)
            (folder / "run/results.h5").write_bytes(b"\x89HDF nothing")
            result = nsframe("report", folder / "run")
            self.assertEqual(result.returncode, 4)
            self.assertIn("damaged", result.stderr)
            shutil.copy(pathlib.Path(self.folder.name) / "results.h5", folder / "run/results.h5")
            result = nsframe("report", folder / "run")
            self.assertEqual(result.returncode, 2)
            self.assertIn("not a summary of this nsframe", result.stderr)
            self.assertFalse((folder / "run/report.html").exists())
        self.assertEqual(nsframe("report").returncode, 2)

    def test_a_place_that_cannot_be_written_is_named(self):
        result = nsframe("report", self.folder.name, "-o", pathlib.Path(self.folder.name) / "none" / "page.html")
        self.assertEqual(result.returncode, 4)
        self.assertIn("cannot write", result.stderr)


@unittest.skipIf(BROWSER is None, "no chromium: the page is not looked at in a browser")
class BrowserTest(unittest.TestCase):
    def browse(self, page, *flags):
        with tempfile.TemporaryDirectory() as profile:
            command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + profile, "--enable-logging=stderr",
                       "--hide-scrollbars", "--virtual-time-budget=8000", *flags, "file://%s" % page]
            result = subprocess.run(command, capture_output=True, text=True, timeout=240)
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        self.assertEqual([line for line in result.stderr.splitlines() if "CONSOLE" in line], [])
        return result.stdout

    def test_everything_is_drawn_at_desktop_and_phone_width(self):
        with tempfile.TemporaryDirectory() as folder:
            make(folder, *PAIR)
            page = pathlib.Path(folder) / "report.html"
            dom = self.browse(page, "--dump-dom", "--window-size=1280,900")
            state = dict(re.findall(r'data-(\w+)="([^"]*)"', re.search(r"<body[^>]*>", dom).group(0)))
            self.assertEqual((state.get("ready"), state.get("errors"), state.get("view")), ("1", "", "true"), state)
            drawn, total = map(int, state["charts"].split("/"))
            self.assertEqual(drawn, total)
            self.assertGreater(total, 8)
            self.assertEqual(state.get("overflow"), "", "wider than the window")
            for width, height in ((1280, 900), (500, 900)):
                shot = pathlib.Path(folder) / "page.png"
                self.browse(page, "--screenshot=%s" % shot, "--window-size=%d,%d" % (width, height))
                found_width, _, channels, rows = pixels(shot)
                self.assertEqual(found_width, width)
                colours = {row[i:i + 3] for row in rows[::3] for i in range(0, len(row), 3 * channels)}
                self.assertGreater(len(colours), 40)  # of a blank page: 3
                self.assertIn(bytes.fromhex("0072b2"), {row[i:i + 3] for row in rows for i in range(0, len(row), channels)})
                if KEEP:
                    KEEP.mkdir(parents=True, exist_ok=True)
                    shutil.copy(shot, KEEP / ("report_%d.png" % width))

    def test_controls_do_what_they_say(self):
        """Clicks and drags on a copy of the page, by a script that leaves what came of it in the document."""
        actions = """<script>addEventListener("load", () => setTimeout(() => {
          const {view, charts: [chart]} = report, box = chart.canvas.getBoundingClientRect(), said = document.body.dataset;
          const at = (type, part, canvas = chart.canvas) => canvas.dispatchEvent(new PointerEvent(type,
            {pointerType: "mouse", pointerId: 1, clientX: box.left + part * box.width, clientY: box.top + 60, bubbles: true}));
          const start = view.time;
          let waits = 0;
          view.play.click();
          const wait = setInterval(() => {
            if (view.time === start && ++waits < 50) return;
            clearInterval(wait);
            said.played = view.time - start;
            view.play.click();
            document.querySelector("tr.jump").click();
            said.jumped = view.time;
            at("pointerdown", 0.3); at("pointermove", 0.6); at("pointerup", 0.6);
            said.zoomed = clock.window.join(" ");
            chart.canvas.dispatchEvent(new MouseEvent("dblclick"));
            said.whole = clock.window.join(" ");
            at("pointerdown", 0.5); at("pointerup", 0.5);
            said.pointed = clock.cursor - view.time;
            const before = view.canvas.toDataURL();
            document.querySelectorAll(".view button")[2].click();
            said.turned = before !== view.canvas.toDataURL();
            chart.host.querySelector(".legend button").click();
            said.hidden = chart.shown.filter(shown => !shown).length;
            said.failed = report.errors.join("; ");
          }, 100);
        }, 100));</script></body>"""
        with tempfile.TemporaryDirectory() as folder:
            page, _, summary = make(folder, *PAIR)
            copy = pathlib.Path(folder) / "copy.html"
            # a browser without a screen draws no frames by itself
            frames = "<script>window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16)</script></head>"
            copy.write_text(page.replace("</head>", frames, 1).replace("</body>", actions), encoding="utf-8")
            dom = self.browse(copy, "--dump-dom", "--window-size=1280,900")
            said = dict(re.findall(r'data-(\w+)="([^"]*)"', re.search(r"<body[^>]*>", dom).group(0)))
        self.assertGreater(float(said["played"]), 0)
        self.assertEqual(float(said["jumped"]), summary["poundings"][0]["t"])
        first, last = map(float, said["zoomed"].split())
        self.assertTrue(0.5 < first < 2 and 3 < last < 4.5, said["zoomed"])
        self.assertEqual(said["whole"], "0 6")
        self.assertEqual(float(said["pointed"]), 0)
        self.assertEqual((said["turned"], said["hidden"], said["failed"]), ("true", "1", ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
