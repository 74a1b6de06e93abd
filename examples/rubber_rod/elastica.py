#!/usr/bin/env python3
"""The elasticas of the rubber rod, EI a'' = -(q (L - s) - F) cos a with a = 0 at the clamp and no moment at the tip, by shooting: its sag
at rest and the force F that lifts its tip level, printed and drawn beside the nodes of a run.

    elastica.py RUN_FOLDER -o picture.png

Reads results.h5. Needs h5py and matplotlib.
"""
import argparse
import math
import pathlib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

LENGTH, DIAMETER, E = 0.6, 0.04, 5e6  # [m], [m], [Pa]
EI = E * math.pi * DIAMETER**4 / 64
WEIGHT = 1200 * 9.81 * math.pi * DIAMETER**2 / 4 + 3  # [N/m]
ELEMENTS, PIECES = 12, 1000


def integrated(moment, force):
    """From the clamp by the midpoint rule: the moment at the tip, and the places (x, sag) on the way."""
    h = LENGTH / PIECES
    angle = x = sag = 0.0
    places = [(x, sag)]
    for i in range(PIECES):
        change = -(WEIGHT * (LENGTH - i * h) - force) * math.cos(angle)
        middle_angle, middle_moment = angle + h / 2 * moment / EI, moment + h / 2 * change
        x, sag = x + h * math.cos(middle_angle), sag + h * math.sin(middle_angle)
        places.append((x, sag))
        moment -= h * (WEIGHT * (LENGTH - (i + 0.5) * h) - force) * math.cos(middle_angle)
        angle += h * middle_moment / EI
    return moment, places


def bisected(rises, low, high):
    for _ in range(48):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if rises(middle) else (middle, high)
    return 0.5 * (low + high)


def elastica(force):
    most = WEIGHT * LENGTH**2
    return integrated(bisected(lambda moment: integrated(moment, force)[0] > 0, -most, most), force)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=pathlib.Path, help="folder with results.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("rubber_rod.png"))
    arguments = parser.parse_args()
    lift = bisected(lambda force: elastica(force)[-1][1] < 0, 0, WEIGHT * LENGTH)
    print(f"sag of the tip at rest {elastica(0)[-1][1]:.6f} m, force that lifts it level {lift:.6f} N")
    with h5py.File(arguments.run / "results.h5") as results:
        nodes = results["static/lift/nodes"]
        ids = [name.decode() for name in nodes["id"][:]]
        displacement = nodes["displacement"][:]
    figure, axes = plt.subplots(figsize=(6.4, 4.0), dpi=110)
    for force, point, color, name in ((0, 0, "#0072b2", "at rest"), (lift, -1, "#d55e00", "tip lifted")):
        places = elastica(force)
        axes.plot([x for x, _ in places], [-sag for _, sag in places], color=color, lw=1.2, label=f"elastica, {name}")
        moved = [displacement[point, ids.index(f"rod.{i}")] for i in range(ELEMENTS + 1)]
        axes.plot([LENGTH * i / ELEMENTS + u[0] for i, u in enumerate(moved)], [u[2] for u in moved], "o", color=color, ms=4.5,
                  label=f"nodes, {name}")
    way = [LENGTH * i / 100 for i in range(101)]
    axes.plot(way, [-WEIGHT / (24 * EI) * x * x * (6 * LENGTH**2 - 4 * LENGTH * x + x * x) for x in way], ":", color="0.5",
              label="small rotations, at rest")
    axes.set_aspect("equal")
    axes.set_xlabel("x, m")
    axes.set_ylabel("z, m")
    axes.legend(fontsize=8, loc="lower left")
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(arguments.output)


if __name__ == "__main__":
    main()
