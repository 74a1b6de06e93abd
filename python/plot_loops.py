#!/usr/bin/env python3
"""Plot force over control displacement of every spring, link and truss of a static stage, a chart each.

    plot_loops.py RUN_FOLDER -o loops.png [--stage cycles] [--columns 5]

Reads results.h5, for which output.history must name "elements". Needs h5py and matplotlib.
"""
import argparse
import pathlib
import sys

import h5py

import static_stage

FORCE = {"spring": 0, "link": 6, "truss": 6}  # which of the twelve forces on the ends is tension, by kind
COLOR = "#0072b2"


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with results.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("loops.png"))
    parser.add_argument("--stage", help="default: the first one")
    parser.add_argument("--columns", type=int, default=5, help="charts in a row (default: 5)")
    return parser.parse_args()


def read(path, name):
    """The stage's control displacements [m], and forces [N] by the element's name."""
    with h5py.File(path, "r") as file:
        _, stage = static_stage.find(file, name)
        forces = {}
        for kind, group in stage.get("elements", {}).items():
            if kind in FORCE:
                for k, element in enumerate(group["id"][:]):
                    forces[element.decode().split(".", 1)[1]] = group["forces"][:, k, FORCE[kind]]
        if not forces:
            sys.exit("no forces of springs, links or trusses; output.history must have \"elements\"")
        return stage["control_displacement"][:], forces


def main():
    a = parse()
    displacement, forces = read(a.run / "results.h5", a.stage)

    def draw(chart, force):
        chart.axhline(0, color="0.8", linewidth=0.6)
        chart.axvline(0, color="0.8", linewidth=0.6)
        chart.plot(1e3 * displacement, 1e-3 * force, color=COLOR, linewidth=0.7)

    static_stage.draw_grid(a.output, forces, a.columns, (2.2, 1.9), ("displacement, mm", "force, kN"), draw, sharex=True)


if __name__ == "__main__":
    main()
