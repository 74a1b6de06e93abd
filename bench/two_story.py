"""Speed and error of the two-story pair: nsframe, and OpenSees in the same go where openseespy can be imported.

    python3 bench/two_story.py                        (with the python that has openseespy)
    python3 bench/two_story.py --opensees-python P    (openseespy is in interpreter P)

Writes bench/results/two_story.md and .json. Standard library only. What the numbers mean: bench/README.md.
"""
import argparse

import references
from harness import (Nsframe, arguments, machine, number, peer_arguments, peer_python, progress, run_bench, step_microseconds, table,
                     write_compared)
from pair import DAMPED, OWN_CASES, ROOF_NODES, Opensees, largest_difference, moreau_jean, run_nsframe

TITLES = {"elastic": "Elastic columns", "displacement-based": "Fiber columns, Steel02, displacement-based",
          "force-based": "Fiber columns, Steel02, force-based",
          DAMPED: "Fiber columns, Steel02, displacement-based, 2 % damping of all modes"}
DURATION = {"elastic": 20.0, "displacement-based": 6.0, "force-based": 6.0, DAMPED: 6.0}  # [s] of motion for speed and peaks
PAPER, HALF = ("theta = 1, gamma = 1.5", moreau_jean(1.0)), ("theta = 0.5, gamma = 0.5", moreau_jean(0.5, 0.5))
EXACT, EXPONENTIAL = ("exact", {"analysis.scheme": "exact"}), ("exponential", {"analysis.scheme": "exponential"})


def accurate(text):
    return "exponential, accuracy " + text, {"analysis.scheme": "exponential", "analysis.accuracy": float(text)}


FIBER = [(PAPER, 1e-3, 3), (HALF, 1e-3, 3), (HALF, 1e-4, 1), (EXPONENTIAL, 5e-3, 3), (EXPONENTIAL, 1e-3, 3), (EXPONENTIAL, 1e-4, 1),
         (accurate("1e-3"), 5e-3, 3)]
# setting, dt [s], runs; the first is the setting of the paper
NSFRAME = {"elastic": [(PAPER, 1e-3, 7), (HALF, 1e-3, 7), (HALF, 1e-4, 3), (HALF, 1e-5, 1), (EXACT, 1e-3, 7), (EXACT, 5e-3, 7)],
           "displacement-based": FIBER, "force-based": FIBER,
           DAMPED: FIBER + [(EXPONENTIAL, 2e-3, 3), (accurate("5e-4"), 1e-3, 3), (accurate("5e-4"), 5e-3, 3), (accurate("1e-4"), 5e-3, 3)]}
# penalty [N/m], dt [s], runs, duration [s] or None for that of the case; the first is the fastest
OPENSEES = {"elastic": [(1e8, 1e-3, 3, None), (1e9, 1e-4, 1, 6.0)], "displacement-based": [(1e8, 1e-3, 2, None)],
            "force-based": [(1e8, 1e-3, 2, None)], DAMPED: []}
QUICK = 0.05  # [s]


def nsframe_row(nsframe, columns, reference, setting, duration):
    (name, scheme), dt, runs = setting
    progress("%s: nsframe, %s, dt = %g s" % (columns, name, dt))
    window = reference[1][-1]
    # Wall time of the step loop, or CPU time of the process less that of a run of one step (it includes the peaks and the
    # writing of histories): where other programs take the cores, the second is the closer one.
    times = []
    _, setup, _, _ = run_nsframe(nsframe, columns, dt, dt, scheme)
    for run in range(runs):
        summary, usage, time, roof = run_nsframe(nsframe, columns, dt, duration, scheme,
                                                 history=references.INTERVAL if run == 0 else 0)
        cpu = 1e6 * (usage["cpu_s"] - setup["cpu_s"]) / max(1, summary["steps"] - 1)
        wall = step_microseconds(summary)
        times.append(min(wall, cpu) if summary["steps"] >= 5000 else wall)
        if run == 0:
            error = compare(reference, time, roof, min(window, duration))
    peaks = {peak["node"]: abs(peak["displacement"][0]) for peak in summary["peaks"]}
    return dict(program="nsframe", setting=name, dt=dt, runs=runs, duration=duration,
                step_us=min(times), step_us_all=times, memory_mb=usage["memory_mb"], error_m=error,
                peaks_m=[peaks[node] for node in ROOF_NODES], poundings=len(summary["poundings"]),
                iterations=summary["newton_iterations"] / summary["steps"])


