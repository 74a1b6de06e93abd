"""nsframe study on the pull-back pair: errors known from theta-scheme prototypes, files, refusals.

usage: study_test.py PROGRAM SOURCE_DIR
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = sys.argv[1:]
SCENE = os.path.join(SOURCE, "examples", "pull_back", "scene.toml")

# Largest displacement error [m] against the closed form and impacts found of 3, gamma = 1/2; two digits are known
KNOWN = {("1e-2", "0.5"): (7.4e-3, None), ("5e-3", "0.5"): (3.0e-3, None), ("1e-3", "0.5"): (8.0e-4, None),
         ("1e-2", "1"): (1.6e-2, 0), ("5e-3", "1"): (1.8e-2, 1), ("1e-3", "1"): (1.28e-2, 2), ("1e-4", "1"): (1.27e-3, 3)}


def study(*options, scene=SCENE):
    return subprocess.run([PROGRAM, "study", scene, *options], capture_output=True, text=True)


def require(condition, what):
    if not condition:
        sys.exit("failed: %s" % what)


with tempfile.TemporaryDirectory() as folder:
    done = study("--vary", "dt=1e-2,5e-3,1e-3,1e-4,theta=0.5,1", "--set", "analysis.gamma=0.5", "--set", "analysis.scheme=moreau-jean",
                 "-o", folder)
    require(done.returncode == 0, done.stderr)
    with open(os.path.join(folder, "study.json")) as file:
        result = json.load(file)
    reference = result["references"][0]
    require(reference["scheme"] == "exact" and reference["own_error"] < 1e-12, "reference %s" % reference)
    rows = {(run["settings"]["analysis.dt"], run["settings"]["analysis.theta"]): run for run in result["runs"]}
    for key, (error, impacts) in KNOWN.items():
        require(abs(rows[key]["error"] / error - 1) < 0.05, "%s: error %g, known %g" % (key, rows[key]["error"], error))
        require(impacts is None or rows[key]["impacts"] == impacts, "%s: %d impacts" % (key, rows[key]["impacts"]))
    require(rows["1e-3", "1"]["poundings_missed"] == 1, "one pounding is missed")
    with open(os.path.join(folder, "study.csv")) as file:
        lines = list(csv.DictReader(file))
    require(len(lines) == 8 and abs(float(lines[0]["error_m"]) / rows["1e-2", "0.5"]["error"] - 1) < 1e-8, "CSV")
    with open(os.path.join(folder, "study.svg")) as file:
        svg = file.read()
    require(svg.count("<polyline") == 2 and "largest displacement error, m" in svg, "diagram")

with tempfile.TemporaryDirectory() as folder:  # e changes the physics: two references
    done = study("--vary", "restitution=0.6,0.3", "-o", folder)
    require(done.returncode == 0, done.stderr)
    with open(os.path.join(folder, "study.json")) as file:
        result = json.load(file)
    require([r["physics"] for r in result["references"]] == [["contact.restitution=0.6"], ["contact.restitution=0.3"]], "references")

with tempfile.TemporaryDirectory() as folder:  # a reference has steps of its own, not the scene's accuracy
    done = study("--vary", "analysis.accuracy=1e-2,1e-4,dt=1e-3", "--set", "analysis.duration=3", "-o", folder,
                 scene=os.path.join(SOURCE, "examples", "accuracy", "scene.toml"))
    require(done.returncode == 0, done.stderr)
    with open(os.path.join(folder, "study.json")) as file:
        result = json.load(file)
    peak = result["references"][0]["peak"]
    require(result["references"][0]["own_error"] < 1e-4 * peak, "reference %s" % result["references"][0])
    for run in result["runs"]:
        require(run["error"] < float(run["settings"]["analysis.accuracy"]) * peak, "accuracy %s" % run)
    require(result["runs"][1]["error"] < 0.1 * result["runs"][0]["error"], "a smaller accuracy is more exact")

for vary, text in (("dy=1e-3", "did you mean 'dt'"), ("analysis.tehta=1", "did you mean 'theta'"), ("1e-3", "key=value"),
                   ("scheme=exat", "did you mean 'exact'"), ("dt=1e-3,dt=1e-4", "given twice"), ("dt=1e-3,", "empty value"),
                   ("dt=1e-3,7.77777e-4", "share no times")):
    done = study("--vary", vary)
    require(done.returncode == 2 and text in done.stderr, "--vary %s: %d, %s" % (vary, done.returncode, done.stderr))
