"""Whether the option `accuracy` of the scheme exponential is met: the two-story pair with fiber columns at ten intensities, with and without
contact, and the reinforced-concrete pair, against runs that ask for a thirtieth of the least error.

Writes bench/results/accuracy_met.md and .json. Standard library only. What the numbers mean: bench/README.md.
"""
import argparse
import math

from harness import Nsframe, arguments, machine, number, progress, run_bench, table, write
from pair import ALL_DAMPED, CASES, NO_CONTACT, ROOF_NODES

DT = 5e-3                                   # [s], which the option parts
SAMPLE = 5e-3                               # of histories [s]
ASKED = (1e-2, 1e-3, 1e-4)                  # of the peak displacement
FINER = 0.03                                # of the least accuracy asked: the reference
INTENSITIES = (0.24, 0.26, 0.27, 0.28, 0.29, 0.31, 0.32, 0.33, 0.34, 0.36)  # peak ground acceleration [g]
STEEL = {**CASES["displacement-based"][1], **ALL_DAMPED, "gravity.acceleration": 0}
CONCRETE_NODES = ("left.22", "left.23", "right.21", "right.24")
SETS = {  # title: example, nodes, duration [s], settings of its runs
    "Steel02, displacement-based, all modes damped by 2 %": ("two_story", ROOF_NODES, 5.0, [{**STEEL, "motion.pga": '"%g g"' % a} for a in INTENSITIES]),
    "the same without contact": ("two_story", ROOF_NODES, 5.0, [{**STEEL, **NO_CONTACT, "motion.pga": '"%g g"' % a} for a in INTENSITIES[::3]]),
    "Steel02, force-based, all modes damped by 2 %": ("two_story", ROOF_NODES, 5.0, [{**CASES["force-based"][1], **ALL_DAMPED, "gravity.acceleration": 0, "motion.pga": '"%g g"' % a} for a in INTENSITIES[::3]]),
    "Concrete02 and Steel02, corotational (examples/inelastic_pounding)": ("inelastic_pounding", CONCRETE_NODES, 5.0, [{}]),
}


def history(nsframe, example, nodes, duration, settings, accuracy):
    """Summary, and displacements of the nodes in x, y, z at common times."""
    values = {**settings, "analysis.scheme": "exponential", "analysis.dt": repr(DT), "analysis.duration": repr(duration), "analysis.accuracy": repr(accuracy)}
    summary, _, _, moved = nsframe.run(example, values, nodes, 1 / SAMPLE)
    return summary, [moved[node][axis] for node in nodes for axis in range(3)]


def measured(nsframe, title, quick):
    example, nodes, duration, runs = SETS[title]
    duration, runs, asked = (0.05, runs[:1], ASKED[:1]) if quick else (duration, runs, ASKED)
    errors, evaluations, impacts = {a: [] for a in asked}, {a: 0.0 for a in asked}, []
    for index, settings in enumerate(runs):
        progress("%s: %d of %d" % (title, index + 1, len(runs)))
        summary, reference = history(nsframe, example, nodes, duration, settings, FINER * min(asked))
        peak = max(abs(u) for row in reference for u in row)
        impacts.append(len(summary["impacts"]))
        for accuracy in asked:
            summary, moved = history(nsframe, example, nodes, duration, settings, accuracy)
            error = max(abs(a - b) for row, other in zip(reference, moved) for a, b in zip(row, other))
            errors[accuracy].append(error / peak / accuracy)
            evaluations[accuracy] += summary["evaluations"] / duration / len(runs)
    return dict(title=title, runs=len(runs), impacts=impacts, errors=[dict(accuracy=a, over_asked=errors[a], evaluations_per_s=evaluations[a]) for a in asked])


def mean(values):
    """Geometric; 0 where a value is."""
    return math.exp(sum(math.log(v) for v in values) / len(values)) if min(values) > 0 else 0.0


def rows(case):
    impacts = "%d to %d" % (min(case["impacts"]), max(case["impacts"])) if case["runs"] > 1 else str(case["impacts"][0])
    return [[case["title"], case["runs"], impacts, "%g" % row["accuracy"], number(mean(row["over_asked"]), 2), number(max(row["over_asked"]), 2),
             "%d of %d" % (sum(1 for v in row["over_asked"] if v <= 1), case["runs"]), number(row["evaluations_per_s"])] for row in case["errors"]]


def main():
    options = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0])).parse_args()
    nsframe = Nsframe(options.program)
    cases = [measured(nsframe, title, options.quick) for title in SETS]
    head = ["scene", "runs", "impacts", "accuracy", "error / asked: mean", "largest", "met", "evaluations a second of motion"]
    text = ("# Is the accuracy met?\n\n%s. Scheme exponential, dt = %g ms, El Centro, %g s: largest error of a facing roof corner in x, y, z at any multiple of\n"
            "%g ms, over the peak displacement and over the accuracy asked, against a run with accuracy %g.\n\n%s"
            % (machine(), 1e3 * DT, SETS[cases[0]["title"]][2], 1e3 * SAMPLE, FINER * min(ASKED), table(head, [row for case in cases for row in rows(case)])))
    write(options.results, "accuracy_met", text, dict(machine=machine(), cases=cases))


if __name__ == "__main__":
    run_bench(main)
