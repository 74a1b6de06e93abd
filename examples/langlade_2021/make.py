#!/usr/bin/env python3
"""Makes docs/langlade_2021.md: every figure and table of the paper, run by nsframe, beside the paper's numbers.

    python3 examples/langlade_2021/make.py                        # rows of Cadarache's stand-in and of El Centro
    python3 examples/langlade_2021/make.py --northridge NORTHRIDGE.AT2 --kobe KOBE.AT2
    python3 examples/langlade_2021/make.py --page-only            # the page and its figures, from what was measured before

What is measured goes to results.json (numbers, with the record of every row) and curves.json (histories and spectra of the
figures) beside this file; page and figures are made from these two alone. Rows of Northridge and Kobe are measured anew when
their record is given, and else stay as they were; with neither a record nor earlier results they say so. Further files
after the first, and those of --el-centro, only tell how the count moves with the record. Two processes run at a time.

Needs Python 3.11 with numpy, h5py and matplotlib, and the built program.
"""
import argparse
import json
import pathlib
import sys
import tempfile
import time

import page
from program import FOLDER, Failed, Program

ROOT = FOLDER.parents[1]
RESULTS, CURVES = FOLDER / "results.json", FOLDER / "curves.json"
PARTS = ("ball", "pull-back", "floor-spectra", "tables")
PAGE, IMAGES = ROOT / "docs" / "langlade_2021.md", ROOT / "docs" / "images" / "langlade_2021"


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "nsframe", help="default: build/nsframe")
    for motion in ("northridge", "kobe", "el-centro"):
        parser.add_argument(f"--{motion}", type=pathlib.Path, nargs="+", default=[], metavar="FILE",
                            help="record file" + ("s beside the shipped one" if motion == "el-centro" else ", further ones for comparison"))
    parser.add_argument("--processes", type=int, default=2, help="default: 2")
    parser.add_argument("--only", choices=PARTS, nargs="+", default=PARTS, help="parts to measure; the others stay as they were")
    parser.add_argument("--page-only", action="store_true", help="make page and figures from results.json and curves.json")
    return parser.parse_args()


def written(value, level=0):
    """JSON with a line for every entry of a table and lists on one line."""
    if isinstance(value, dict) and value:
        pad = " " * (level + 1)
        entries = [f"{pad}{json.dumps(key, ensure_ascii=False)}: {written(entry, level + 1)}" for key, entry in value.items()]
        return "{\n" + ",\n".join(entries) + "\n" + " " * level + "}"
    return json.dumps(value, ensure_ascii=False)


def read(file, empty):
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else empty


def measure(options, results, curves):
    import earthquakes
    import floor_spectra
    import motions
    import studies

    program = Program(options.program.resolve(), options.processes)
    begin = time.monotonic()

    def told(what):
        print(f"{time.monotonic() - begin:6.1f} s  {program.runs:4d} runs  {what}", flush=True)

    results["program"] = program.version()
    with tempfile.TemporaryDirectory(prefix="langlade_2021_") as folder:
        given = {"northridge": options.northridge, "kobe": options.kobe, "el_centro": options.el_centro}
        records = motions.gather(program, folder, given)
        shipped = records["el_centro"][0]
        if "ball" in options.only:
            results["ball"], curves["ball"] = studies.ball(program)
            told("bouncing ball")
        if "pull-back" in options.only:
            results["pull_back"], curves["pull_back"] = studies.pull_back(program)
            results["penalty"], curves["penalty"] = studies.pull_back_penalty(program)
            results["identification"] = studies.identification(program)
            told("pull-back")
        if "floor-spectra" in options.only:
            effects, curves["floor_spectra"] = floor_spectra.of_schemes(program, shipped)
            results["floor_spectra"], curves["floor_spectra"]["steps"] = floor_spectra.of_steps(program, shipped)
            results["floor_spectra"]["effects"] = effects
            told("floor spectra")
        if "tables" in options.only:
            earthquakes.measure(program, records, results, curves)
            told("tables 5, 7 and 8")
    RESULTS.write_text(written(results) + "\n", encoding="utf-8")
    CURVES.write_text(written(curves) + "\n", encoding="utf-8")


def main():
    options = parse()
    results = read(RESULTS, {"table_5": {"rows": {}}, "table_8": {"rows": {}}})
    curves = read(CURVES, {"rows": {}})
    if not options.page_only:
        missing = [str(file) for file in [options.program, *options.northridge, *options.kobe, *options.el_centro] if not file.is_file()]
        if missing:
            print(f"make.py: no such file: {', '.join(missing)}", file=sys.stderr)
            return 2
        try:
            measure(options, results, curves)
        except Failed as problem:
            print(f"make.py: {problem}", file=sys.stderr)
            return 1
    elif not RESULTS.exists():
        print(f"make.py: --page-only needs {RESULTS}", file=sys.stderr)
        return 2

    import figures

    IMAGES.mkdir(parents=True, exist_ok=True)
    figures.draw(results, curves, IMAGES)
    PAGE.write_text(page.text(results), encoding="utf-8")
    print(f"{PAGE.relative_to(ROOT)}, {len(list(IMAGES.iterdir()))} figures in {IMAGES.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
