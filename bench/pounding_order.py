"""Order across poundings: error against step of the schemes that locate impacts, on the two-story pair with all modes damped by 2 % and as the
paper damps it, and how much each magnifies a change of its gaps.

Writes bench/results/pounding_order.md and .json. Standard library only. What the numbers mean: bench/README.md.
"""
import argparse
import math

from harness import Nsframe, arguments, machine, number, progress, run_bench, table, write
from pair import ALL_DAMPED, ROOF_NODES, largest_difference

SCHEMES = {
    "event-split, theta": {"analysis.scheme": "event-split", "analysis.integrator": "theta", "analysis.theta": 0.5},
    "event-split, generalized-alpha": {"analysis.scheme": "event-split", "analysis.integrator": "generalized-alpha"},
    "event-split, alpha-os": {"analysis.scheme": "event-split", "analysis.integrator": "alpha-os"},
    "exponential": {"analysis.scheme": "exponential"},
}
STEPS = (1e-3, 1e-4, 5e-5, 2.5e-5)  # [s]
PAPER_STEPS = (5e-5, 2.5e-5, 1.25e-5)  # that resolve what rings undamped [s]
PAPER_END = 2.8                     # before errors grow [s]
FINE = 1e-4                         # from here on the slope is told [s]
SAMPLE = 5e-3                       # of histories [s]
GAPS = (0.05, 0.055)                # of the scene [m]
CHANGES = (1e-12, 1e-10, 1e-8)      # of them [m]
TIMES = (2.6, 3.5, 4, 5, 6, 20)     # [s]


def history(nsframe, example, scheme, dt, duration, settings):
    values = {**scheme, **settings, "analysis.dt": repr(dt), "analysis.duration": repr(duration)}
    summary, usage, time, nodes = nsframe.run(example, values, ROOF_NODES, 1 / SAMPLE)
    return summary, usage, time, [nodes[node][axis] for node in ROOF_NODES for axis in range(3)]


def order(nsframe, example, reference, reference_step, duration, steps, settings):
    """Rows of one pair: a scheme, errors by step, slope from FINE to the least step."""
    _, _, time, exact = history(nsframe, example, reference, reference_step, duration, settings)
    rows = []
    for name, scheme in SCHEMES.items():
        errors, impacts, seconds = [], 0, 0.0
        for dt in steps:
            progress("%s, %s, %g ms" % (example, name, 1e3 * dt))
            summary, usage, times, roof = history(nsframe, example, scheme, dt, duration, settings)
            errors.append(largest_difference(times, roof, time, exact)[0])
            impacts, seconds = len(summary["impacts"]), usage["cpu_s"]
        fine = [(dt, error) for dt, error in zip(steps, errors) if dt <= FINE]
        slope = None
        if len(fine) > 1 and fine[-1][1] > 0:
            slope = math.log(fine[0][1] / fine[-1][1]) / math.log(fine[0][0] / fine[-1][0])
        rows.append(dict(scheme=name, errors=errors, slope=slope, impacts=impacts, cpu_s=seconds))
    return rows


def growth(nsframe, settings, times):
    """Largest displacement that a change of the gaps makes until each time, over the change; rows of CHANGES."""
    exact = {"analysis.scheme": "exact"}
    _, _, time, before = history(nsframe, "two_story_elastic", exact, SAMPLE, times[-1], settings)
    rows = []
    for change in CHANGES:
        gap = {"contact.gap": "[%s]" % ", ".join('"%r m"' % (value + change) for value in GAPS)}
        _, _, _, after = history(nsframe, "two_story_elastic", exact, SAMPLE, times[-1], {**settings, **gap})
        differences = [max(abs(a[i] - b[i]) for a, b in zip(before, after)) for i in range(len(time))]
        rows.append([max(d for t, d in zip(time, differences) if t <= until + 1e-9) / change for until in times])
    return rows


def order_text(rows, steps):
    fine = max([dt for dt in steps if dt <= FINE], default=FINE)
    header = ["scheme"] + ["%g ms" % (1e3 * dt) for dt in steps] + ["slope from %g ms" % (1e3 * fine), "impacts", "CPU s, last"]
    return table(header, [[row["scheme"]] + [number(e) for e in row["errors"]] +
                          [number(row["slope"]), row["impacts"], number(row["cpu_s"])] for row in rows])


def growth_text(rows, times):
    return table(["change, m"] + ["until %g s" % t for t in times],
                 [["%g" % change] + [number(value, 2) for value in row] for change, row in zip(CHANGES, rows)])


def main():
    options = arguments(argparse.ArgumentParser(description=__doc__)).parse_args()
    nsframe = Nsframe(options.program)
    steps = STEPS[:1] if options.quick else STEPS
    times = (0.1, 0.2) if options.quick else TIMES
    elastic_end, fiber_end, fiber_step = (0.05, 0.05, 1e-3) if options.quick else (6.0, 2.8, 2.5e-5)
    paper_end, paper_steps = (0.05, steps) if options.quick else (PAPER_END, PAPER_STEPS)
    exact, exponential = {"analysis.scheme": "exact"}, SCHEMES["exponential"]
    elastic = order(nsframe, "two_story_elastic", exact, SAMPLE, elastic_end, steps, ALL_DAMPED)
    fiber = order(nsframe, "two_story", exponential, fiber_step / 2, fiber_end, steps, ALL_DAMPED)
    elastic_paper = order(nsframe, "two_story_elastic", exact, SAMPLE, paper_end, paper_steps, {})
    fiber_paper = order(nsframe, "two_story", exponential, fiber_step / 4, paper_end, paper_steps, {})
    paper, damped = growth(nsframe, {}, times), growth(nsframe, ALL_DAMPED, times)
    text = ("# Order across poundings\n\n%s. The two-story pair: largest error [m] of a facing roof corner in x, y, z.\n\n"
            "## Elastic columns, all modes damped by 2 %%, %g s\n\nAgainst `exact`.\n\n%s\n"
            "## Fiber columns, Steel02, all modes damped by 2 %%, %g s\n\nAgainst `exponential` at %g ms.\n\n%s\n"
            "## Elastic columns, damped as in the paper, %g s\n\nAgainst `exact`.\n\n%s\n"
            "## Fiber columns, Steel02, damped as in the paper, %g s\n\nAgainst `exponential` at %g ms.\n\n%s\n"
            "## What a change of the gaps grows to\n\nBy `exact`, over the change. Damped as in the paper:\n\n%s\nAll modes damped by 2 %%:\n\n%s"
            % (machine(), elastic_end, order_text(elastic, steps), fiber_end, 500 * fiber_step, order_text(fiber, steps),
               paper_end, order_text(elastic_paper, paper_steps), paper_end, 250 * fiber_step, order_text(fiber_paper, paper_steps),
               growth_text(paper, times), growth_text(damped, times)))
    write(options.results, "pounding_order", text,
          dict(machine=machine(), steps=steps, elastic=elastic, fiber=fiber, paper_steps=paper_steps, elastic_paper=elastic_paper,
               fiber_paper=fiber_paper, changes=CHANGES, times=times, paper=paper, damped=damped))


if __name__ == "__main__":
    run_bench(main)
