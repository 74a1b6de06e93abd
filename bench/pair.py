"""The two-story pair for two_story.py and free_flight.py: runs of nsframe and of OpenSees on the same motion."""
import json
import os
import subprocess
import tempfile

from harness import BENCH, ROOT, BenchError, measure

GRAVITY = 9.80665  # of the unit g [m/s2]
ROOF_NODES = ("left.22", "left.23", "right.21", "right.24")  # the facing corners, as ROOF of opensees_pair.py
CASES = {
    "elastic": ("two_story_elastic", {}),
    "displacement-based": ("two_story", {"structure.left.columns.element": "displacement",
                                         "structure.right.columns.element": "displacement"}),
    "force-based": ("two_story", {}),
}
DAMPED = "all modes damped"  # what rings for ever in the others decays here: errors don't grow from impact to impact
ALL_RATIOS = "[%s]" % ", ".join(["0.02"] * 30)
ALL_DAMPED = {"structure.left.damping.ratios": ALL_RATIOS, "structure.right.damping.ratios": ALL_RATIOS}
OWN_CASES = {**CASES, DAMPED: ("two_story", {**CASES["displacement-based"][1], **ALL_DAMPED})}  # nsframe alone: OpenSees damps six modes
NO_CONTACT = {"contact.gap": '["0.5 m", "0.5 m"]'}  # as far from the distance of the slabs as gap_tolerance allows


def read_at2(path, pga):
    """Step and values [m/s2] of a PEER record, scaled to the peak `pga` [g]."""
    with open(path) as file:
        lines = file.read().splitlines()
    head = next(i for i, line in enumerate(lines) if "DT=" in line)
    step = float(lines[head].split("DT=")[1].split()[0])
    values = [float(word) for line in lines[head + 1:] for word in line.split()]
    factor = pga * GRAVITY / max(abs(value) for value in values)
    return {"dt": step, "acceleration": [factor * value for value in values]}


class Opensees:
    """Runs opensees_pair.py as a process of its own."""

    def __init__(self, python):
        self.python = python
        self.record = read_at2(os.path.join(ROOT, "examples", "motions", "el_centro_1940_ns.at2"), 0.30)

    def run(self, columns, dt, duration, options=()):
        with tempfile.TemporaryDirectory() as folder:
            record, result = os.path.join(folder, "record.json"), os.path.join(folder, "result.json")
            with open(record, "w") as file:
                json.dump(self.record, file)
            usage = measure([self.python, os.path.join(BENCH, "opensees_pair.py"), record, result, "--columns", columns,
                             "--dt", repr(dt), "--duration", repr(duration)] + [str(option) for option in options])
            with open(result) as file:
                data = json.load(file)
        if not data["completed"]:
            raise BenchError("OpenSees stopped at t = %g s" % data["end_time"])
        return data, usage


def moreau_jean(theta, gamma=1.5):
    return {"analysis.scheme": "moreau-jean", "analysis.theta": theta, "analysis.gamma": gamma}


def run_nsframe(nsframe, columns, dt, duration, scheme, contact=True, history=0):
    """Summary, usage, times and the roof corners' displacement in x [m]; no gravity, as in OpenSees. `scheme`: its settings."""
    example, settings = OWN_CASES[columns]
    settings = {**settings, "gravity.acceleration": 0, "analysis.dt": repr(dt), "analysis.duration": repr(duration), **scheme}
    if not contact:
        settings.update(NO_CONTACT)
    summary, usage, time, nodes = nsframe.run(example, settings, ROOF_NODES if history else (),
                                              1 / history if history else 0)
    return summary, usage, time, [nodes[node][0] for node in ROOF_NODES] if nodes else []


def largest_difference(time_a, roof_a, time_b, roof_b):
    """Largest difference of two histories at the times that they share [m], and how many these are."""
    rows = {round(t * 1e6): i for i, t in enumerate(time_b)}
    shared = [(i, rows[round(t * 1e6)]) for i, t in enumerate(time_a) if round(t * 1e6) in rows]
    if not shared:
        raise BenchError("two histories share no time")
    return max(abs(a[i] - b[j]) for a, b in zip(roof_a, roof_b) for i, j in shared), len(shared)
