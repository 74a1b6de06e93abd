#!/usr/bin/env python3
"""Draw the fibers of sections with their stresses: an integration point of every member at the end of a static stage.

    plot_fibers.py RUN_FOLDER -o fibers.png [--stage push] [--point 1] [--columns 4]

Each fiber is a disc of its area, coloured by its stress over the largest of its material in the section. Reads results.h5, for which
output.history must name "fibers". Needs h5py and matplotlib.
"""
import argparse
import pathlib
import sys

import h5py
import numpy as np
from matplotlib.collections import EllipseCollection

import static_stage


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with results.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("fibers.png"))
    parser.add_argument("--stage", help="default: the last one")
    parser.add_argument("--point", type=int, default=1, help="integration point, from 1 (default: 1)")
    parser.add_argument("--columns", type=int, default=4, help="charts in a row (default: 4)")
    return parser.parse_args()


def read(path, name, point):
    """By the element's name: y, z [m], area [m2], material and stress [Pa] of the fibers."""
    with h5py.File(path, "r") as file:
        _, stage = static_stage.find(file, name, -1)
        sections = {}
        for group in stage.get("fibers", {}).values():
            shown = (group["point"][:] == point) & (group["area"][:] > 0)  # not the concrete that bars displace
            elements = np.array([element.decode() for element in group["element"][:]])
            for element in dict.fromkeys(elements):
                chosen = shown & (elements == element)
                sections[element.split(".", 1)[1]] = {key: group[key][:][chosen] for key in ("y", "z", "area", "material")}
                sections[element.split(".", 1)[1]]["stress"] = group["stress"][-1][chosen]
        if not sections:
            sys.exit("no fibers; output.history must have \"fibers\"")
        return sections


def relative(section):
    """Stress over the largest of the material."""
    ratio = np.zeros(len(section["stress"]))
    for material in set(section["material"]):
        of = section["material"] == material
        ratio[of] = section["stress"][of] / max(1e-12, np.abs(section["stress"][of]).max())
    return ratio


def draw(chart, section):
    y, z = 1e3 * section["y"], 1e3 * section["z"]
    order = np.argsort(-section["area"])  # bars over the concrete around them
    size = 1e3 * np.sqrt(4 * section["area"][order] / np.pi)
    chart.add_collection(EllipseCollection(size, size, np.zeros(len(size)), units="x", offsets=np.column_stack((z, y))[order],
                                           offset_transform=chart.transData, array=relative(section)[order], cmap="coolwarm", clim=(-1, 1)))
    half = 1.1 * max(np.ptp(y), np.ptp(z)) / 2 + 15
    chart.set_xlim((z.min() + z.max()) / 2 - half, (z.min() + z.max()) / 2 + half)
    chart.set_ylim((y.min() + y.max()) / 2 - half, (y.min() + y.max()) / 2 + half)
    chart.set_aspect("equal")


def main():
    a = parse()
    sections = read(a.run / "results.h5", a.stage, a.point)
    static_stage.draw_grid(a.output, sections, a.columns, (2.6, 2.6), ("local z, mm", "local y, mm"), draw)


if __name__ == "__main__":
    main()
