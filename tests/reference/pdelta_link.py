"""twoNodeLink with -pDelta by OpenSees (openseespy): writes pdelta_link.csv beside this file.

A link of 2.4 m along z, local y along x, fixed at its foot, stiffness (8 MN/m, 90 kN/m, 60 kN/m, 40, 70, 110 kN m/rad), shear springs
in the middle; forces at its top (3, 2, -30) kN and moments (0.4, -0.3, 0.2) kN m in one step. Rows: four ratios, then six displacements.
"""
import os

import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(HERE, "pdelta_link.csv"), "w") as file:
    file.write("# My_i, My_j, Mz_i, Mz_j; ux, uy, uz, rx, ry, rz\n")
    for ratios in [(0, 0, 0, 0), (0.5, 0.5, 0.5, 0.5), (0.1, 0.3, 0.45, 0.2), (0, 1, 1, 0)]:
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        ops.node(1, 0.0, 0.0, 0.0)
        ops.node(2, 0.0, 0.0, 2.4)
        ops.fix(1, 1, 1, 1, 1, 1, 1)
        for i, k in enumerate((8e6, 90e3, 60e3, 40e3, 70e3, 110e3)):
            ops.uniaxialMaterial("Elastic", i + 1, k)
        ops.element("twoNodeLink", 1, 1, 2, "-mat", *range(1, 7), "-dir", *range(1, 7), "-orient", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0,
                    "-pDelta", *[float(r) for r in ratios])
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        ops.load(2, 3e3, 2e3, -30e3, 400.0, -300.0, 200.0)
        ops.constraints("Plain")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.test("NormUnbalance", 1e-9, 200)
        ops.algorithm("ModifiedNewton")
        ops.integrator("LoadControl", 1.0)
        ops.analysis("Static")
        if ops.analyze(1) != 0:
            raise RuntimeError(str(ratios))
        file.write(", ".join("%.12g" % v for v in [*ratios, *[ops.nodeDisp(2, i) for i in range(1, 7)]]) + "\n")
