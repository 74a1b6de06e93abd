"""The pull-back pair of Langlade et al. (2021), Table 3 (k and m as printed, no damping), by OpenSees (openseespy) with its own
contact materials: writes penalty_LAW.csv beside this file.

4600 kg on 2.11 MN/m, let go from -2.4 cm, 2 cm from 3500 kg on 5.31 MN/m. Rows: time, both displacements.
"""
import math
import os

import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))
DT, EVERY, ROWS = 2e-6, 5000, 50
M = 4600.0 * 3500.0 / 8100.0
E = 0.6
XI_LINEAR = -math.log(E) / math.hypot(math.pi, math.log(E))
XI_JANKOWSKI = 9 * math.sqrt(5) / 2 * (1 - E * E) / (E * (E * (9 * math.pi - 16) + 16))
LAWS = {
    "viscoelastic_gap": ("ViscoelasticGap", (5e6, 2 * XI_LINEAR * math.sqrt(5e6 * M), -0.02)),
    "hertz_damp": ("HertzDamp", (6e7, 8 * (1 - E) / (5 * E), -0.02, 1.5)),
    "jankowski_impact": ("JankowskiImpact", (6e7, XI_JANKOWSKI, M, -0.02, 1.5)),
}


def run(law, parameters):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (1, 2, 3, 4):
        ops.node(node, 0.0)
    ops.fix(1, 1)
    ops.fix(4, 1)
    ops.mass(2, 4600.0)
    ops.mass(3, 3500.0)
    ops.uniaxialMaterial("Elastic", 1, 2.11e6)
    ops.uniaxialMaterial("Elastic", 2, 5.31e6)
    ops.uniaxialMaterial(law, 3, *parameters)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.element("zeroLength", 2, 4, 3, "-mat", 2, "-dir", 1)
    ops.element("zeroLength", 3, 2, 3, "-mat", 3, "-dir", 1)
    ops.setNodeDisp(2, 1, -0.024, "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGen")
    ops.test("NormDispIncr", 1e-12, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    rows = [(0.0, -0.024, 0.0)]
    for _ in range(ROWS):
        if ops.analyze(EVERY, DT) != 0:
            raise RuntimeError(law)
        rows.append((ops.getTime(), ops.nodeDisp(2, 1), ops.nodeDisp(3, 1)))
    return rows


for name, (law, parameters) in LAWS.items():
    with open(os.path.join(HERE, f"penalty_{name}.csv"), "w", encoding="ascii") as file:
        file.write(f"# {law} {', '.join('%g' % p for p in parameters)}: time [s], displacements [m]\n")
        for row in run(law, parameters):
            file.write(", ".join(f"{value:.12g}" for value in row) + "\n")
