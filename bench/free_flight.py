"""Free flight (no contact) of the two-story pair in nsframe and in OpenSees: must agree, and validates the chain of
elements, masses, modal damping, motion and time integration.

While nothing touches, Moreau-Jean at theta = 1/2 is Newmark's average acceleration, for any P(q): with + at the end of
the step both have M (v+ - v) + h/2 (C (v + v+) + P + P+) = h/2 (f + f+) and q+ - q = h/2 (v + v+).
Writes bench/results/free_flight.md and .json. Standard library only; without openseespy it says so and stops.
"""
import argparse
import sys

from harness import BenchError, Nsframe, arguments, machine, number, opensees_python, progress, table, write
from pair import CASES, Opensees, largest_difference, moreau_jean, run_nsframe

INTERVAL = 0.01                                                           # [s]
DURATION = {"elastic": 6.0, "displacement-based": 3.0, "force-based": 3.0}  # [s]
STEPS = (1e-3, 5e-4)                                                      # [s]
TOLERANCES = (1e-8, 1e-11)                                                # [m, rad] of OpenSees


def main():
    parser = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0]))
    parser.add_argument("--columns", choices=CASES, nargs="+", default=list(CASES))
    parser.add_argument("--steps", type=float, nargs="+", default=STEPS, help="[s]")
    parser.add_argument("--opensees-python", metavar="P", help="interpreter that has openseespy (default: this one)")
    options = parser.parse_args()
    nsframe = Nsframe(options.program)
    python, reason = opensees_python(options.opensees_python)
    if not python:
        print("free_flight.py: nothing to compare with: %s" % reason)
        return
    opensees = Opensees(python)
    rows, lines = [], []
    for columns in options.columns:
        duration = 0.05 if options.quick else DURATION[columns]
        previous = None
        for dt in options.steps:
            progress("%s, dt = %g s" % (columns, dt))
            summary, _, time, roof = run_nsframe(nsframe, columns, dt, duration,
                                                 {**moreau_jean(0.5), "analysis.newton_tolerance": 1e-12}, contact=False, history=INTERVAL)
            differences = []
            for tolerance in TOLERANCES:
                data, _ = opensees.run(columns, dt, duration, ["--free-flight", "--history", INTERVAL,
                                                               "--tolerance", tolerance])
                differences.append(largest_difference(time, roof, data["time"], data["roof"])[0])
            peak = max(abs(u) for corner in roof for u in corner)
            change = largest_difference(time, roof, *previous)[0] if previous else None
            previous = time, roof
            rows.append(dict(columns=columns, dt=dt, duration=duration, peak_m=peak, differences_m=differences,
                             change_m=change, version=data["version"]))
            lines.append([columns, "%g" % (1e3 * dt), "%g" % duration, number(1e3 * peak)]
                         + [number(1e3 * d) for d in differences] + [number(1e3 * change if change else None)])
    head = ["columns", "dt, ms", "over, s", "peak, mm"] + ["difference, mm, at tolerance %.0e" % t for t in TOLERANCES] \
        + ["change of nsframe by its step, mm"]
    text = ("# Free flight: nsframe against OpenSees\n\n%s; OpenSees %s, Newmark 1/2, 1/4; nsframe theta = 1/2. Largest difference\n"
            "of a facing roof corner's displacement in x. The tolerance is that of OpenSees' test on displacement increments.\n\n%s"
            % (machine(), rows[-1]["version"], table(head, lines)))
    write(options.results, "free_flight", text, dict(rows=rows, tolerances=TOLERANCES))


if __name__ == "__main__":
    try:
        main()
    except BenchError as problem:
        sys.exit("error: %s" % problem)
