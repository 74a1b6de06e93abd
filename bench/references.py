"""Converged histories that two_story.py measures errors against: reference/two_story_*.csv. Rerun only when the scene
or the motion changes; takes some minutes.

Scheme exact for elastic columns, exponential for the others, at a step so small that twice the step gives nearly the same: the
difference is kept in the file as the reference's own error. No gravity. Standard library only.
"""
import argparse
import json
import os

from harness import BENCH, Nsframe, arguments, progress
from pair import DAMPED, OWN_CASES, ROOF_NODES, largest_difference, run_nsframe

DURATION, INTERVAL = 6.0, 0.005                                             # [s]
STEP = {"elastic": 1e-3, "displacement-based": 1e-5, "force-based": 1e-5, DAMPED: 1e-5}   # [s]
SCHEME = {"elastic": "exact", "displacement-based": "exponential", "force-based": "exponential", DAMPED: "exponential"}


def path_of(columns):
    return os.path.join(BENCH, "reference", "two_story_%s.csv" % columns.replace("-", "_").replace(" ", "_"))


def make(nsframe, columns, step):
    results = []
    for dt in (step, 2 * step):
        progress("%s columns, dt = %g s" % (columns, dt))
        results.append(run_nsframe(nsframe, columns, dt, DURATION, {"analysis.scheme": SCHEME[columns]}, history=INTERVAL))
    (summary, _, time, roof), (_, _, time_2, roof_2) = results
    head = dict(columns=columns, scheme=SCHEME[columns], dt=step, own_error_m=float("%.3g" % largest_difference(time, roof, time_2, roof_2)[0]),
                poundings=len(summary["poundings"]), impacts=len(summary["impacts"]))
    os.makedirs(os.path.dirname(path_of(columns)), exist_ok=True)
    with open(path_of(columns), "w") as file:
        file.write("# %s\n" % json.dumps(head))
        file.write("# time [s], displacement in x [m] of %s\n" % ", ".join(ROOF_NODES))
        for i, t in enumerate(time):
            file.write(",".join(["%.6g" % t] + ["%.12g" % corner[i] for corner in roof]) + "\n")


def read(columns):
    """Head (a dict), times and roof corners' histories; of no length where the file is missing."""
    if not os.path.exists(path_of(columns)):
        return dict(scheme=SCHEME[columns], dt=STEP[columns], own_error_m=None), [0.0], [[0.0] for _ in ROOF_NODES]
    with open(path_of(columns)) as file:
        lines = file.read().splitlines()
    rows = [[float(word) for word in line.split(",")] for line in lines[2:]]
    return json.loads(lines[0][2:]), [row[0] for row in rows], [[row[1 + k] for row in rows] for k in range(len(ROOF_NODES))]


if __name__ == "__main__":
    parser = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0]))
    parser.add_argument("--columns", choices=OWN_CASES, nargs="+", default=list(OWN_CASES))
    options = parser.parse_args()
    for name in options.columns:
        make(Nsframe(options.program), name, 1e-3 if options.quick else STEP[name])