def opensees_row(opensees, columns, reference, setting, duration):
    penalty, dt, runs, own_duration = setting
    duration = own_duration or duration
    progress("%s: OpenSees, penalty %g N/m, dt = %g s" % (columns, penalty, dt))
    data, usage = opensees.run(columns, dt, duration, ["--history", references.INTERVAL, "--repeat", runs,
                                                       "--penalty", penalty])
    error = compare(reference, data["time"], data["roof"], min(reference[1][-1], duration))
    return dict(program="OpenSees", version=data["version"], setting="penalty %.0e N/m" % penalty, dt=dt, runs=runs,
                duration=duration, step_us=data["step_us"], step_us_all=data["step_us_all"],
                memory_mb=usage["memory_mb"], error_m=error, peaks_m=data["peaks"], parted_steps=data["parted_steps"])


def compare(reference, time, roof, end):
    """Largest error of a facing roof corner's displacement in x until `end` [m]."""
    if len(reference[1]) < 2:
        return None
    keep = sum(1 for t in reference[1] if t <= end + 1e-9)
    return largest_difference(reference[1][:keep], [corner[:keep] for corner in reference[2]], time, roof)[0]


def millimetres(value):
    return number(None if value is None else 1e3 * value)


def text_of(columns, reference, rows):
    slow = [row for row in rows if row["program"] == "OpenSees"]
    lines = []
    for row in rows:
        ratio = slow[0]["step_us"] / row["step_us"] if slow and row["program"] == "nsframe" else None
        per_second = row["step_us"] / row["dt"] * 1e-3  # [ms] of computing a second of motion
        lines.append([row["program"] + ", " + row["setting"], "%g" % (1e3 * row["dt"]), number(row["step_us"]), number(ratio),
                      number(per_second), millimetres(row["error_m"]),
                      "%.1f, %.1f" % (1e3 * max(row["peaks_m"][:2]), 1e3 * max(row["peaks_m"][2:])),
                      "%g" % row["duration"], number(row["memory_mb"])])
    head = ["", "dt, ms", "µs a step", "OpenSees / it", "ms a second of motion", "largest error, mm", "roof peaks, mm",
            "over, s", "memory, MB"]
    known = reference[0]
    return "## %s\n\nReference: %s, dt = %g s over %g s; twice the step differs by %s mm.\n\n%s" % (
        TITLES[columns], known["scheme"], known["dt"], reference[1][-1],
        millimetres(known["own_error_m"]), table(head, lines))


def main():
    parser = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0]))
    parser.add_argument("--columns", choices=OWN_CASES, nargs="+", default=list(OWN_CASES))
    peer_arguments(parser)
    options = parser.parse_args()
    nsframe = Nsframe(options.program)
    python, reason = peer_python(options)
    opensees = Opensees(python) if python else None
    data = dict(machine=machine(), opensees=reason or "run", cases={})
    parts = []
    for columns in options.columns:
        reference = references.read(columns)
        duration = QUICK if options.quick else DURATION[columns]
        rows = []
        for setting in NSFRAME[columns][:1] if options.quick else NSFRAME[columns]:
            rows.append(nsframe_row(nsframe, columns, reference, setting, duration))
        for setting in (OPENSEES[columns][:1] if options.quick else OPENSEES[columns]) if opensees else []:
            rows.append(opensees_row(opensees, columns, reference, setting, duration))
        data["cases"][columns] = dict(reference=reference[0], rows=rows)
        parts.append(text_of(columns, reference, rows))
    write_compared(options, "two_story", "Two-story pair: speed and error", "Least of several runs on one core.",
                   "modalDampingQ, BandSPD, KrylovNewton, Newmark 1/2, 1/4, test on displacement increments 1e-8", reason, parts, data)


if __name__ == "__main__":
    run_bench(main)
