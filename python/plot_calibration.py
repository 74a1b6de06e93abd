#!/usr/bin/env python3
"""Plot a calibration: differences from the measured frequencies at the start and fitted, and sensitivities.

    plot_calibration.py FOLDER -o calibration.png

Reads calibration.json, which `nsframe calibrate` leaves in FOLDER. Needs numpy and matplotlib.
"""
import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

START, FITTED = "#e69f00", "#0072b2"  # Okabe-Ito


def draw_differences(axes, frequencies, accuracy):
    rows = np.arange(len(frequencies))
    for key, color, name, shift in (("start", START, "start", -0.2), ("fitted", FITTED, "fitted", 0.2)):
        values = [100 * (frequency[key] / frequency["measured"] - 1) for frequency in frequencies]
        axes.barh(rows + shift, values, 0.38, color=color, label=name)
    for side in (-1, 1):
        axes.axvline(100 * side * accuracy, color="0.4", linewidth=0.8, linestyle=":")
    axes.axvline(0, color="0.2", linewidth=0.8)
    axes.set_yticks(rows, ["%s %s" % (frequency["structure"], frequency["mode"]) for frequency in frequencies])
    axes.invert_yaxis()
    axes.set_xlabel("difference from the measured frequency, %")
    axes.legend(loc="best", fontsize="small")


def draw_sensitivities(axes, frequencies, names):
    table = np.array([[frequency["sensitivity"].get(name, 0.0) for name in names] for frequency in frequencies])
    most = np.abs(table).max() or 1.0
    image = axes.imshow(table, cmap="RdBu_r", vmin=-most, vmax=most, aspect="auto")
    for (row, column), value in np.ndenumerate(table):
        if abs(value) >= 0.005:
            axes.text(column, row, "%.2f" % value, ha="center", va="center", fontsize=7, color="w" if abs(value) > 0.7 * most else "k")
    axes.set_yticks(range(len(frequencies)), [])
    axes.set_xticks(range(len(names)), names, rotation=60, ha="right")
    axes.figure.colorbar(image, ax=axes, label="sensitivity, d ln f / d ln p")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="folder with calibration.json")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("calibration.png"))
    arguments = parser.parse_args()
    calibration = json.loads((arguments.folder / "calibration.json").read_text(encoding="utf-8"))
    frequencies = [frequency for frequency in calibration["frequencies"] if frequency["matched"]]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.8, 4.2), width_ratios=(1, 1.15), layout="constrained")
    draw_differences(left, frequencies, calibration["accuracy"])
    draw_sensitivities(right, frequencies, [parameter["name"] for parameter in calibration["parameters"]])
    figure.savefig(arguments.output, dpi=100)


if __name__ == "__main__":
    main()
