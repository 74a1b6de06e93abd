"""The two-story pair of examples/two_story in OpenSees, run as a process of its own by two_story.py and free_flight.py.

Contact is a penalty spring with dashpot at each pair of facing corners. The defaults are the settings found fastest for
OpenSees: modalDampingQ, BandSPD, KrylovNewton; Newmark's average acceleration. Needs openseespy, nothing else.
Units: N, m, s. x is the direction of pounding, z is up.
"""
import argparse
import importlib.metadata
import json
import math
import os
import sys
import tempfile
import time

import openseespy.opensees as ops

STEEL, STEEL_SHEAR = 210e9, 210e9 / 2.6
YIELD, HARDENING = 235e6, 0.01
SPAN_X, SPAN_Y, STORY = 3.2, 2.2, 2.5
GAPS, RESTITUTION = (0.05, 0.055), 0.6

# What examples/two_story/scene.toml says of each structure, and the sizes of its column shape.
FRAMES = {
    1: dict(x0=0.0, shape=dict(h=0.096, b=0.100, tw=0.005, tf=0.008, r=0.012, J=5.24e-8), beam_vertical=1.2617e-4,
            foot=2.23047e7, braces=(1.61229e-4, 2.44428e-4), floor_mass=4600.0, spin=(588.573, 585.454),
            ratios=dict(L1=0.007, L2=0.002, T1=0.013, T2=0.013, R1=0.02, R2=0.02)),
    2: dict(x0=SPAN_X, shape=dict(h=0.133, b=0.140, tw=0.0055, tf=0.0085, r=0.012, J=8.13e-8), beam_vertical=6.42272e-5,
            foot=1.45131e7, braces=(1.96086e-4, 4.34601e-4), floor_mass=3500.0, spin=(2971.41, 1503.19),
            ratios=dict(L1=0.01, L2=0.002, T1=0.01, T2=0.01, R1=0.03, R2=0.03)),
}
ROOF = ((1, 2), (1, 3), (2, 1), (2, 4))  # structure, corner: the four facing corners of the roofs


def tag(frame, floor, place):
    """Corners 1-4 counter-clockwise from (-x, -y), 5 the centre of a slab."""
    return 10000 * frame + 10 * floor + place


def column_fibers(h, b, tw, tf, r, **_):
    """(y along the depth, z along the width, area): flanges 10 x 2 each, web 8, four root fillets as one fiber each."""
    fibers = []
    for side in (-1, 1):
        for layer in range(2):
            y = side * (h / 2 - tf * (0.75 - 0.5 * layer))
            fibers += [(y, b * ((k + 0.5) / 10 - 0.5), b / 10 * tf / 2) for k in range(10)]
    clear = h - 2 * tf
    fibers += [(clear * ((k + 0.5) / 8 - 0.5), 0.0, tw * clear / 8) for k in range(8)]
    fillet, centroid = (1 - math.pi / 4) * r ** 2, 0.2234 * r
    for y in (-1, 1):
        fibers += [(y * (clear / 2 - centroid), z * (tw / 2 + centroid), fillet) for z in (-1, 1)]
    return fibers


