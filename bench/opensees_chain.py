"""Masses, springs and one contact on a line in OpenSees, run as a process of its own by work_precision.py.

Contact is a penalty spring behind a gap: with a dashpot (ViscoelasticGap) or Jankowski's law. Needs openseespy, nothing
else. Units: N, m, s. Input and output are JSON: see work_precision.py.
"""
import json
import math
import os
import sys
import tempfile
import time

import openseespy.opensees as ops

from opensees_pair import version

GROUND, SPRING = 1, 2  # tag of the ground's node; first tag of nodes, and materials of springs


def contact(case, run):
    """The law in the gap; its damping returns the restitution, or `damping` (of critical), if the run gives one."""
    a, b, gap, e = case["contact"]
    m = case["masses"][b] if a is None else 1 / (1 / case["masses"][a] + 1 / case["masses"][b])
    k = run["penalty"]
    if run["law"] == "ViscoelasticGap":
        ratio = run.get("damping")
        if ratio is None:
            ratio = -math.log(e) / math.hypot(math.pi, math.log(e))
        ops.uniaxialMaterial("ViscoelasticGap", 1, k, 2 * ratio * math.sqrt(k * m), -gap)
    else:
        damping = 9 * math.sqrt(5) / 2 * (1 - e * e) / (e * (e * (9 * math.pi - 16) + 16))
        ops.uniaxialMaterial("JankowskiImpact", 1, k, damping, m, -gap, 1.5)
    ops.element("zeroLength", 1, GROUND if a is None else SPRING + a, SPRING + b, "-mat", 1, "-dir", 1)


def build(case, run):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(GROUND, 0.0)
    ops.fix(GROUND, 1)
    for i, m in enumerate(case["masses"]):
        ops.node(SPRING + i, 0.0)
        ops.mass(SPRING + i, m)
    force = list(case["load"])
    u, v = case["q0"], case["v0"]
    for tag, (i, j, k, c) in enumerate(case["springs"], SPRING):
        ops.uniaxialMaterial("Elastic", tag, k, c)
        ops.element("zeroLength", tag, GROUND if i is None else SPRING + i, SPRING + j, "-mat", tag, "-dir", 1)
        pull = k * (u[j] - (0 if i is None else u[i])) + c * (v[j] - (0 if i is None else v[i]))
        force[j] -= pull
        if i is not None:
            force[i] += pull
    contact(case, run)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for i, value in enumerate(case["load"]):
        ops.load(SPRING + i, value)
    ops.constraints("Plain")
    ops.numberer("Plain" if len(u) < 3 else "RCM")
    ops.system(run["system"])
    ops.test("NormDispIncr", run["tolerance"], 50)
    ops.algorithm(run["algorithm"])
    ops.integrator(*run["integrator"])
    ops.analysis("Transient")
    for i, m in enumerate(case["masses"]):
        ops.setNodeDisp(SPRING + i, 1, u[i], "-commit")
        ops.setNodeVel(SPRING + i, 1, v[i], "-commit")
        ops.setNodeAccel(SPRING + i, 1, force[i] / m, "-commit")


def march(dt, steps, start):
    """Steps of dt from `start`; one that OpenSees cannot close is taken in unequal parts, as its end may be an impact.

    Code, and how many steps were taken in parts.
    """
    parted, done = 0, 0
    while done < steps and ops.analyze(steps - done, dt) != 0:
        done, parted = round((ops.getTime() - start) / dt) + 1, parted + 1
        part = 0.37 * dt
        while (left := start + done * dt - ops.getTime()) > 1e-9 * dt:
            if ops.analyze(1, left if left < 1.5 * part else part) != 0:
                part *= 0.37
                if part < 1e-4 * dt:
                    return 1, parted
    return 0, parted


def execute(case, run, folder):
    """Runs `repeat` times; the first keeps the history."""
    steps, interval = round(case["duration"] / run["dt"]), case["interval"]
    first = run.get("offset", 0.0) * run["dt"]  # a shorter first step, so that impacts aren't at ends of steps
    path, cpu, rows = os.path.join(folder, "history.txt"), [], []
    for attempt in range(run["repeat"]):
        build(case, run)
        if attempt == 0:
            ops.recorder("Node", "-file", path, "-precision", 16, "-time", "-node", *[SPRING + i for i in case["watch"]], "-dof", 1, "disp")
        start = time.process_time()
        code, parted = ops.analyze(1, first) if first else 0, 0
        if code == 0:
            code, parted = march(run["dt"], steps, first)
        cpu.append(time.process_time() - start)
        ops.remove("recorders")
        if code != 0:
            return dict(run, failed="stopped at t = %g s" % ops.getTime())
        if attempt == 0:
            with open(path) as file:
                rows = [[float(word) for word in line.split()] for line in file if line.strip()]
            rows = [row for row in rows if abs((row[0] - first) / interval - round((row[0] - first) / interval)) < 1e-6]
        if cpu[0] > 2:
            break
    return dict(run, cpu_s=min(cpu), parted_steps=parted, steps=steps, time=[row[0] for row in rows],
                history=[[row[1 + k] for row in rows] for k in range(len(case["watch"]))])


def main(source, target):
    # OpenSees prints every impact to the error stream
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    with open(source) as file:
        case = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        results = [execute(case, run, folder) for run in case["runs"]]
    ops.wipe()
    with open(target, "w") as file:
        json.dump(dict(version=version(), runs=results), file)


if __name__ == "__main__":
    main(*sys.argv[1:])
