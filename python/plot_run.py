#!/usr/bin/env python3
"""Plot displacement histories of an nsframe run, with its impacts marked.

    plot_run.py RUN_FOLDER -o run.png [--nodes left.21 right.21] [--direction x] [--compare RUN_FOLDER]

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
    parser.add_argument("--direction", choices=COMPONENTS, help="default: the one with the largest displacements")
    parser.add_argument("--compare", type=pathlib.Path, help="folder of a second run, drawn with dashes")
    parser.add_argument("--labels", nargs=2, help="names of the two runs, e.g. 'theta = 1' 'theta = 0.5'")
    parser.add_argument("--from", dest="start", type=float, help="[s]")
    parser.add_argument("--to", dest="end", type=float, help="[s]")
    parser.add_argument("--title", help="default: the run's title, scheme and step")
    return parser.parse_args()


def read(folder):
    """Time, ids and displacements of the kept nodes, and the summary."""
    with h5py.File(folder / "results.h5", "r") as file:
        if "nodes" not in file:
            sys.exit('results.h5 has no node histories: add history = ["nodes"] to [output] of the scene')
        ids = [name.decode() for name in file["nodes/id"][:]]
        run = {"time": file["time"][:], "ids": ids, "values": file["nodes/displacement"][:]}
    summary_file = folder / "summary.json"
    run["summary"] = json.loads(summary_file.read_text()) if summary_file.exists() else {}
    return run


def default_nodes(ids, values):
    """Of each structure the node with the largest value."""
    best = {}
    for i, name in enumerate(ids):
        structure = name.rsplit(".", 1)[0]
        peak = np.abs(values[:, i]).max()
        if peak > best.get(structure, (0.0, ""))[0]:
            best[structure] = (peak, name)
    return [name for _, name in best.values()]


def check_nodes(names, run):
    unknown = [name for name in names if name not in run["ids"]]
    if unknown:
        sys.exit(f"no history of {', '.join(unknown)}; there are {', '.join(run['ids'])}")


def unit_of(direction, largest):
    if direction.startswith("r"):
        return 1e3, "mrad"
    return (1.0, "m") if largest > 0.5 else (1e3, "mm")


def draw_displacements(axes, runs, labels, names, direction):
    component = COMPONENTS[direction]
    largest = max(np.abs(run["values"][:, :, component]).max() for run in runs)
    factor, unit = unit_of(direction, largest)
    for run, label, style in zip(runs, labels, ("-", (0, (4, 2)))):
        for color, name in zip(COLORS * 9, names):
            axes.plot(run["time"], factor * run["values"][:, run["ids"].index(name), component], color=color,
                      ls=style, lw=1.3, label=f"{name}, {label}" if label else name)
    for number, pounding in enumerate(runs[0]["summary"].get("poundings", [])):
        axes.axvspan(pounding["t"], pounding["t"] + pounding["duration"], color="#888888", lw=0.8, alpha=0.45, zorder=0,
                     label="pounding" + (f", {labels[0]}" if labels[0] else "") if number == 0 else None)
    quantity = "rotation" if direction.startswith("r") else "displacement"
    axes.set_ylabel(f"{quantity} {direction} ({unit})")
    axes.legend(loc="lower left", bbox_to_anchor=(-0.005, 0.995), ncols=6, frameon=False, fontsize=9,
                columnspacing=1.4, handlelength=1.8)
    axes.grid(alpha=0.25)


def draw_impulses(axes, runs, labels):
    """One stem a pounding; a color a pair, open markers for the second run."""
    pairs = list(dict.fromkeys(p["pair"] for run in runs for p in run["summary"].get("poundings", [])))
    for run, label, filled in zip(runs, labels, (True, False)):
        for color, pair in zip(COLORS[2:] + COLORS[:2], pairs):
            poundings = [p for p in run["summary"].get("poundings", []) if p["pair"] == pair]
            if not poundings:
                continue
            time, impulse = [p["t"] for p in poundings], [p["impulse"] for p in poundings]
            axes.vlines(time, 0, impulse, color=color, lw=1.3, ls="-" if filled else ":")
            axes.plot(time, impulse, "o", ms=5, color=color, mfc=color if filled else "white",
                      label=", ".join(part for part in (pair.replace("|", " to "), label) if part))
    if pairs:
        axes.set_ylim(0, 1.5 * axes.dataLim.y1)  # room for the legend
        axes.legend(loc="upper right", fontsize=8, ncols=4, frameon=False)
    else:
        axes.text(0.5, 0.5, "no impacts", transform=axes.transAxes, ha="center", va="center")
    axes.set_ylabel("impulse (N s)")
    axes.set_xlabel("time (s)")
    axes.grid(alpha=0.25)


def title_of(run, folder):
    summary = run["summary"]
    count, impacts = len(summary.get("poundings", [])), len(summary.get("impacts", []))
    numbers = f"{count} pounding{'' if count == 1 else 's'}"
    if impacts != count:
        numbers += f" of {impacts} impacts"
    method = summary.get("integrator", "")
    if method in ("", "theta"):
        method = f"theta = {summary.get('theta', 0):g}"
    return (f"{summary.get('title') or folder.name}\n{summary.get('scheme', '')}, {method}, "
            f"dt = {1e3 * summary.get('dt', 0):g} ms: {numbers}")


def main():
    arguments = parse()
    runs = [read(folder) for folder in (arguments.run, arguments.compare) if folder]
    labels = arguments.labels or ([folder.name for folder in (arguments.run, arguments.compare)] if len(runs) > 1 else [""])
    sizes = [np.abs(runs[0]["values"][:, :, component]).max() for component in range(3)]
    direction = arguments.direction or "xyz"[int(np.argmax(sizes))]
    names = arguments.nodes or default_nodes(runs[0]["ids"], runs[0]["values"][:, :, COMPONENTS[direction]])
    for run in runs:
        check_nodes(names, run)

    figure, (top, bottom) = plt.subplots(2, 1, sharex=True, figsize=(10, 5.6), height_ratios=(3, 1.2),
                                         layout="constrained")
    draw_displacements(top, runs, labels, names, direction)
    draw_impulses(bottom, runs, labels)
    time = runs[0]["time"]
    bottom.set_xlim(arguments.start if arguments.start is not None else time[0],
                    arguments.end if arguments.end is not None else time[-1])
    top.set_title(arguments.title or title_of(runs[0], arguments.run), loc="left", fontsize=10.5, pad=24)
    figure.savefig(arguments.output, dpi=110)
    print(arguments.output)


if __name__ == "__main__":
    main()
