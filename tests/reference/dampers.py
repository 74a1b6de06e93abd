"""A mass on a spring and a damper by OpenSees (openseespy): writes damper_LAW.csv beside this file.

1000 kg, 40 kN/m, at rest, under 4 kN sin(9 t) from t = 0 on. Rows: time, displacement, force of the damper.
"""
import os

import numpy as np
import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))
DT, EVERY, ROWS = 2e-5, 1000, 150


def run(law, parameters):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, 1000.0)
    ops.uniaxialMaterial("Elastic", 1, 40e3)
    ops.uniaxialMaterial(law, 2, *parameters)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.element("zeroLength", 2, 1, 2, "-mat", 2, "-dir", 1)
    ops.timeSeries("Trig", 1, 0.0, 100.0, 2 * np.pi / 9.0)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 4000.0)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-6, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    rows = [(0.0, 0.0, 0.0)]
    for _ in range(ROWS):
        if ops.analyze(EVERY, DT) != 0:
            raise RuntimeError(law)
        rows.append((ops.getTime(), ops.nodeDisp(2, 1), ops.eleResponse(2, "material", 1, "stress")[0]))
    return rows


for name, law, parameters in [
    ("linear", "Viscous", (2e3, 1.0)),
    ("power", "Viscous", (3e3, 0.4)),
    ("maxwell", "ViscousDamper", (60e3, 3e3, 1.0)),
    ("maxwell_power", "ViscousDamper", (60e3, 3e3, 0.4)),
    ("maxwell_gap", "ViscousDamper", (60e3, 3e3, 1.0, 0.004)),
    ("maxwell_power_gap", "ViscousDamper", (60e3, 3e3, 0.4, 0.004)),
]:
    with open(os.path.join(HERE, f"damper_{name}.csv"), "w") as file:
        file.write(f"# {law} {', '.join('%g' % p for p in parameters)}: time [s], displacement [m], force of the damper [N]\n")
        for row in run(law, parameters):
            file.write(", ".join("%.12g" % value for value in row) + "\n")
