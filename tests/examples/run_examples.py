#!/usr/bin/env python3
"""Runs one example through the built program and compares summary.json with the example's expected.json.

    run_examples.py PROGRAM EXAMPLE_FOLDER [--without-frames]     exit code 1 and one line a difference
    run_examples.py --self-test

An entry of expected.json names a number by its path in the summary, e.g. "poundings/0/t", "poundings/count" or
"peaks/left.25/displacement/0": of a list, an element is chosen by its index or by what it is of (a node, or
structure.mode, a name). With "command": "calibrate" the scene is calibrated, the numbers are those of calibration.json, and the scene that
was written must have the fitted frequencies, as `nsframe modes` finds them. Paths below "closed_form" are checked by tests/examples/closed_form_test.cpp. With frames, frames.pvd must
list files that exist, at times that rise over the whole run.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree


def name_of(element):
    if "node" in element:
        return element["node"]
    if "stage" in element:
        return element["stage"]
    if "name" in element:
        return element["name"]
    if "story" in element:
        return f"{element['structure']}.{element['story']}"
    return f"{element.get('structure')}.{element.get('mode')}"


def find(summary, path):
    """The number at the path. Raises KeyError with the part that is not there."""
    here = summary
    for part in path.split("/"):
        if isinstance(here, dict) and part in here:
            here = here[part]
        elif isinstance(here, list) and part == "count":
            here = len(here)
        elif isinstance(here, list) and part.isdigit() and int(part) < len(here):
            here = here[int(part)]
        elif isinstance(here, list) and any(isinstance(e, dict) and name_of(e) == part for e in here):
            here = next(e for e in here if isinstance(e, dict) and name_of(e) == part)
        else:
            raise KeyError(f"the summary has no '{path}' (at '{part}')")
    return here


def differences(summary, expected):
    """One sentence for each number that is not within its tolerance."""
    found = []
    for entry in expected["numbers"]:
        if entry["path"].startswith("closed_form/"):
            continue
        try:
            value = find(summary, entry["path"])
        except KeyError as problem:
            found.append(str(problem.args[0]))
            continue
        if not isinstance(value, (int, float)) or not math.isfinite(value) or \
                abs(value - entry["value"]) > entry["tolerance"]:
            found.append(f"{entry['what']} ({entry['path']}) is {value!r}, expected {entry['value']} "
                         f"within {entry['tolerance']}")
    return found


def frame_faults(folder, end_time):
    """What is wrong with frames.pvd and the files it lists."""
    listed = xml.etree.ElementTree.parse(folder / "frames.pvd").getroot().findall("./Collection/DataSet")
    if not listed:
        return ["frames.pvd lists no frame"]
    faults = [f"frames.pvd lists '{frame.get('file')}', which does not exist or is empty" for frame in listed
              if not (folder / frame.get("file")).is_file() or (folder / frame.get("file")).stat().st_size == 0]
    times = [float(frame.get("timestep")) for frame in listed]
    if any(a >= b for a, b in zip(times, times[1:])):
        faults.append("the times in frames.pvd do not rise")
    if len(times) > 1 and times[-1] < end_time - 1.5 * (times[1] - times[0]):
        faults.append(f"the last frame is at {times[-1]} s of {end_time} s")
    return faults


def run(program, example, with_frames):
    expected = json.loads((example / "expected.json").read_text())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        command = [program, "run", str(example / "scene.toml"), "-q", "-o", str(folder)]
        command += [] if with_frames else ["--set", "output.frames=0"]
        ended = subprocess.run(command, capture_output=True, text=True)
        if ended.returncode != 0:
            return [f"{' '.join(command)} ended with {ended.returncode}: {ended.stderr.strip()}"]
        if ended.stdout or ended.stderr:
            return [f"a quiet run printed: {(ended.stdout + ended.stderr).strip()}"]
        summary = json.loads((folder / "summary.json").read_text())
        faults = differences(summary, expected)
        faults += [f"{file} is missing" for file in ("results.h5", "scene.toml") if not (folder / file).is_file()]
        return faults + (frame_faults(folder, summary["end_time"]) if with_frames else [])


def calibrate(program, example):
    expected = json.loads((example / "expected.json").read_text())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        command = [program, "calibrate", str(example / expected["scene"]), "-q", "-o", str(folder)]
        ended = subprocess.run(command, capture_output=True, text=True)
        if ended.returncode != 0 or ended.stdout or ended.stderr:
            return [f"{' '.join(command)} ended with {ended.returncode}: {(ended.stdout + ended.stderr).strip()}"]
        result = json.loads((folder / "calibration.json").read_text())
        modes = subprocess.run([program, "modes", str(folder / "scene.toml"), "--json"], capture_output=True, text=True)
        if modes.returncode != 0:
            return [f"the calibrated scene cannot be read: {modes.stderr.strip()}"]
        return differences(result, expected) + mode_differences(json.loads(modes.stdout), result["frequencies"])


def mode_differences(modes, fitted):
    """Where the modes of a scene are not those that the calibration says of it."""
    found = {(mode["structure"], mode["mode"]): mode["frequency"] for mode in modes}
    return [f"{f['structure']}.{f['mode']} of the calibrated scene is {found.get((f['structure'], f['mode']))} Hz, not {f['fitted']} Hz"
            for f in fitted if abs(found.get((f["structure"], f["mode"]), 0) - f["fitted"]) > 1e-8 * f["fitted"]]


def self_test():
    summary = {"poundings": [{"t": 2.5}], "peaks": [{"node": "a.1", "displacement": [0.1, 0, 0]}],
               "drifts": [{"structure": "a", "story": 1, "drift": [0.01, 0]}],
               "parameters": [{"name": "beam", "fitted": 2}],
               "numerical_damping": [{"structure": "a", "mode": "L1", "asked": 0.005}]}

    def count(path, value, tolerance):
        return len(differences(summary, {"numbers": [{"what": "it", "path": path, "value": value,
                                                      "tolerance": tolerance}]}))

    assert count("poundings/count", 1, 0) == 0
    assert count("poundings/0/t", 2.501, 0.002) == 0
    assert count("poundings/0/t", 2.51, 0.002) == 1
    assert count("poundings/1/t", 2.5, 1) == 1
    assert count("peaks/a.1/displacement/0", 0.1, 0) == 0
    assert count("peaks/a.2/displacement/0", 0.1, 0) == 1
    assert count("drifts/a.1/drift/0", 0.01, 0) == 0
    assert count("numerical_damping/a.L1/asked", 0.005, 0) == 0
    assert count("closed_form/largest_error", 1, 0) == 0
    assert count("parameters/beam/fitted", 2, 0) == 0
    assert mode_differences([{"structure": "a", "mode": "L1", "frequency": 2}], [{"structure": "a", "mode": "L1", "fitted": 2}]) == []
    assert len(mode_differences([{"structure": "a", "mode": "L1", "frequency": 2}], [{"structure": "a", "mode": "L1", "fitted": 2.1}])) == 1
    assert len(mode_differences([], [{"structure": "a", "mode": "L1", "fitted": 2}])) == 1
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if len(arguments) not in (2, 3) or arguments[2:] not in ([], ["--without-frames"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    example = pathlib.Path(arguments[1])
    calibrated = json.loads((example / "expected.json").read_text()).get("command") == "calibrate"
    faults = calibrate(arguments[0], example) if calibrated else run(arguments[0], example, len(arguments) == 2)
    for fault in faults:
        print(f"{pathlib.Path(arguments[1]).name}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
