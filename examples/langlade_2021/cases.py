"""What T. Langlade et al., Engineering Structures 241 (2021) 112426, simulated and measured, and what is run for it.

Plain data, standard library only. `paper` is the paper's; keys and values of `settings` are those of nsframe's --set.
"""

PAPER_SCHEME = {"analysis.scheme": "moreau-jean", "analysis.theta": 1, "analysis.gamma": 1.5, "analysis.dt": 1e-3}
HALF_SCHEME = {"analysis.scheme": "moreau-jean", "analysis.theta": 0.5, "analysis.gamma": 0.5, "analysis.dt": 1e-3}
FINE_SCHEME = dict(PAPER_SCHEME, **{"analysis.dt": 1e-4})
EXACT_SCHEME = {"analysis.scheme": "exact", "analysis.dt": 1e-3}
YIELDING_SCHEME = {"analysis.scheme": "exponential", "analysis.accuracy": 1e-4, "analysis.dt": 1e-3}
SCHEMES = {"paper": PAPER_SCHEME, "converged": EXACT_SCHEME}

# The unnamed records of the paper, and what stands for them here. `shipped`: the file is part of nsframe.
MOTIONS = {
    "cadarache": {"paper": "Cadarache, an artificial signal that is not published",
                  "difference": "a stand-in: it has the shape of Eurocode 8, not the paper's target spectrum, duration or phases"},
    "el_centro": {"paper": "El Centro", "difference": "the paper names neither station, component nor processing"},
    "northridge": {"paper": "Northridge", "difference": "the paper names neither station nor component"},
    "kobe": {"paper": "Kobe", "difference": "the paper names neither station nor component"},
}
EL_CENTRO_FILE = "../motions/el_centro_1940_ns.at2"

# Rock, 5 % damping; matched from 0.05 to 1 s, which holds every mode along the direction of pounding. Seed 1 is the stand-in,
# the others tell how much the draw of the phases matters.
ARTIFICIAL = ["--target", "eurocode8", "--type", "1", "--ground", "A", "--ag", "0.3 g", "--over", "0.05,1", "--duration", "20 s"]
SEED, OTHER_SEEDS = 1, (2, 3, 4, 5)

# Table 5: single-story plane frames, gap 2 cm, e = 0.6.
TABLE_5 = [
    {"id": "cadarache_025", "motion": "cadarache", "pga": 0.25, "ratios": (0.006, 0.005), "simulated": 9, "measured": 12},
    {"id": "cadarache_030", "motion": "cadarache", "pga": 0.30, "ratios": (0.006, 0.005), "simulated": 8, "measured": 14},
    {"id": "el_centro_040", "motion": "el_centro", "pga": 0.40, "ratios": (0.005, 0.005), "simulated": 1, "measured": 3},
    {"id": "el_centro_045", "motion": "el_centro", "pga": 0.45, "ratios": (0.005, 0.005), "simulated": 4, "measured": 5},
    {"id": "northridge_030", "motion": "northridge", "pga": 0.30, "ratios": (0.004, 0.004), "simulated": 2, "measured": 2},
    {"id": "northridge_035", "motion": "northridge", "pga": 0.35, "ratios": (0.004, 0.004), "simulated": 3, "measured": 3},
    {"id": "kobe_040", "motion": "kobe", "pga": 0.40, "ratios": (0.006, 0.005), "simulated": 2, "measured": 2},
]

# Table 8: two-story frames, e = 0.6; gaps [cm] at the left and the right corners (of lower and higher y).
TABLE_8 = [
    {"id": "cadarache_045", "motion": "cadarache", "pga": 0.45, "gaps": (5.0, 5.5), "simulated": 3, "measured": 3},
    {"id": "el_centro_030", "motion": "el_centro", "pga": 0.30, "gaps": (5.0, 5.5), "simulated": 3, "measured": 3},
    {"id": "northridge_020", "motion": "northridge", "pga": 0.20, "gaps": (5.5, 6.0), "simulated": 1, "measured": 1},
    {"id": "kobe_020", "motion": "kobe", "pga": 0.20, "gaps": (4.5, 5.0), "simulated": 3, "measured": 3},
    {"id": "kobe_025", "motion": "kobe", "pga": 0.25, "gaps": (5.0, 5.5), "simulated": 3, "measured": 4},
]

