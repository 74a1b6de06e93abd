"""Random histories of uniaxial laws by OpenSees (openseespy): writes opensees_LAW.csv beside this file.

A file holds several histories. Each begins with a line "# parameters, ..." in the order of the command (nan: left out),
then rows of strain, stress, tangent. Strains are rounded before OpenSees sees them, so that the file has them exactly.
"""
import os

import numpy as np
import openseespy.opensees as ops

HERE = os.path.dirname(os.path.abspath(__file__))


def run(law, parameters, strains):
    ops.wipe()
    ops.uniaxialMaterial(law, 1, *[p for p in parameters if not np.isnan(p)])
    ops.testUniaxialMaterial(1)
    rows = []
    for strain in strains:
        ops.setStrain(float(strain))
        rows.append((strain, ops.getStress(), ops.getTangent()))
    return np.array(rows)


def path(rng, targets, step, points, decimals):
    """Straight to random targets, in random steps about `step`, sometimes by small steps and sometimes in one leap."""
    strains = [0.0]
    while len(strains) < points:
        target = targets(strains[-1])
        n = max(1, int(abs(target - strains[-1]) / (step * rng.choice([0.5, 1, 2, 20]))))
        strains += list(np.linspace(strains[-1], target, n + 1)[1:])
    return np.round(strains[:points], decimals)


def rounded(values):
    return [float("%.4g" % v) for v in values]


def concrete(rng, tension):
    least, largest = tension
    def targets(last):
        kind = rng.integers(4)
        if kind == 0: return rng.uniform(least, largest)
        if kind == 1: return last + rng.uniform(-0.1, 0.1) * abs(least)
        if kind == 2: return rng.uniform(0.3 * least, largest)
        return rng.uniform(-1, 1) * largest
    return targets


def concrete01(rng, case):
    fpc, epsc0 = -rng.uniform(20, 60) * 1e6, -rng.uniform(0.0015, 0.004)
    fpcu, epsU = fpc * rng.choice([0, rng.uniform(0, 1)]), epsc0 * rng.uniform(1.2, 6)
    return rounded([fpc, epsc0, fpcu, epsU]), concrete(rng, (1.6 * epsU, 0.001)), 3e-4


def concrete02(rng, case):
    (fpc, epsc0, fpcu, epsU), targets, step = concrete01(rng, case)
    Ec = 2 * fpc / epsc0
    if case == 0: return [fpc, epsc0, fpcu, epsU, np.nan, np.nan, np.nan], targets, step
    if case == 1: return [-fpc, -epsc0, -fpcu, -epsU, 0.1, 0.08 * abs(fpc), 0.05 * Ec], targets, step
    return rounded([fpc, epsc0, fpcu, epsU, rng.uniform(0, 0.6), rng.uniform(0, 0.15) * abs(fpc), Ec * rng.uniform(0.02, 1)]), targets, step


def concrete04(rng, case):
    fc, ec = -rng.uniform(20, 60) * 1e6, -rng.uniform(0.0015, 0.004)
    ecu, Ec, fct = ec * rng.uniform(1.2, 6), fc / ec * rng.uniform(1.1, 3), -fc * rng.uniform(0.03, 0.15)
    p = rounded([fc, ec, ecu, Ec, fct, fct / Ec * rng.uniform(1.2, 20), rng.uniform(0.01, 0.9)])
    if case == 0: p[4:] = [np.nan] * 3
    if case == 1: p[6] = np.nan
    return p, concrete(rng, (1.3 * ecu, 0.0008)), 3e-4


