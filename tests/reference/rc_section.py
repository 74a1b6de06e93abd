"""Moment and curvature of a reinforced-concrete section by OpenSees (openseespy): writes rc_section.csv beside this file.

The section of rc_cantilever_disp: Concrete02 cover and core, Steel02 bars. N = -400 kN in ten steps, then the curvature
in 50 steps to each peak.
"""
import os

import numpy as np
import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))
PEAKS = [0.01, -0.01, 0.03, -0.03, 0.06, -0.06, 0]
STEPS = 50

ops.wipe()
ops.model("basic", "-ndm", 2, "-ndf", 3)
ops.node(1, 0, 0)
ops.node(2, 0, 0)
ops.fix(1, 1, 1, 1)
ops.fix(2, 0, 1, 0)
COVER, CORE, BARS = 1, 2, 3
ops.uniaxialMaterial("Concrete02", COVER, -30e6, -0.002, -6e6, -0.006, 0.1, 2.5e6, 2.5e9)
ops.uniaxialMaterial("Concrete02", CORE, -36e6, -0.0034, -18e6, -0.02, 0.1, 2.5e6, 2.5e9)
ops.uniaxialMaterial("Steel02", BARS, 500e6, 200e9, 0.01, 18.0, 0.925, 0.15)
ops.section("Fiber", 1)
for i in range(12):
    y = -0.12 + (i + 0.5) * 0.02
    ops.fiber(y, 0, 0.24 * 0.02, CORE)
    ops.fiber(y, 0, 0.06 * 0.02, COVER)
for side in (1, -1):
    for i in range(2):
        ops.fiber(side * (0.12 + (i + 0.5) * 0.015), 0, 0.30 * 0.015, COVER)
for y, bars in ((-0.12, 4), (0, 2), (0.12, 4)):
    ops.fiber(y, 0, bars * 2.01e-4, BARS)
ops.element("zeroLengthSection", 1, 1, 2, 1)

ops.timeSeries("Linear", 1)
ops.pattern("Plain", 1, 1)
ops.load(2, -400e3, 0, 0)
ops.system("FullGeneral")
ops.numberer("Plain")
ops.constraints("Plain")
ops.test("NormUnbalance", 1e-6, 200)
ops.algorithm("Newton")
ops.integrator("LoadControl", 0.1)
ops.analysis("Static")
assert ops.analyze(10) == 0
ops.loadConst("-time", 0)
ops.timeSeries("Linear", 2)
ops.pattern("Plain", 2, 2)
ops.load(2, 0, 0, 1)

rows = []


def record():
    force = ops.eleResponse(1, "section", "force")
    rows.append((ops.nodeDisp(2, 3), force[1], ops.nodeDisp(2, 1), force[0]))


record()
at = 0.0
for peak in PEAKS:
    for i in range(1, STEPS + 1):
        ops.integrator("DisplacementControl", 2, 3, at + (peak - at) * i / STEPS - ops.nodeDisp(2, 3))
        assert ops.analyze(1) == 0, (peak, i)
        record()
    at = peak
np.savetxt(os.path.join(HERE, "rc_section.csv"), rows, "%.12g", ",",
           header="section of rc_cantilever_disp, N=-400 kN, curvature 0.01, -0.01, 0.03, -0.03, 0.06, -0.06, 0 in 50 steps "
           "each | curvature [1/m], moment [N m], axial strain, axial force [N]")
