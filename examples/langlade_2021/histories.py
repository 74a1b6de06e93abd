"""Histories and spectra of runs as short lists of numbers, for the figures. Needs h5py and numpy."""
import os

import h5py
import numpy as np

MICROMETRES_10 = 1e-5  # [m] the unit of displacements in curves.json


def kept(nodes, rate=0):
    listed = "[" + ", ".join(f'"{node}"' for node in nodes) + "]"
    return {"output.history": '["nodes"]', "output.nodes": listed, "output.history_rate": rate}


def displacements(folder, component=0):
    """Times, and a column a node [m]: of the nodes kept, in their order in the file."""
    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        ids = [name.decode() for name in file["nodes/id"][:]]
        return file["time"][:], dict(zip(ids, file["nodes/displacement"][:, :, component].T))


def accelerations(folder, node):
    """Times and the node's acceleration along x as the run gives it: difference of velocity over the step [m/s2]."""
    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        ids = [name.decode() for name in file["nodes/id"][:]]
        return file["time"][:], file["nodes/acceleration_absolute"][:, ids.index(node), 0]


def floor_spectra(folder):
    """Periods [s]; node -> pseudo-velocity [m/s], pseudo-acceleration [m/s2] along x."""
    with h5py.File(os.path.join(folder, "results.h5"), "r") as file:
        group = file["floor_spectra"]
        nodes = [name.decode() for name in group["node"][:]]
        return group["period"][:], {node: (group["pseudo_velocity"][i, 0, :], group["pseudo_acceleration"][i, 0, :])
                                    for i, node in enumerate(nodes)}


def short(values, digits=4):
    return [float(f"{value:.{digits}g}") for value in values]


def curve(values):
    return [int(round(value / MICROMETRES_10)) for value in values]


def window(times, columns, start, length, rate):
    """The part of histories sampled at `rate` [Hz] that a figure shows."""
    inside = (times >= start - 1e-9) & (times <= start + length + 1e-9)
    return {"start": round(float(times[inside][0]), 6), "rate": rate, "nodes": {n: curve(v[inside]) for n, v in columns.items()}}


def ball_height(times):
    """Of the ball dropped from 1 m under 2 m/s2 with e = 0.5: impacts at 1, 2, 2.5, 2.75 ... s, at rest from 3 s."""
    height = np.where(times < 1, 1 - times**2, 0.0)
    start, speed = 1.0, 1.0
    while speed > 1e-12:
        flying = (times >= start) & (times < start + speed)
        height = np.where(flying, speed * (times - start) - (times - start) ** 2, height)
        start, speed = start + speed, 0.5 * speed
    return height