MODES = ("L1", "L2", "T1", "T2", "R1", "R2")  # the paper's 1L 2L 1T 2T 1To 2To
TABLE_6 = {"left": (0.007, 0.002, 0.013, 0.013, 0.02, 0.02), "right": (0.01, 0.002, 0.01, 0.01, 0.03, 0.03)}
TABLE_7_MEASURED = {"left": (2.10, 5.60, 6.10, 17.5, 8.60, 24.4), "right": (3.70, 10.4, 8.20, 25.2, 10.1, 28.0)}  # [Hz]
TABLE_7_MODEL = {"left": (2.10, 5.60, 6.11, 17.5, 8.60, 24.4), "right": (3.69, 10.4, 8.20, 25.2, 10.2, 28.0)}

RESTITUTIONS = (0.4, 0.5, 0.7, 0.8)         # beside 0.6
DAMPING_FACTORS = (0.5, 2.0)
RIGID_SLABS = {"structure.left.slab.kind": "rigid", "structure.right.slab.kind": "rigid"}


def yielding(strength_mpa):
    """Columns of Steel02 fibers, yield stress in MPa, in place of elastic ones."""
    return {"material.steel.law": "Steel02", "material.steel.fy": f"{strength_mpa} MPa", "material.steel.b": 0.01,
            "structure.left.columns.element": "force-based", "structure.right.columns.element": "force-based"}


def motion_settings(row):
    return {"motion.pga": f"{row['pga']:.2f} g"}


def toml_list(values):
    return "[" + ", ".join(f"{value:.6g}" for value in values) + "]"


class PlaneFrame:
    """Table 5. A row's settings, and how they are varied."""
    scene, rows, name = "plane_frame.toml", TABLE_5, "table_5"
    floors = {"left": "left.4", "right": "right.3"}

    @staticmethod
    def gap(row, change_cm=0.0):
        return {"contact.gap": f"{2 + change_cm:g} cm"}

    @staticmethod
    def damping(row, factor=1.0, ratios=None):
        ratios = ratios or [factor * ratio for ratio in row["ratios"]]
        return {f"structure.{side}.damping.ratios": toml_list(ratios) for side in ("left", "right")}

    @staticmethod
    def effective_ratios(modes):
        """The ratios that scheme and step of a run gave the two frames, as damping() takes them."""
        return [modes[side]["L1"]["effective"] for side in ("left", "right")]


class TwoStory:
    """Table 8."""
    scene, rows, name = "two_story.toml", TABLE_8, "table_8"
    floors = {"left": "left.25", "right": "right.25"}

    @staticmethod
    def gap(row, change_cm=0.0):
        return {"contact.gap": "[" + ", ".join(f'"{gap + change_cm:g} cm"' for gap in row["gaps"]) + "]"}

    @staticmethod
    def damping(row, factor=1.0, ratios=None):
        ratios = ratios or {side: [factor * ratio for ratio in TABLE_6[side]] for side in TABLE_6}
        return {f"structure.{side}.damping.ratios": "{" + ", ".join(f"{m} = {r:.6g}" for m, r in zip(MODES, ratios[side])) + "}"
                for side in ("left", "right")}

    @staticmethod
    def effective_ratios(modes):
        return {side: [modes[side][mode]["effective"] for mode in MODES] for side in ("left", "right")}


SYSTEMS = (PlaneFrame, TwoStory)


def row_settings(system, row, file):
    return {"motion.file": file, **motion_settings(row), **system.gap(row), **system.damping(row)}


def variations(system, row):
    """What is varied one at a time, under both schemes: name -> settings."""
    found = {"gap -0.5 cm": system.gap(row, -0.5), "gap +0.5 cm": system.gap(row, 0.5)}
    found.update({f"e {e:g}": {"contact.restitution": e} for e in RESTITUTIONS})
    found.update({f"damping x {f:g}": system.damping(row, f) for f in DAMPING_FACTORS})
    return found
