"""Members whose sections have laws of shear and torsion by OpenSees (openseespy): writes aggregator_KIND.csv beside this file.

The column of cantilever_... (README.md), fibers of Steel01 (235 MPa, 210 GPa, 0.01), section Aggregator with Steel01 laws of
Vy (40 kN, 5 MN, 0.03) and Vz (12 kN, 2 MN, 0.05), and -torsion Steel01 (250 N m, 6566 N m2, 0.02); the tip pushed by
(2, 0.5) kN along x, y and 0.03 kN m about z times the load factor, led by ux to 0.08, -0.08, 0 m in 40 steps each.
Rows: ux, uy, rz [m, rad], load factor. torsion_disp: dispBeamColumn, torsion only.
"""
import os

import numpy as np
import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))


def run(kind, shear):
    fibers = np.loadtxt(os.path.join(HERE, "hea140_fibers.csv"), delimiter=",", comments="#")
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(1, 0.0, 0.0, 0.0)
    ops.node(2, 0.0, 0.0, 2.5)
    ops.fix(1, 1, 1, 1, 1, 1, 1)
    ops.uniaxialMaterial("Steel01", 1, 235e6, 210e9, 0.01)
    ops.uniaxialMaterial("Steel01", 2, 40e3, 5e6, 0.03)
    ops.uniaxialMaterial("Steel01", 3, 12e3, 2e6, 0.05)
    ops.uniaxialMaterial("Steel01", 4, 250.0, 6566.0, 0.02)
    ops.section("Fiber", 1, "-torsion", 4)
    for y, z, area in fibers[:, :3]:
        ops.fiber(float(y), float(z), float(area), 1)
    if shear:
        ops.section("Aggregator", 2, 2, "Vy", 3, "Vz", "-section", 1)
    ops.geomTransf("Linear", 1, 0.0, 1.0, 0.0)
    ops.beamIntegration("Lobatto", 1, 2 if shear else 1, 5)
    if kind == "force":
        ops.element("forceBeamColumn", 1, 1, 2, 1, 1, "-iter", 50, 1e-14)
    else:
        ops.element("dispBeamColumn", 1, 1, 2, 1, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 2e3, 0.5e3, 0.0, 0.0, 0.0, 30.0)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-12, 100)
    ops.algorithm("Newton")
    rows, last = [], 0.0
    for target in (0.08, -0.08, 0.0):
        ops.integrator("DisplacementControl", 2, 1, (target - last) / 40)
        ops.analysis("Static")
        for _ in range(40):
            if ops.analyze(1) != 0:
                raise RuntimeError(kind)
            rows.append([ops.nodeDisp(2, dof) for dof in (1, 2, 6)] + [ops.getTime()])
        last = target
    return rows


for kind, shear, name in (("force", True, "force"), ("force", False, "torsion_force"), ("disp", False, "torsion_disp")):
    with open(os.path.join(HERE, f"aggregator_{name}.csv"), "w") as file:
        file.write("# ux [m], uy [m], rz [rad], load factor\n")
        for row in run(kind, shear):
            file.write(", ".join("%.12g" % value for value in row) + "\n")