def add_frame(number, columns, material, stories):
    frame = FRAMES[number]
    shape = frame["shape"]
    x, y = frame["x0"], SPAN_Y / 2
    plan = ((x - SPAN_X / 2, -y), (x + SPAN_X / 2, -y), (x + SPAN_X / 2, y), (x - SPAN_X / 2, y), (x, 0.0))
    elastic, law, upright, level = number, 10 + number, number, 10 + number
    foot = 20 + number
    for floor in range(stories + 1):
        for place in range(1, 6 if floor else 5):
            ops.node(tag(number, floor, place), *plan[place - 1], STORY * floor)
        if floor:
            for corner in range(1, 5):
                m = frame["floor_mass"]
                ops.mass(tag(number, floor, corner), m / 12, m / 12, m / 4, 0.0, 0.0, 0.0)
            ops.mass(tag(number, floor, 5), 2 * m / 3, 2 * m / 3, 0.0, 0.0, 0.0, frame["spin"][floor == stories])

    ops.uniaxialMaterial("Elastic", elastic, STEEL)
    ops.uniaxialMaterial("Elastic", foot, frame["foot"])
    ops.geomTransf("Linear", upright, 0.0, 1.0, 0.0)  # columns: local y is x, local z is y
    ops.geomTransf("Linear", level, 0.0, 0.0, 1.0)    # beams: local z is up
    element = 100000 * number
    for corner in range(1, 5):
        ground = tag(number, 900, corner)
        ops.node(ground, *plan[corner - 1], 0.0)
        ops.fix(ground, 1, 1, 1, 1, 1, 1)
        ops.fix(tag(number, 0, corner), 1, 1, 1, 0, 0, 1)
        element += 1
        ops.element("zeroLength", element, ground, tag(number, 0, corner), "-mat", foot, foot, "-dir", 4, 5)

    fibers = column_fibers(**shape)
    A = sum(a for _, _, a in fibers)
    Iz, Iy = sum(a * y * y for y, _, a in fibers), sum(a * z * z for _, z, a in fibers)
    if columns != "elastic":
        if material == "Steel02":
            ops.uniaxialMaterial("Steel02", law, YIELD, STEEL, HARDENING, 20.0, 0.925, 0.15)
        elif material == "Steel01":
            ops.uniaxialMaterial("Steel01", law, YIELD, STEEL, HARDENING)
        else:
            ops.uniaxialMaterial("Elastic", law, STEEL)
        ops.section("Fiber", number, "-GJ", STEEL_SHEAR * shape["J"])
        for y, z, a in fibers:
            ops.fiber(y, z, a, law)
        ops.beamIntegration("Lobatto", number, number, 5)
    for floor in range(1, stories + 1):
        below = [tag(number, floor - 1, k) for k in range(1, 5)]
        here = [tag(number, floor, k) for k in range(1, 5)]
        centre = tag(number, floor, 5)
        for low, high in zip(below, here):
            element += 1
            if columns == "elastic":
                ops.element("elasticBeamColumn", element, low, high, A, STEEL, STEEL_SHEAR, shape["J"], Iy, Iz, upright)
            elif columns == "displacement-based":
                ops.element("dispBeamColumn", element, low, high, upright, number)
            else:
                ops.element("forceBeamColumn", element, low, high, upright, number, "-iter", 20, 1e-12)
        for i, j in ((0, 1), (3, 2), (1, 2), (0, 3)):
            element += 1
            ops.element("elasticBeamColumn", element, here[i], here[j], 5e-3, STEEL, STEEL_SHEAR, 1e-6,
                        frame["beam_vertical"], 2e-5, level)
        for corner in here:
            element += 1
            ops.element("elasticBeamColumn", element, centre, corner, 0.10, 30e9, 30e9 / 2.4, 1e-5, 1e-6, 1e-3, level)
        for i, j in ((0, 3), (3, 0), (1, 2), (2, 1)):
            element += 1
            ops.element("Truss", element, below[i], here[j], frame["braces"][floor == stories], elastic)


def add_contacts(penalty, with_dashpot, stories, gaps):
    """Linear spring and dashpot behind a gap; the dashpot returns the restitution (Anagnostopoulos 1988)."""
    ratio = -math.log(RESTITUTION) / math.hypot(math.pi, math.log(RESTITUTION))
    m1, m2 = (FRAMES[k]["floor_mass"] / 2 for k in (1, 2))  # half a floor stands behind a corner
    dashpot = 2 * ratio * math.sqrt(penalty * m1 * m2 / (m1 + m2))
    if not with_dashpot:
        dashpot = 0.0
    for side, gap in enumerate(gaps):
        ops.uniaxialMaterial("ViscoelasticGap", 100 + side, penalty, dashpot, -gap)
        for floor in range(1, stories + 1):
            left, right = tag(1, floor, 2 + side), tag(2, floor, (1, 4)[side])
            ops.element("zeroLength", 900000 + 10 * floor + side, left, right, "-mat", 100 + side, "-dir", 1)


def damp(command):
    """The asked ratios at the twelve modes, told apart by where the roof's and the floor's motion is largest."""
    eigenvalues = ops.eigen("-genBandArpack", 12)
    count, ratios, frequencies = {}, [], []
    for mode, value in enumerate(eigenvalues, 1):
        best = (0.0, 0, "")
        for number, frame in FRAMES.items():
            for name, direction in (("L", 1), ("T", 2), ("R", 6)):
                weight = frame["floor_mass"] * ((SPAN_X ** 2 + SPAN_Y ** 2) / 12 if name == "R" else 1)
                energy = sum(weight * ops.nodeEigenvector(tag(number, floor, 5), mode, direction) ** 2 for floor in (1, 2))
                best = max(best, (energy, number, name))
        _, number, name = best
        count[number, name] = count.get((number, name), 0) + 1
        label = name + str(count[number, name])
        ratios.append(FRAMES[number]["ratios"][label])
        frequencies.append([number, label, math.sqrt(value) / (2 * math.pi)])
    {"modalDampingQ": ops.modalDampingQ, "modalDamping": ops.modalDamping}[command](*ratios)
    return frequencies