def hysteretic(rng, case):
    def side():
        s1, e1 = rng.uniform(100, 300) * 1e6, rng.uniform(0.0005, 0.002)
        e2 = e1 * rng.uniform(1.5, 8)
        s2 = max(0.3 * s1, s1 + rng.uniform(-0.2, 0.3) * s1 / e1 * (e2 - e1) * rng.choice([0.1, 1]))
        return [s1, e1, s2, e2, s2 * rng.choice([rng.uniform(0.05, 1.3), rng.uniform(0.05, 1)]), e2 * rng.uniform(1.2, 4)]
    p = side()
    n = [-v for v in (side() if case % 2 else p)]
    if case == 2:
        p[4:] = n[4:] = [np.nan] * 2
    shape = [rng.uniform(0.2, 1), rng.uniform(0.1, 1), *(rng.choice([0, rng.uniform(0, 0.05)]) for _ in range(2)), rng.choice([0, rng.uniform(0, 0.6)])]
    if case == 0: shape = [1, 1, 0, 0, 0]
    if case == 3: shape = [0.7, 0.3, 0.02, 0.03, 0.4]
    reach = 1.2 * np.nanmax(p[1::2]), 1.2 * np.nanmax(np.abs(n[1::2]))
    return rounded([*p, *n, *shape]), lambda last: rng.uniform(-reach[1], reach[0]), 0.08 * sum(reach)


def bouc_wen(rng, case):
    n, reach, share = rng.choice([1, 2, 1.5, 3]), rng.uniform(0.02, 0.2), rng.uniform(0, 1)
    p = [rng.uniform(0, 0.3), 1e3, n, (1 - share) / reach**n, share / reach**n, 1, 0, 0, 0]
    if case % 2:
        W = 1e3 * reach**2 * 300
        p[6:] = [rng.uniform(0, 0.5) / W, rng.uniform(0, 2) / W, rng.uniform(0, 2) / W]
    # OpenSees' default tolerance is 1e-8 of z as it comes
    return rounded(p) + [1e-14, 60], lambda last: rng.uniform(-6, 6) * reach, 0.1 * reach


def imk_bilin(rng, case):
    Ke = 1e3
    def side():
        Fy = rng.uniform(50, 150)
        uy = Fy / Ke
        return [uy * rng.uniform(1, 8), uy * rng.uniform(3, 20), uy * rng.uniform(8, 40), Fy, rng.uniform(1, 1.3), rng.choice([0, rng.uniform(0, 0.5)])]
    a, b = side(), side()
    p = rounded([Ke, *a, *(b if case % 2 else a), *(0.1 * rng.uniform(2, 60, 3)), *rng.choice([1, 1, rng.uniform(0.7, 1.5)], 3),
                 *(rng.choice([1, rng.uniform(0.3, 1)]) for _ in range(2))])
    reach = rng.choice([1.1, 0.5, 0.3]) * min(a[2], b[2])
    return p, lambda last: rng.uniform(-reach, reach), 0.02


def usable(law, parameters, rows):
    """OpenSees' answer is a number, and its IMKBilin has not passed the state in which all energy is used."""
    if not np.isfinite(rows).all(): return False
    if law != "IMKBilin": return True
    energy = np.concatenate([[0], np.cumsum(0.5 * (rows[1:, 1] + rows[:-1, 1]) * np.diff(rows[:, 0]))])
    capacity = min(parameters[13:16]) * parameters[4]
    gone = np.flatnonzero(rows[1:, 1] == 0)
    end = gone[0] if len(gone) else len(rows)
    return energy[:end].max() < capacity


LAWS = {  # name: parameters and targets, histories, points, decimals of the strains
    "Concrete01": (concrete01, 5, 160, 9),
    "Concrete02": (concrete02, 8, 160, 9),
    "Concrete04": (concrete04, 6, 160, 9),
    "Hysteretic": (hysteretic, 9, 160, 9),
    "BoucWen": (bouc_wen, 6, 160, 7),
    "IMKBilin": (imk_bilin, 9, 200, 6),
}

if __name__ == "__main__":
    for law, (make, cases, points, decimals) in LAWS.items():
        rng = np.random.default_rng(20210715)
        with open(os.path.join(HERE, "opensees_%s.csv" % law), "w") as file:
            file.write("# %s; strain, stress, tangent by OpenSees %s; made by laws.py\n" % (law, ops.version()))
            case = 0
            while case < cases:
                parameters, targets, step = make(rng, case)
                rows = run(law, parameters, path(rng, targets, step, points, decimals))
                if not usable(law, parameters, rows): continue
                file.write("# parameters, " + ", ".join("%.12g" % p for p in parameters) + "\n")
                for row in rows: file.write("%.12g,%.12g,%.12g\n" % tuple(row))
                case += 1
