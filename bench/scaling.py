"""Cost of a step against the size of the model: the pair with 2, 8, 32 and 128 stories, contact on every floor, elastic and
fiber columns, in nsframe and, where openseespy can be imported, in OpenSees.

    python3 bench/scaling.py                        (with the python that has openseespy)
    python3 bench/scaling.py --opensees-python P    (openseespy is in interpreter P)

Writes bench/results/scaling.md and .json. Standard library only. What the numbers mean: bench/README.md.
"""
import argparse
import os
import tempfile

from harness import (Nsframe, arguments, machine, number, peer_arguments, peer_python, progress, run_bench, step_microseconds, table,
                     write_compared)
from pair import Opensees, moreau_jean, run_nsframe

TITLES = {"elastic": "Elastic columns", "displacement-based": "Fiber columns, Steel02, displacement-based"}
STORIES = (2, 8, 32, 128)
DT = 1e-3                     # [s]
RUNS = 3
STEPS = {"elastic": {2: 4000, 8: 2000, 32: 1000, 128: 400}, "displacement-based": {2: 2000, 8: 1000, 32: 400, 128: 200}}
OPENSEES_STEPS = {2: 400, 8: 200, 32: 100, 128: 40}
QUICK_STEPS = 5
RATIO = 0.01                  # of six modes of each building (in OpenSees: of the model)
GAPS = (1e-6, 1.5e-6)         # [m], so that floors touch from the first steps on
FAR = {"contact.gap": '["0.5 m", "0.5 m"]'}  # pairs that nothing reaches
PRESSED = 0.03                # [g] of a constant base acceleration that presses all floors of one building against the other
PRESSED_STEPS = 3000          # until they are, at 128 stories
# event-split locates the bursts of these tiny gaps one by one, which takes minutes: only its steps without contact are timed
RUNS_OF = {"nsframe": moreau_jean(1.0), "nsframe, two threads": {**moreau_jean(1.0), "analysis.threads": 2}, "nsframe, far": {**moreau_jean(1.0), **FAR},
           "event-split, far": {"analysis.scheme": "event-split", **FAR}}
# of the lower stories and of the last one, as examples/two_story
STORY = {"left": dict(area=(1.61229e-4, 2.44428e-4), inertia=(588.573, 585.454)),
         "right": dict(area=(1.96086e-4, 4.34601e-4), inertia=(2971.41, 1503.19))}


def one_a_story(values, stories):
    return "[%s]" % ", ".join(repr(values[floor == stories]) for floor in range(1, stories + 1))


def settings(stories):
    values = {"contact.gap": '["%g m", "%g m"]' % GAPS}
    for side, story in STORY.items():
        key = "structure.%s." % side
        values[key + "stories"] = stories
        values[key + "braces.area"] = one_a_story(story["area"], stories)
        values[key + "centre_inertia"] = one_a_story(story["inertia"], stories)
        values[key + "damping.ratios"] = "[%s]" % ", ".join([repr(RATIO)] * 6)
    return values


def pressed(folder):
    """Settings of the constant acceleration; its record is written to the folder."""
    record = os.path.join(folder, "push.txt")
    with open(record, "w") as file:
        file.write("0\n" + "-1\n" * 200)
    return {**moreau_jean(1.0), "motion.file": record, "motion.dt": "0.05 s", "motion.unit": "m/s2", "motion.pga": "%g g" % PRESSED}


def nsframe_row(nsframe, columns, stories, quick, name, scheme):
    steps = QUICK_STEPS if quick else PRESSED_STEPS if name.endswith("pressed") else STEPS[columns][stories]
    progress("%s, %d stories: %s" % (columns, stories, name))
    times = []
    for _ in range(1 if quick else RUNS):
        summary, usage, _, _ = run_nsframe(nsframe, columns, DT, steps * DT, {**settings(stories), **scheme})
        times.append(step_microseconds(summary))
    return dict(program=name, stories=stories, dofs=summary["dofs"], steps=steps, step_us=min(times), step_us_all=times,
                setup_s=summary["timing"]["setup"], memory_mb=usage["memory_mb"], impacts=len(summary["impacts"]),
                pairs_struck=len({impact["pair"] for impact in summary["impacts"]}), impulses_a_step=len(summary["impacts"]) / summary["steps"],
                iterations=summary["newton_iterations"] / summary["steps"], factorizations=summary["factorizations"])