def build(a, record):
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for number in FRAMES:
        add_frame(number, a.columns, a.material, a.stories)
    if a.ratio is None:
        frequencies = damp(a.damping)
    else:
        frequencies = [[0, "", math.sqrt(value) / (2 * math.pi)] for value in ops.eigen("-genBandArpack", 6)]
        {"modalDampingQ": ops.modalDampingQ, "modalDamping": ops.modalDamping}[a.damping](*([a.ratio] * 6))
    if not a.free_flight:
        add_contacts(a.penalty, not a.no_dashpot, a.stories, a.gaps)
    ops.timeSeries("Path", 1, "-dt", record["dt"], "-values", *record["acceleration"])
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(a.system)
    ops.test("NormDispIncr", a.tolerance, 50)
    ops.algorithm(a.algorithm)
    ops.integrator(a.integrator[0], *[float(word) for word in a.integrator[1:]])
    ops.analysis("Transient")
    return frequencies


def version():
    try:
        return "%s (openseespy %s)" % (ops.version(), importlib.metadata.version("openseespy"))
    except importlib.metadata.PackageNotFoundError:
        return ops.version()


def march(dt, steps):
    """Steps of dt; a step that OpenSees cannot close is taken in 2, 4, ... 256 parts. Code, steps taken in parts."""
    done = parted = 0
    while done < steps:
        if ops.analyze(steps - done, dt) == 0:
            return 0, parted
        done = round(ops.getTime() / dt)
        for halvings in range(1, 9):
            target, part = (done + 1) * dt, dt / 2 ** halvings
            while ops.getTime() < target - 0.5 * part and ops.analyze(1, part) == 0:
                pass
            if ops.getTime() > target - 0.5 * part:
                break
        else:
            return 1, parted
        done, parted = done + 1, parted + 1
    return 0, parted


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", help="JSON: dt [s] and acceleration [m/s2]")
    parser.add_argument("result", help="JSON to write")
    parser.add_argument("--columns", choices=("elastic", "displacement-based", "force-based"), default="elastic")
    parser.add_argument("--material", default="Steel02")
    parser.add_argument("--dt", type=float, default=1e-3)
    parser.add_argument("--duration", type=float, default=20)
    parser.add_argument("--stories", type=int, default=2, help="taller: every floor and story but the last as the first")
    parser.add_argument("--ratio", type=float, help="damp the six lowest modes of the model by this, not by the scene's ratios")
    parser.add_argument("--gaps", type=float, nargs=2, default=GAPS, help="[m] at the corners of lower and higher y")
    parser.add_argument("--penalty", type=float, default=1e8)
    parser.add_argument("--no-dashpot", action="store_true", help="elastic penalty")
    parser.add_argument("--free-flight", action="store_true", help="no contact")
    parser.add_argument("--history", type=float, default=0, help="[s] between the rows of the roof corners' history")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--damping", default="modalDampingQ")
    parser.add_argument("--system", default="BandSPD")
    parser.add_argument("--algorithm", default="KrylovNewton")
    parser.add_argument("--integrator", nargs="+", default=["Newmark", "0.5", "0.25"])
    parser.add_argument("--tolerance", type=float, default=1e-8)
    a = parser.parse_args()
    # OpenSees prints every impact to the error stream
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    with open(a.record) as file:
        record = json.load(file)
    steps = round(a.duration / a.dt)
    rows, cpu = [], []
    with tempfile.TemporaryDirectory() as folder:
        for run in range(a.repeat):
            frequencies = build(a, record)
            path = os.path.join(folder, "roof.txt")
            if a.history and run == 0:
                ops.recorder("Node", "-file", path, "-precision", 14, "-time", "-node",
                             *[tag(frame, a.stories, corner) for frame, corner in ROOF], "-dof", 1, "disp")
            ops.recorder("EnvelopeNode", "-file", os.path.join(folder, "peaks.txt"), "-precision", 10, "-node",
                         *[tag(frame, a.stories, corner) for frame, corner in ROOF], "-dof", 1, "disp")
            start = time.process_time()
            code, parted = march(a.dt, steps)
            cpu.append((time.process_time() - start) / steps)
            end = ops.getTime()
            equations = ops.systemSize()
            ops.remove("recorders")
            with open(os.path.join(folder, "peaks.txt")) as file:  # lines: least, largest, largest absolute value
                peaks = [float(word) for word in file.read().split("\n")[2].split()]
            if a.history and run == 0:
                with open(path) as file:
                    rows = [[float(word) for word in line.split()] for line in file if line.strip()]
                rows = [row for row in rows if abs(row[0] / a.history - round(row[0] / a.history)) < 1e-6]
            if code != 0:
                break
    ops.wipe()
    with open(a.result, "w") as file:
        json.dump(dict(version=version(), completed=code == 0, end_time=end, steps=steps, equations=equations, parted_steps=parted,
                       step_us=1e6 * min(cpu), step_us_all=[1e6 * c for c in cpu], frequencies=frequencies, peaks=peaks,
                       time=[row[0] for row in rows], roof=[[row[1 + k] for row in rows] for k in range(len(ROOF))]), file)


if __name__ == "__main__":
    sys.exit(main())
