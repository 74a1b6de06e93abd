#!/usr/bin/env python3
"""The ParaView script of a run, run by ParaView's own Python: no error, structures in colour, the impact marked.

    paraview_test.py PROGRAM SOURCE [--keep FOLDER]      (for the pictures)

Ends with 77, which CTest counts as skipped, where pvbatch and a screen (DISPLAY, or Xvfb) are missing: Debian's paraview,
python3-paraview and xvfb.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from png_pixels import pixels
from program import run

KEEP = pathlib.Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
SKIPPED, ATTEMPTS = 77, 3
DRIVER = """import runpy, sys
from paraview.simple import *
script, picture, time = sys.argv[1:]
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [900, 600]
made = runpy.run_path(script)
if time != "first":
    GetAnimationScene().AnimationTime = float(time)
Render()
SaveScreenshot(picture, view, ImageResolution=[900, 600])
"""


def screen():
    """Environment with a display, and the server to stop afterwards; None where there is none."""
    if os.environ.get("DISPLAY"):
        return dict(os.environ), None
    server = shutil.which("Xvfb")
    if not server:
        return None, None
    reader, writer = os.pipe()
    process = subprocess.Popen([server, "-displayfd", str(writer), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset"],
                               pass_fds=[writer], stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as said:
        number = said.readline().strip()
    time.sleep(1)
    return (dict(os.environ, DISPLAY=":" + number), process) if number else (None, process)


def require(condition, what):
    if not condition:
        sys.exit("failed: %s" % what)


def near(colour, wanted):
    return all(abs(a - b) < 60 for a, b in zip(colour, wanted))


def colours(path):
    width, height, channels, rows = pixels(path)
    require((width, height) == (900, 600), "the size of the picture")
    return [row[i:i + 3] for row in rows for i in range(0, len(row), channels)]


def show(environment, folder, when):
    """Runs the script, once more where the X server was not ready. Returns the pixels."""
    driver, picture = folder / "driver.py", folder / "picture.png"
    driver.write_text(DRIVER)
    for _ in range(ATTEMPTS):
        picture.unlink(missing_ok=True)
        shown = subprocess.run(["pvbatch", str(driver), str(folder / "open_in_paraview.py"), str(picture), when], env=environment,
                               capture_output=True, text=True, timeout=200)
        if "CreateAWindow" not in shown.stderr:
            break
    require(shown.returncode == 0 and "Traceback" not in shown.stderr and picture.exists(), shown.stderr[-3000:])
    if KEEP:
        KEEP.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, KEEP / ("paraview_%s.png" % when))
    return colours(picture)


def main():
    environment, server = screen() if shutil.which("pvbatch") else (None, None)
    if environment is None:
        print("skipped: no pvbatch with a screen; Debian's paraview, python3-paraview and xvfb have them")
        return SKIPPED
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            summary = run(folder, "two_story_elastic", "analysis.duration=3", "output.frames=50 Hz")
            at = summary["poundings"][0]["t"]
            hit = show(environment, folder, "%.3f" % (0.02 * -(-at // 0.02)))
            before = show(environment, folder, "%.3f" % (0.02 * (at // 0.02)))
            still = show(environment, folder, "0")
    finally:
        if server:
            server.terminate()
    def marked(picture):  # pixels of vermilion; the x of the small axes is nearly so
        return sum(near(c, (214, 94, 0)) and c[0] > 1.7 * c[1] for c in picture)

    require(marked(hit) > marked(still) + 60, "the impact is marked")
    require(marked(before) == marked(still), "no mark before the impact")
    purple, moved = (68, 1, 84), lambda c: c[1] > c[0] + 15  # the ends of viridis: rest is purple, what moves blue to yellow
    require(sum(near(c, purple) for c in still) > 5000, "structures at rest are purple")
    require(sum(map(moved, hit)) > 2 * sum(map(moved, still)) + 1000, "displacement is in colour")
    require(sum(c == b"\xff\xff\xff" for c in hit) > 200000, "a white background")
    return 0


if __name__ == "__main__":
    sys.exit(main())
