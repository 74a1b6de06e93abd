"""Writes the tables of README.md anew from bench/results/*.json and work_precision.md, row by row as they stand here.

    python3 bench/readme_tables.py            (with --check: says whether they are as written, changes nothing)

Standard library only.
"""
import argparse
import json
import os
import sys

from harness import BENCH, ROOT
from pair import DAMPED

PAPER, HALF = "theta = 1, gamma = 1.5", "theta = 0.5, gamma = 0.5"
SOFT, STIFF = "penalty 1e+08 N/m", "penalty 1e+09 N/m"
LABELS = {"exact": "`exact`, kept each step", "exponential": "`exponential`", "exponential, accuracy 1e-3": "`exponential`, accuracy 1e-3",
          "exponential, accuracy 5e-4": "`exponential`, accuracy 5e-4", "exponential, accuracy 1e-4": "`exponential`, accuracy 1e-4", PAPER: "`moreau-jean`, θ = 1, γ = 3/2", HALF: "`moreau-jean`, θ = γ = ½",
          SOFT: "OpenSees, penalty 1e8 N/m", STIFF: "OpenSees, penalty 1e9 N/m"}
FIBER_ROWS = [("exponential", 5e-3), ("exponential", 1e-3), ("exponential, accuracy 1e-3", 5e-3), ("exponential", 1e-4), (PAPER, 1e-3),
              (HALF, 1e-3), (HALF, 1e-4), (SOFT, 1e-3)]
TWO_STORY = [  # case, title, setting and step [s] of every row
    ("elastic", "elastic", [("exact", 5e-3), ("exact", 1e-3), (PAPER, 1e-3), (HALF, 1e-3), (HALF, 1e-5), (SOFT, 1e-3), (STIFF, 1e-4)]),
    ("displacement-based", "Steel02 fibers, displacement-based", FIBER_ROWS),
    ("force-based", "Steel02 fibers, force-based", FIBER_ROWS),
    (DAMPED, "displacement-based, all modes damped by 2 %", [("exponential", 5e-3), ("exponential", 2e-3), ("exponential", 1e-3),
                                                             ("exponential, accuracy 5e-4", 5e-3), ("exponential, accuracy 5e-4", 1e-3),
                                                             ("exponential, accuracy 1e-4", 5e-3), (HALF, 1e-3), (HALF, 1e-4)]),
]


def loaded(name):
    with open(os.path.join(BENCH, "results", name + ".json")) as file:
        return json.load(file)


def rows_of(cases, case):
    return cases[case] if isinstance(cases[case], list) else cases[case]["rows"]


def number(value):
    return "%d" % round(value) if value >= 9.95 else "%.1f" % value


def error_mm(metres):
    value = 1e3 * metres
    return "%.0e" % value if value < 1e-6 else "%.2g" % value if value < 1 else "%.1f" % value


def line(cells):
    return ("| " + " | ".join(cells) + " |").replace("|  |", "| |")


def two_story_rows():
    cases = loaded("two_story")["cases"]
    lines = []
    for case, title, wanted in TWO_STORY:
        found = {(row["setting"], row["dt"]): row for row in rows_of(cases, case)}
        peer = found.get((SOFT, 1e-3))
        for setting, dt in wanted:
            row = found[setting, dt]
            ratio = number(peer["step_us"] / row["step_us"]) if peer and row["program"] == "nsframe" else ""
            lines.append(line([title, LABELS[setting], "%g" % (1e3 * dt), number(row["step_us"]), number(1e-3 * row["step_us"] / dt), ratio,
                               error_mm(row["error_m"])]))
            title = ""
    return lines


def scaling_rows():
    cases = loaded("scaling")["cases"]

    def by_size(case, program):
        return {row["stories"]: row for row in rows_of(cases, case) if row["program"] == program}
    elastic, fibers = (by_size(case, "nsframe") for case in ("elastic", "displacement-based"))
    elastic_two, fibers_two = (by_size(case, "nsframe, two threads") for case in ("elastic", "displacement-based"))
    elastic_peer, fibers_peer = (by_size(case, "OpenSees") for case in ("elastic", "displacement-based"))
    lines = []
    for stories in elastic:
        a, b = elastic[stories], fibers[stories]
        lines.append(line(["%d" % stories, "%d" % a["dofs"], number(a["step_us"]), number(elastic_two[stories]["step_us"]), number(elastic_peer[stories]["step_us"] / a["step_us"]),
                           number(b["step_us"]), number(fibers_two[stories]["step_us"]), number(fibers_peer[stories]["step_us"] / b["step_us"]), number(b["memory_mb"])]))
    return lines


def precision_rows():
    with open(os.path.join(BENCH, "results", "work_precision.md")) as file:
        lines = file.read().splitlines()
    first = next(i for i, text in enumerate(lines) if text.startswith("| case"))
    rows = []
    for text in lines[first + 2:]:
        if not text.startswith("|"):
            return rows
        rows.append(line([cell.strip() for cell in text.strip("|").split("|")]))
    return rows


TABLES = {  # the head of a table in README.md, and its rows
    "| columns | program |": two_story_rows,
    "| stories | DOFs |": scaling_rows,
    "| case | peer |": precision_rows,
}


def with_tables(text):
    lines = text.splitlines()
    for head, rows in TABLES.items():
        first = next(i for i, one in enumerate(lines) if one.startswith(head)) + 2
        last = first
        while lines[last].startswith("|"):
            last += 1
        lines[first:last] = rows()
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="exit code 1 when README.md is not as bench/results says")
    options = parser.parse_args()
    readme = os.path.join(ROOT, "README.md")
    with open(readme) as file:
        before = file.read()
    after = with_tables(before)
    if options.check:
        if before != after:
            sys.exit("README.md: its tables are not those of bench/results; write them with python3 bench/readme_tables.py")
        return
    with open(readme, "w") as file:
        file.write(after)


if __name__ == "__main__":
    main()
