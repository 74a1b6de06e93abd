#!/usr/bin/env python3
"""Plot what `nsframe section -o FOLDER` wrote: moment-curvature and, where it is there, interaction.

    plot_section.py FOLDER [-o section.png] [--compare FOLDER2]

Reads section.json. Needs matplotlib.
"""
import argparse
import json
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]  # Okabe-Ito


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="folder with section.json")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="default: section.png in the folder")
    parser.add_argument("--compare", type=pathlib.Path, help="folder of a second analysis, drawn with dashes")
    return parser.parse_args()


def read(folder):
    return json.loads((folder / "section.json").read_text())


def draw_curve(axes, data, style, label):
    curve = data["moment_curvature"]
    axes.plot([row["curvature"] for row in curve["rows"]], [row["moment"] / 1e3 for row in curve["rows"]], color=COLORS[0],
              ls=style, lw=1.5, label=label)
    if style != "-":
        return
    points = [(f"first yield of {name}", point, "o") for name, point in curve["first_yield"].items()]
    points.append(("largest moment", curve["peak"], "^"))
    if curve.get("ultimate", {}).get("fallen"):
        points.append(("0.8 of the largest", curve["ultimate"], "s"))
    for color, (name, point, marker) in zip(COLORS[1:], points):
        axes.plot(point["curvature"], point["moment"] / 1e3, marker, color=color, ms=7, ls="none", label=name)


def draw_interaction(axes, data, style):
    curves = data["interaction"]
    if len(curves) == 2:  # an angle and its opposite: one closed curve
        first, second = ([(sign * p["moment"] / 1e3, p["axial_force"] / 1e3) for p in curve["points"]]
                         for sign, curve in zip((1, -1), curves))
        closed = first + second[::-1]
        axes.plot(*zip(*(closed + closed[:1])), color=COLORS[0], ls=style, lw=1.5)
    else:
        for i, curve in enumerate(curves):
            axes.plot([p["moment"] / 1e3 for p in curve["points"]], [p["axial_force"] / 1e3 for p in curve["points"]],
                      color=plt.get_cmap("viridis")(i / max(1, len(curves) - 1)), ls=style, lw=1.2,
                      label=f"{math.degrees(curve['angle']):.0f}°" if len(curves) <= 12 else None)


def main():
    arguments = parse()
    runs = [read(folder) for folder in (arguments.folder, arguments.compare) if folder]
    with_interaction = any("interaction" in run for run in runs)
    figure, axes = plt.subplots(1, 2 if with_interaction else 1, figsize=(11 if with_interaction else 6.5, 4.6),
                                layout="constrained", squeeze=False)
    left = axes[0][0]
    for run, folder, style in zip(runs, (arguments.folder, arguments.compare), ("-", (0, (4, 2)))):
        draw_curve(left, run, style, folder.name if len(runs) > 1 else None)
        if "interaction" in run:
            draw_interaction(axes[0][1], run, style)
    curve = runs[0]["moment_curvature"]
    left.set_title(f"{runs[0]['section']}: N = {curve['axial_force'] / 1e3:g} kN, axis at "
                   f"{math.degrees(curve['angle']):g}° (0: z, 90: y)", loc="left", fontsize=10.5)
    left.set_xlabel("curvature (1/m)")
    left.set_ylabel("moment (kN m)")
    left.axhline(0, color="#888888", lw=0.8)
    left.grid(alpha=0.25)
    if left.get_legend_handles_labels()[0]:
        left.legend(fontsize=9, frameon=False)
    if with_interaction:
        right = axes[0][1]
        right.set_title("interaction at the strain limits", loc="left", fontsize=10.5)
        right.set_xlabel("moment (kN m)")
        right.set_ylabel("axial force (kN), tension positive")
        right.axhline(0, color="#888888", lw=0.8)
        right.axvline(0, color="#888888", lw=0.8)
        right.grid(alpha=0.25)
        if right.get_legend_handles_labels()[0]:
            right.legend(fontsize=8, frameon=False, ncols=2)
    output = arguments.output or arguments.folder / "section.png"
    figure.savefig(output, dpi=110)
    print(output)


if __name__ == "__main__":
    main()
