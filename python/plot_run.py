#!/usr/bin/env python3
"""Plot displacement histories of an nsframe run, with its impacts marked.

    plot_run.py RUN_FOLDER -o run.png [--nodes left.21 right.21] [--direction x]

Reads results.h5 (output.history must name "nodes") and summary.json. Needs h5py and matplotlib.
"""
import argparse
import json
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]  # Okabe-Ito
COMPONENTS = {"x": 0, "y": 1, "z": 2, "rx": 3, "ry": 4, "rz": 5}


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with results.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("run.png"))
    parser.add_argument("--nodes", nargs="+", help="default: the node of each structure that moves most")
    parser.add_argument("--direction", choices=COMPONENTS, default="x")
    parser.add_argument("--from", dest="start", type=float, help="[s]")
    parser.add_argument("--to", dest="end", type=float, help="[s]")
    return parser.parse_args()


def default_nodes(ids, values):
    """Of each structure the node with the largest value."""
    best = {}
    for i, name in enumerate(ids):
        structure = name.rsplit(".", 1)[0]
        peak = np.abs(values[:, i]).max()
        if peak > best.get(structure, (0.0, ""))[0]:
            best[structure] = (peak, name)
    return [name for _, name in best.values()]


def read(arguments):
    component = COMPONENTS[arguments.direction]
    with h5py.File(arguments.run / "results.h5", "r") as file:
        if "nodes" not in file:
            sys.exit('results.h5 has no node histories: add history = ["nodes"] to [output] of the scene')
        time = file["time"][:]
        ids = [name.decode() for name in file["nodes/id"][:]]
        values = file["nodes/displacement"][:, :, component]
        impulse = file["contacts/impulse"][:] if "contacts/impulse" in file else None
        impacts = np.column_stack([file["impacts/time"][:], file["impacts/impulse"][:]])
    unknown = [name for name in arguments.nodes or [] if name not in ids]
    if unknown:
        sys.exit(f"no history of {', '.join(unknown)}; there are {', '.join(ids)}")
    return time, ids, values, impulse, impacts


def main():
    arguments = parse()
    time, ids, values, _, impacts = read(arguments)
    summary_file = arguments.run / "summary.json"
    summary = json.loads(summary_file.read_text()) if summary_file.exists() else {}
    rotation = arguments.direction.startswith("r")
    factor, unit = (1e3, "mrad") if rotation else (1e3, "mm")

    figure, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(11, 6), height_ratios=(3, 1),
                                         layout="constrained")
    for color, name in zip(COLORS * 9, arguments.nodes or default_nodes(ids, values)):
        top.plot(time, factor * values[:, ids.index(name)], color=color, lw=1.3, label=name)
    for number, moment in enumerate(np.unique(impacts[:, 0])):
        top.axvline(moment, color="#999999", lw=0.6, zorder=0, label="impact" if number == 0 else None)
    quantity = "rotation" if rotation else "displacement"
    top.set_ylabel(f"{quantity} {arguments.direction} relative to the base ({unit})")
    top.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=4, frameon=False)
    top.grid(alpha=0.25)
    top.set_title(f"{summary.get('title') or arguments.run.name}"
                  f"   ({summary.get('scheme', '')}, dt = {1e3 * summary.get('dt', 0):g} ms, {len(impacts)} impacts)",
                  loc="left", fontsize=11)
    if len(impacts):
        bottom.stem(impacts[:, 0], impacts[:, 1], linefmt=COLORS[1], markerfmt="o", basefmt=" ")
        bottom.set_ylim(bottom=0)
    else:
        bottom.text(0.5, 0.5, "no impacts", transform=bottom.transAxes, ha="center", va="center")
    bottom.set_ylabel("impulse (N s)")
    bottom.set_xlabel("time (s)")
    bottom.grid(alpha=0.25)
    bottom.set_xlim(arguments.start if arguments.start is not None else time[0],
                    arguments.end if arguments.end is not None else time[-1])
    figure.savefig(arguments.output, dpi=130)
    print(arguments.output)


if __name__ == "__main__":
    main()