def opensees_row(opensees, columns, stories, quick):
    steps = QUICK_STEPS if quick else OPENSEES_STEPS[stories]
    progress("%s, %d stories: OpenSees" % (columns, stories))
    data, usage = opensees.run(columns, DT, steps * DT, ["--stories", stories, "--ratio", RATIO, "--gaps", *GAPS, "--repeat", 2])
    return dict(program="OpenSees", version=data["version"], stories=stories, dofs=data["equations"], steps=steps,
                step_us=data["step_us"], step_us_all=data["step_us_all"], memory_mb=usage["memory_mb"],
                parted_steps=data["parted_steps"])


def text_of(columns, rows):
    own = {row["stories"]: row for row in rows if row["program"] == "nsframe"}
    other = {row["stories"]: row for row in rows if row["program"] == "OpenSees"}
    two, far, split_far, together = ({row["stories"]: row["step_us"] for row in rows if row["program"] == name}
                           for name in ("nsframe, two threads", "nsframe, far", "event-split, far", "nsframe, pressed"))
    carrying = {row["stories"]: row["impulses_a_step"] for row in rows if row["program"] == "nsframe, pressed"}
    reference = own.get(8)
    lines = []
    smaller = None
    for stories, row in own.items():
        peer = other.get(stories)
        per_dof = row["step_us"] / row["dofs"]
        more = 1e3 * (row["memory_mb"] - smaller["memory_mb"]) / (row["dofs"] - smaller["dofs"]) if smaller else None
        smaller = row
        relative = per_dof / (reference["step_us"] / reference["dofs"]) if reference else None
        lines.append(["%d" % stories, "%d" % row["dofs"], number(row["step_us"]), number(1e3 * per_dof), number(relative),
                      number(row["setup_s"]), number(row["memory_mb"]), number(more), "%d" % row["impacts"], "%d" % row["pairs_struck"],
                      number(row["iterations"]), number(two[stories]), number(far[stories]), number(together[stories]), number(carrying[stories]), number(split_far[stories]),
                      number(peer["step_us"] if peer else None), number(peer["step_us"] / row["step_us"] if peer else None),
                      number(peer["memory_mb"] if peer else None)])
    head = ["stories", "DOFs", "µs a step", "ns a DOF", "to 8 stories", "setup, s", "memory, MB", "kB a DOF more", "impacts",
            "pairs struck", "iterations", "two threads, µs", "far, µs", "pressed, µs", "pairs that carry", "event-split, far, µs", "OpenSees, µs", "OpenSees / it", "its memory, MB"]
    return "## %s\n\n%s" % (TITLES[columns], table(head, lines))


def main():
    parser = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0]))
    parser.add_argument("--columns", choices=TITLES, nargs="+", default=list(TITLES))
    parser.add_argument("--stories", type=int, choices=STORIES, nargs="+", default=list(STORIES))
    peer_arguments(parser)
    options = parser.parse_args()
    nsframe = Nsframe(options.program)
    python, reason = peer_python(options)
    opensees = Opensees(python) if python else None
    data = dict(machine=machine(), opensees=reason or "run", cases={})
    parts = []
    with tempfile.TemporaryDirectory() as folder:
        runs = {**RUNS_OF, "nsframe, pressed": pressed(folder)}
        for columns in options.columns:
            rows = []
            for stories in options.stories[:1] if options.quick else options.stories:
                rows += [nsframe_row(nsframe, columns, stories, options.quick, name, scheme) for name, scheme in runs.items()]
                if opensees:
                    rows.append(opensees_row(opensees, columns, stories, options.quick))
            data["cases"][columns] = rows
            parts.append(text_of(columns, rows))
    write_compared(options, "scaling", "Cost of a step against size",
                   "Least of several runs on one core but where two threads are named; dt = 1 ms, El Centro 0.30 g from its start.",
                   "modalDampingQ of six modes, BandSPD, KrylovNewton, Newmark 1/2, 1/4, penalty 1e8 N/m", reason, parts, data)


if __name__ == "__main__":
    run_bench(main)
