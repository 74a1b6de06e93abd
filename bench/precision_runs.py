"""What work_precision.py does with runs, whatever program made them: errors, who failed, which are worth showing.

A run is a dict: its settings, then cpu_s and error_m, or `failed` with the reason. Standard library only.
"""
import json
import os
import tempfile

from harness import BENCH, BenchError, measure
from pair import largest_difference

SAME = 1.1   # errors up to this factor apart are the same: settings of the linear algebra only should not change more
SLACK = 1.5  # of single timings, when a run is dropped because others are faster and more accurate
DIVERGED = 1e3  # [m]
MOST = 10    # runs of a program and case that are timed again


def error_of(reference, dt, time, history):
    """Largest displacement error at the reference's times that are ends of steps (dt None: all) [m]; a history may lack the start."""
    _, _, times, known = reference
    if not history or not time:
        raise BenchError("no history")
    kept = [i for i, t in enumerate(times) if t >= time[0] - 1e-9 and (dt is None or abs(t / dt - round(t / dt)) < 1e-6)]
    error, shared = largest_difference([times[i] for i in kept], [[values[i] for i in kept] for values in known], time, history)
    if shared != len(kept):
        raise BenchError("a history has %d of %d times of the reference" % (shared, len(kept)))
    if not error < DIVERGED:
        raise BenchError("diverged")
    return error


def reason(problem):
    """What a program printed first as it failed, in short."""
    lines = [line.strip() for line in str(problem).splitlines() if line.strip()]
    after = next((i for i, line in enumerate(lines) if line.startswith("ended with exit code")), -1)
    return (lines[after + 1] if after + 1 < len(lines) else lines[after].rstrip(":"))[:120]


def ask(python, script, data):
    """Runs one of the peers' scripts: JSON in, JSON out."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = os.path.join(folder, "case.json"), os.path.join(folder, "result.json")
        with open(source, "w") as file:
            json.dump(data, file)
        measure([python, os.path.join(BENCH, script), source, target])
        with open(target) as file:
            return json.load(file)


def judged(runs, reference, exact=None):
    """The same runs with their errors, without their histories; `exact`: for those with steps from another start."""
    result = []
    for run in runs:
        run = dict(run)
        time, history = run.pop("time", None), run.pop("history", None)
        if "failed" not in run:
            try:
                # after a shorter first step no time is a multiple of the step: all that was kept counts
                known, dt = ((None, None, time, exact(time)), None) if run.get("offset") else (reference, run["dt"])
                run["error_m"] = error_of(known, dt, time, history)
            except BenchError as problem:
                run["failed"] = str(problem)
        result.append(run)
    return result


def done(runs):
    return [run for run in runs if "failed" not in run]


def front(runs, slack=1.0):
    """Runs that no other beats in both time (by more than the factor `slack`) and error, in the order of time."""
    return [run for run in sorted(done(runs), key=lambda run: run["cpu_s"])
            if not any(other["error_m"] < run["error_m"] and other["cpu_s"] * slack < run["cpu_s"]
                       or other["error_m"] == run["error_m"] and other["cpu_s"] < run["cpu_s"] for other in done(runs))]


def candidates(runs):
    """Those worth timing again; of too many, spread from the fastest to the most accurate."""
    found = front(runs, SLACK)
    if len(found) <= MOST:
        return found
    pure = front(runs)
    if len(pure) <= MOST:
        return pure
    return [pure[round(k * (len(pure) - 1) / (MOST - 1))] for k in range(MOST)]


def fastest(run, start, choices):
    """Tries one choice after the other, keeping the fastest value of each: (settings, every run made).

    `run` makes a run of settings; `choices`: pairs of a key and its values. What it does to the error beyond SAME rules a value out.
    """
    best = run(start)
    tried = [best]
    for key, values in choices:
        for value in values:
            if value == start[key]:
                continue
            other = run({**start, key: value})
            tried.append(other)
            if "failed" in other:
                continue
            if "failed" in best or (other["error_m"] <= SAME * best["error_m"] and other["cpu_s"] < best["cpu_s"]):
                best = other
        start = {**start, key: best[key]}
    return start, tried


def timed_again(before, after):
    """Each run again with the settings found fastest, or as it was where these made it fail or less accurate."""
    return [new if "failed" not in new and new["error_m"] <= SAME * old["error_m"] else old for old, new in zip(before, after)]


def nearest(runs, dt):
    return min(runs, key=lambda run: abs(run["dt"] - dt))
