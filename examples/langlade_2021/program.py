"""Runs nsframe on the scenes of this folder and reads its summaries. Standard library only.

Counting: a run lists impacts; `summary.json` merges impacts of one pair of corners that are closer than 20 ms into poundings.
A pounding of the buildings merges those of all pairs that are closer than 20 ms: what one looking at the two buildings, or at
an accelerometer on one of them, counts.
"""
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
WINDOW = 0.020  # [s]
BARE = {"output.history": "[]", "output.floor_spectra": "none", "output.checkpoint": 0}


class Failed(Exception):
    pass


def arguments(settings):
    return [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]


def command_text(scene, settings):
    """As a user types it in the root of the sources."""
    shown = " ".join(f"--set {key}='{value}'" if any(c in str(value) for c in ' []{}"') else f"--set {key}={value}"
                     for key, value in settings.items())
    return f"nsframe run examples/langlade_2021/{scene} {shown}".rstrip()


class Program:
    def __init__(self, path, processes=2):
        self.path, self.processes, self.runs = str(path), processes, 0

    def call(self, *command):
        done = subprocess.run([self.path, *command], capture_output=True, text=True)
        if done.returncode != 0:
            raise Failed(f"{self.path} {' '.join(command)} ended with {done.returncode}:\n{done.stderr.strip()}")
        return done.stdout

    def run(self, scene, settings, read=None):
        """The summary of a run; or, after read(folder, summary), what that returns."""
        self.runs += 1
        folder = tempfile.mkdtemp(prefix="langlade_2021_")
        try:
            self.call("run", str(FOLDER / scene), "-q", "-o", folder, *arguments({**BARE, **settings}))
            summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
            return read(folder, summary) if read else summary
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def run_all(self, jobs):
        """jobs: name -> (scene, settings[, read]); the results under the same names, `processes` runs at a time."""
        with concurrent.futures.ThreadPoolExecutor(self.processes) as pool:
            futures = {name: pool.submit(self.run, *job) for name, job in jobs.items()}
            try:
                return {name: future.result() for name, future in futures.items()}
            except BaseException:
                for future in futures.values():
                    future.cancel()
                raise

    def version(self):
        return self.call("--version").strip()

    def record(self, file):
        """Measures of a record and what its file says about itself."""
        found = json.loads(self.call("motion", "info", str(file), "--json"))[0]
        return {"file": os.path.basename(file), "description": " ".join(found["description"].split()), "dt": found["dt"],
                "samples": found["samples"], "pga_g": round(found["pga"] / 9.80665, 4), "pgv": round(found["pgv"], 4)}


def building_poundings(summary, window=WINDOW):
    """Poundings of the pairs merged over all pairs: a list of [begin, end] in s."""
    merged = []
    for pounding in sorted(summary["poundings"], key=lambda p: p["t"]):
        begin, end = pounding["t"], pounding["t"] + pounding["duration"]
        if merged and begin - merged[-1][1] < window:
            merged[-1][1] = max(end, merged[-1][1])
        else:
            merged.append([begin, end])
    return merged


def modes(summary):
    """structure -> mode -> frequency, damping asked and effective."""
    found = {}
    for mode in summary["numerical_damping"]:
        found.setdefault(mode["structure"], {})[mode["mode"]] = mode
    return found


def median(values):
    ordered = sorted(values)
    n = len(ordered)
    return None if n == 0 else 0.5 * (ordered[(n - 1) // 2] + ordered[n // 2])


def rounded(value, digits=5):
    return value if value is None else float(f"{value:.{digits}g}")


def outcome(summary, floors):
    """What the tables need of a run. floors: side -> node."""
    peaks = {peak["node"]: peak for peak in summary["peaks"]}
    poundings = summary["poundings"]
    merged = building_poundings(summary)
    energy = summary["energy"]
    return {
        "impacts": len(summary["impacts"]),
        "pairs": len(poundings),
        "buildings": len(merged),
        "buildings_100_ms": len(building_poundings(summary, 0.100)),
        "times": [round(begin, 4) for begin, end in merged],
        "first_approach": rounded(poundings[0]["approach_velocity"]) if poundings else None,
        "first_impulse": rounded(poundings[0]["impulse"]) if poundings else None,
        "impulse": rounded(sum(p["impulse"] for p in poundings)),
        "restitution": rounded(median([p["effective_restitution"] for p in poundings if p["approach_velocity"] > 0]), 3),
        "peak": {side: rounded(peaks[node]["displacement"][0]) for side, node in floors.items()},
        "twist": {side: rounded(peaks[node]["twist"]) for side, node in floors.items()},
        "energy": {key: rounded(energy[key]) for key in ("input", "damping", "contact", "numerical")},
    }
