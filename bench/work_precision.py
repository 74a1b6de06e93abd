"""Error against CPU time: nsframe, and OpenSees and Siconos in the same go where they can be imported.

    python3 bench/work_precision.py                     (with the python that has openseespy; Siconos by /usr/bin/python3)
    python3 bench/work_precision.py --cases ball elastic    (the other cases stay as they are in the results)

Writes bench/results/work_precision.md and .json, and .svg and .png where matplotlib can be imported; else standard library only.
Each peer runs at the settings that are best for it, found by trying (precision_opensees.py, precision_siconos.py). What the numbers
mean: bench/README.md.
"""
import argparse
import json
import os
import tempfile

import precision_opensees
import precision_siconos
from harness import BenchError, Nsframe, arguments, machine, peer_arguments, peer_python, progress, run_bench, write_files
from pair import moreau_jean
from precision_cases import EXACT, INTERVAL, NAMES, STEPS, cases, reference_of, run_nsframe, settings_of
from precision_report import HALF, PAPER, case_text, compared, draw, verdicts
from precision_runs import error_of, reason

LONG = 2.0    # [s] of CPU, beyond which a run isn't repeated
ENOUGH = 0.5  # [s] for which short runs are repeated, or thrice as often as others
EXPONENTIAL = {"analysis.scheme": "exponential"}
SETTINGS = ([("exact", EXACT, dt) for dt in STEPS[:4]] + [("exponential", EXPONENTIAL, dt) for dt in STEPS]
            + [("exponential, accuracy %s" % a, {**EXPONENTIAL, "analysis.accuracy": a}, 5e-3) for a in ("1e-2", "5e-3", "2e-3", "1e-3", "1e-4")]
            + [(name, scheme, dt) for name, scheme in ((HALF, moreau_jean(0.5, 0.5)), (PAPER, moreau_jean(1.0, 1.5))) for dt in STEPS])
PAIR_SETTINGS = [("exact, modes up to 10 Hz", {**EXACT, "analysis.highest_frequency": "10 Hz"}, 2e-2),
                 ("exact, modes up to 20 Hz", {**EXACT, "analysis.highest_frequency": "20 Hz"}, 1e-2),
                 *(("exponential, modes up to %s" % f, {**EXPONENTIAL, "analysis.highest_frequency": f}, dt)
                   for f, dt in (("10 Hz", 2e-2), ("10 Hz", 1e-2), ("60 Hz", 1e-2)))]
GOAL = {"elastic": 0.01, "fiber": 0.01}  # part of a peer's time; elsewhere 1


def nsframe_rows(nsframe, case, reference, options):
    rows, end = [], case.end(options)
    for name, scheme, dt in SETTINGS + (PAIR_SETTINGS if case.columns else []):
        if (name.startswith("exact") and not case.linear) or (options.quick and dt != 5e-3):
            continue
        progress("nsframe, %s, dt = %g ms" % (name, 1e3 * dt))
        row = dict(program="nsframe", series=name.split(",")[0] if "accuracy" in name else name, setting=name, dt=dt)
        if name.startswith("moreau-jean"):
            row["setting"], scheme = name + case.moreau_jean_text, {**scheme, **case.moreau_jean}
        rows.append(row)
        try:
            summary, time, history = run_nsframe(nsframe, case, scheme, dt, end)
            row["error_m"] = error_of(reference, dt, time, history)
            times = nsframe.loop_seconds(case.scene, settings_of(case, scheme, dt, end), options.runs, 0 if options.quick else ENOUGH)
        except BenchError as problem:
            row["failed"] = reason(problem)
            continue
        row.update(cpu_s=min(times), runs=len(times), impacts=len(summary["impacts"]))
    return rows


def measured(name, case, nsframe, peers, options):
    """One case: rows of every program, what was tried, and how they compare."""
    progress(case.title)
    reference = reference_of(case, nsframe, case.end(options))
    rows, tried, versions = nsframe_rows(nsframe, case, reference, options), {}, {}
    if peers["OpenSees"]:
        run = precision_opensees.chain if case.chain else precision_opensees.pair
        found, tried["OpenSees"], versions["OpenSees"] = run(peers["OpenSees"], case, reference, options)
        rows += found
    if peers["Siconos"] and case.linear:
        found, tried["Siconos"], versions["Siconos"] = precision_siconos.rows(peers["Siconos"], case, nsframe, reference, options)
        rows += found
    return dict(title=case.title, measured=machine(), versions=versions, duration=case.end(options), goal=GOAL.get(name, 1),
                reference=reference[0], own_error_m=reference[1], rows=rows, tried=tried, compared=compared(rows))


def main():
    parser = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0]))
    parser.add_argument("--cases", choices=NAMES, nargs="+", default=list(NAMES))
    parser.add_argument("--runs", type=int, default=3, help="of which the least time counts, where one takes less than %g s" % LONG)
    peer_arguments(parser)
    parser.add_argument("--siconos-python", metavar="P", default="/usr/bin/python3",
                        help="interpreter that has siconos (default: %(default)s)")
    parser.add_argument("--no-siconos", action="store_true")
    options = parser.parse_args()
    options.runs, options.long = 1 if options.quick else options.runs, LONG
    nsframe, peers, missing = Nsframe(options.program), {}, {}
    peers["OpenSees"], missing["OpenSees"] = peer_python(options)
    peers["Siconos"], missing["Siconos"] = precision_siconos.interpreter(options)
    data = dict(cases={} if options.quick else earlier(options.results))
    with tempfile.TemporaryDirectory() as folder:
        every = cases(folder)
        for name in options.cases:
            data["cases"][name] = measured(name, every[name], nsframe, peers, options)
            data["cases"] = {known: data["cases"][known] for known in NAMES if known in data["cases"]}
            tables(options, data, missing)
    print(tables(options, data, missing))


def earlier(folder):
    """The cases that the results have: those that aren't measured now stay."""
    try:
        with open(os.path.join(folder, "work_precision.json"), encoding="utf-8") as file:
            return json.load(file)["cases"]
    except (OSError, ValueError, KeyError):
        return {}


def tables(options, data, missing):
    """Writes what there is, after every case, so that an interrupted run leaves the others; the text."""
    os.makedirs(options.results, exist_ok=True)
    programs = sorted({"%s %s" % pair for case in data["cases"].values() for pair in case["versions"].items()})
    programs += ["no rows of %s: %s" % (name, why) for name, why in missing.items() if why]
    text = ("# Error against CPU time\n\nTime of the step loop, least of %d runs or more. Error: largest of a watched displacement at any\n"
            "multiple of %g ms that ends a step. %s.\n\n%s\n\n%s" % (
                options.runs, 1e3 * INTERVAL, "; ".join(programs), draw(options.results, data), verdicts(data)))
    text += "\n".join(case_text(case) for case in data["cases"].values())
    write_files(options.results, "work_precision", text, data)
    return text


if __name__ == "__main__":
    run_bench(main)
