#!/usr/bin/env python3
"""Plot the curve of a static stage: load against control displacement, yielded sections, and the shape at the end.

    plot_pushover.py RUN_FOLDER -o pushover.png [--stage push] [--nodes frame.15 frame.25] [--direction x]

Reads results.h5. With --nodes (output.history must name "nodes") the displacements of these nodes are drawn over their
heights at several points. Needs h5py and matplotlib.
"""
import argparse
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import static_stage  # noqa: E402

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]  # Okabe-Ito
COMPONENTS = {"x": 0, "y": 1, "z": 2}


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with results.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("pushover.png"))
    parser.add_argument("--stage", help="default: the first one")
    parser.add_argument("--nodes", nargs="+", help="from below to above: their displacements at five points")
    parser.add_argument("--direction", choices=COMPONENTS, default="x")
    parser.add_argument("--title", help="default: the name of the stage")
    return parser.parse_args()


def read(path, name):
    with h5py.File(path, "r") as file:
        name, stage = static_stage.find(file, name)
        run = {"name": name, "at": stage.attrs["at"], "factor": stage["load_factor"][:],
               "displacement": stage["control_displacement"][:], "yielded": None, "ids": []}
        sections = stage.get("sections")
        fibers = [kind for kind in (sections or {}).values() if kind["peak_strain_ratio"][:].any()]  # elastic ones have none
        if fibers:
            run["yielded"] = sum((kind["yielded"][:] > 0).sum(axis=1) for kind in fibers)
            run["sections"] = sum(kind["yielded"].shape[1] for kind in fibers)
        if "nodes" in stage:
            run["ids"] = [node.decode() for node in stage["nodes/id"][:]]
            run["nodes"] = stage["nodes/displacement"][:]
        return run


def draw_shapes(axes, run, names, component):
    unknown = [name for name in names if name not in run["ids"]]
    if unknown:
        sys.exit(f"no displacements of {', '.join(unknown)}; output.history must have \"nodes\"")
    columns = [run["ids"].index(name) for name in names]
    for color, point in zip(COLORS, np.linspace(0, len(run["factor"]) - 1, 6).astype(int)[1:]):
        shape = 1e3 * run["nodes"][point, columns, component]
        axes.plot(np.concatenate(([0], shape)), range(len(names) + 1), "o-", color=color, ms=4, lw=1.3,
                  label=f"{1e3 * run['displacement'][point]:.0f} mm")
    axes.set_yticks(range(len(names) + 1), ["base", *names])
    axes.set_xlabel("displacement (mm)")
    axes.legend(frameon=False, fontsize=8, title=run["at"], title_fontsize=8)
    axes.grid(alpha=0.25)


def main():
    arguments = parse()
    run = read(arguments.run / "results.h5", arguments.stage)
    figure, panels = plt.subplots(1, 2 if arguments.nodes else 1, figsize=(10 if arguments.nodes else 6.5, 4.4),
                                  layout="constrained", squeeze=False, width_ratios=(3, 2) if arguments.nodes else None)
    axes = panels[0, 0]
    axes.plot(1e3 * run["displacement"], run["factor"], color=COLORS[0], lw=1.6)
    axes.set_xlabel(f"{run['at']} (mm)")
    axes.set_ylabel("load factor")
    axes.grid(alpha=0.25)
    axes.set_title(arguments.title or f"stage {run['name']}", loc="left", fontsize=10.5)
    if run["yielded"] is not None:
        right = axes.twinx()
        right.plot(1e3 * run["displacement"], run["yielded"], color=COLORS[1], lw=1.2, ls=(0, (4, 2)))
        right.set_ylabel(f"sections that have yielded, of {run['sections']}", color=COLORS[1])
        right.set_ylim(0, run["sections"])
    if arguments.nodes:
        draw_shapes(panels[0, 1], run, arguments.nodes, COMPONENTS[arguments.direction])
    figure.savefig(arguments.output, dpi=110)
    print(arguments.output)


if __name__ == "__main__":
    main()
