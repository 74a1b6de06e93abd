"""nsframe motion and nsframe spectrum as a user runs them: values, files, exit codes.

usage: motion_test.py PROGRAM SOURCE_DIR
"""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = sys.argv[1:]
RECORD = os.path.join(SOURCE, "examples/motions/el_centro_1940_ns.at2")
SAMPLES = os.path.join(SOURCE, "tests/motion/samples")
G = 9.80665


def nsframe(*arguments, code=0):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)
    require(done.returncode == code, "%s: exit code %d, not %d\n%s%s" % (arguments, done.returncode, code, done.stdout, done.stderr))
    return done.stdout if code == 0 else done.stderr


def require(condition, what):
    if not condition:
        sys.exit("failed: %s" % what)


def near(found, wanted, relative, what):
    require(abs(found / wanted - 1) <= relative, "%s: %.8g, not %.8g" % (what, found, wanted))


def info(file, *options):
    return json.loads(nsframe("motion", "info", file, "--json", *options))[0]


with tempfile.TemporaryDirectory() as folder:
    def out(name):
        return os.path.join(folder, name)

    shipped = info(RECORD)
    near(shipped["pga"], 0.3188 * G, 2e-4, "PGA")
    near(shipped["pga_time"], 2.04, 1e-9, "time of PGA")
    near(shipped["pgv"], 0.361, 2e-3, "PGV, the records' README")
    require(shipped["samples"] == 1560 and shipped["dt"] == 0.02 and shipped["format"] == "at2", "AT2")
    # by the trapezium of squares, which differs by the curvature of a^2 over a step
    values = [G * float(word) for line in open(RECORD).read().splitlines()[4:] for word in line.split()]
    squares = [0.02 * (a * a + a * b + b * b) / 3 for a, b in zip(values, values[1:])]
    near(shipped["arias"], math.pi / 2 / G * sum(squares), 1e-12, "Arias intensity")
    require(23 < shipped["d5_95"] < 25 and 5 < shipped["d5_75"] < 20, "durations of El Centro: %s" % shipped)
    require("PGA" in nsframe("motion", "info", RECORD), "text")

    for sample in ("el_centro.V2", "el_centro.esm.asc", "el_centro.csv", "el_centro.NS"):
        near(info(os.path.join(SAMPLES, sample))["pga"], 0.3188 * G, 6e-3, sample)
    message = nsframe("motion", "info", os.path.join(SAMPLES, "el_centro.txt"), code=2)
    require("--dt on the command line" in message, message)
    near(info(os.path.join(SAMPLES, "el_centro.txt"), "--dt", "20 ms")["pga"], 0.3188 * G, 2e-4, "one column")
    message = nsframe("motion", "info", os.path.join(SAMPLES, "el_centro.V2c"), code=2)
    require("--channel" in message and "el_centro.V2c:" in message, message)
    near(info(os.path.join(SAMPLES, "el_centro.V2c"), "--channel", "2")["pga"], 0.1594 * G, 3e-4, "second channel")
    require("error" in nsframe("motion", "info", "/nowhere/x.at2", code=4), "missing file")
    require("--unit" in nsframe("motion", "info", RECORD, "--unit", "m/s", code=2), "unknown unit")

    nsframe("motion", "scale", RECORD, "--pga", "0.3 g", "-o", out("s.at2"))
    near(info(out("s.at2"))["pga"], 0.3 * G, 1e-7, "scaled PGA")
    nsframe("motion", "scale", RECORD, "--factor", "-2", "-o", out("s.csv"))
    near(info(out("s.csv"))["pgd"], 2 * shipped["pgd"], 1e-6, "scaled PGD")
    target = ("--target", "eurocode8", "--ground", "B", "--ag", "0.25 g")
    nsframe("motion", "scale", RECORD, *target, "--over", "0.1,1", "-o", out("t.at2"))
    ratios = []
    for row in json.loads(nsframe("spectrum", out("t.at2"), "--periods", "0.1,1", "--count", "200", "--json"))["spectra"]:
        for period, psa in zip([0.1 * 10 ** (i / 199) for i in range(200)], row["psa"]):
            s = 0.25 * G * 1.2
            wanted = s * (1 + period / 0.15 * 1.5) if period <= 0.15 else 2.5 * s * min(1, 0.5 / period)
            ratios.append(math.log(psa / wanted))
    require(abs(sum(ratios) / len(ratios)) < 1e-6, "mean ratio to the target: %g" % (sum(ratios) / len(ratios)))
    require("one of --pga" in nsframe("motion", "scale", RECORD, "-o", out("x.at2"), code=2), "nothing to scale to")
    require("--over" in nsframe("motion", "scale", RECORD, *target, "-o", out("x.at2"), code=2), "no range")
    require(".at2 or .csv" in nsframe("motion", "convert", RECORD, "-o", out("x.dat"), code=2), "unknown output")
    require("did you mean eurocode8" in nsframe("motion", "scale", RECORD, "--target", "eurocode", "--over", "0.1,1", "-o", out("x.at2"), code=2), "nearest target")

    require("--target" in nsframe("motion", "scale", RECORD, "--pga", "0.3 g", "--over", "0.1,1", "-o", out("x.at2"), code=2), "a range without a target")
    require("does not belong" in nsframe("motion", "scale", RECORD, *target, "--sds", "1 g", "--over", "0.1,1", "-o", out("x.at2"), code=2), "of ASCE 7")
    require("--angle" in nsframe("motion", "rotate", RECORD, RECORD, "--angle", "3 m", "-o", out("x.at2"), code=2), "no angle")
    nsframe("motion", "baseline", RECORD, "--degree", "2", "--rest", "-o", out("b.csv"))
    based = info(out("b.csv"))
    require(abs(based["final_velocity"]) < 1e-7 and abs(based["final_displacement"]) < 1e-6, "at rest: %s" % based)
    nsframe("motion", "filter", RECORD, "--from", "0.1 Hz", "--to", "20 Hz", "-o", out("f.at2"))
    near(info(out("f.at2"))["pga"], shipped["pga"], 0.05, "filtered PGA")
    require(info(out("f.at2"))["samples"] == 1560, "length")
    nsframe("motion", "filter", RECORD, "--from", "0.1 Hz", "--keep-pads", "-o", out("p.at2"))
    require(info(out("p.at2"))["samples"] == 1560 + 2 * 3000, "pads of 1.5 * 4 / 0.1 Hz")
    require("half the sampling" in nsframe("motion", "filter", RECORD, "--to", "30 Hz", "-o", out("x.at2"), code=2), "Nyquist")
    nsframe("motion", "rotate", RECORD, out("s.csv"), "--angle", "90", "-o", out("r.at2"))
    near(info(out("r.at2"))["pga"], 2 * shipped["pga"], 1e-6, "rotated")
    nsframe("motion", "plot", RECORD, "-o", out("m.svg"))
    require(open(out("m.svg")).read().count("<polyline") == 3, "three panels")

    make = ("motion", "artificial", "--target", "eurocode8", "--ag", "0.2 g", "--period", "0.4 s", "--seed", "4")
    said = nsframe(*make, "-o", out("a.at2"))
    require("within" in said, said)
    for period, psa in zip(*(lambda s: (s["period"], s["spectra"][0]["psa"]))(json.loads(
            nsframe("spectrum", out("a.at2"), "--periods", "0.08,0.8", "--count", "97", "--json")))):
        s = 0.2 * G
        wanted = s * (1 + period / 0.15 * 1.5) if period <= 0.15 else 2.5 * s * min(1, 0.4 / period)
        near(psa, wanted, 0.1, "artificial at %g s" % period)
    nsframe(*make, "-o", out("again.at2"))
    require(open(out("a.at2")).read() == open(out("again.at2")).read(), "the seed decides")
    require("one of --period" in nsframe("motion", "artificial", *target, "-o", out("x.at2"), code=2), "no range")

    # Chopra, section 6.4 [in], which cuts the last digit; and both ways to give two of them
    for damping, printed in (("2 %", {0.5: 2.67, 1: 5.97, 2: 7.47}), ("0", {2: 9.91}), ("0.05", {2: 5.37})):
        s = json.loads(nsframe("spectrum", RECORD, "--damping", damping, "--at", ",".join(map(str, printed)), "--at-samples", "--json"))
        for period, sd, psa in zip(s["period"], s["spectra"][0]["sd"], s["spectra"][0]["psa"]):
            # the book has g = 386.4 in/s2
            require(abs(sd / 0.0254 * 386.4 / 386.0886 - printed[period]) < 0.0101, "SD at %g s, %s: %g" % (period, damping, sd / 0.0254))
            near(psa, (2 * math.pi / period) ** 2 * sd, 1e-12, "PSA")
    nsframe("spectrum", RECORD, out("s.csv"), *target, "-o", out("two"))
    with open(out("two/spectrum.csv")) as file:
        rows = list(csv.DictReader(file))
    require(len(rows) == 200, "200 periods")
    for row in rows:  # both components are one motion: its direction is at atan(-2)
        near(float(row["RotD100 SD [m]"]), math.sqrt(5) * float(row["1 SD [m]"]), 1e-3, "RotD100")
    svg = open(out("two/spectrum.svg")).read()
    require(svg.count("<polyline") == 5 and "Eurocode 8" in svg and "stroke-dasharray" in svg, "plot with its target")
    require("give -o" in nsframe("spectrum", RECORD, *target, code=2), "a target without a plot")

    # floor spectra of a run
    nsframe("run", os.path.join(SOURCE, "examples/pull_back/scene.toml"), "--set", 'output.floor_spectra={nodes=["floors"],periods=["0.1 s","0.2 s"]}',
            "-o", out("run"), "-q")
    floors = json.loads(nsframe("spectrum", out("run"), "--floor", "all", "--json"))
    require(len(floors["spectra"]) >= 2 and floors["period"] == [0.1, 0.2] and min(f["sd"][0] for f in floors["spectra"]) > 0, "floors: %s" % floors)
    summary = json.load(open(out("run/summary.json")))["floor_spectra"]
    near(max(max(f["psa"]) for f in floors["spectra"]), max(s["psa"] for s in summary), 1e-9, "PSA of the summary")
    require("no floor spectrum" in nsframe("spectrum", out("run"), "--floor", "nothing", code=2), "unknown floor")
    require("--at" in nsframe("spectrum", out("run"), "--floor", "all", "--at", "0.3", code=2), "options of records")
    require("folder of results" in nsframe("spectrum", folder, "--floor", "all", code=4), "no results")
print("ok")
