"""The cases of work_precision.py: scenes for nsframe, the same as masses and springs for the peers, and references.

Units: N, m, s. Standard library only.
"""
import dataclasses
import os
import typing

import references
from accuracy import PullBack, ball_height
from harness import BenchError, number
from pair import CASES, ROOF_NODES, largest_difference

INTERVAL = references.INTERVAL            # [s] at which displacements are compared; with longer steps, at their ends
STEPS = (2e-2, 1e-2, 5e-3, 1e-3, 5e-4, 1e-4)    # [s]
QUICK_END = 0.1                           # [s]

EXACT = {"analysis.scheme": "exact"}

BAR = 100                                 # elements
SCENE_OF_BAR = """# An elastic bar of 10 m hits the ground with 10 m/s from 5 m above: in contact from 0.5 s to 0.5 + 2/3 s.
title = "Elastic bar on a wall"

[material.bar]
law = "Elastic"
E = 900

[structure.bar]
may_move_freely = true
nodes = [{nodes}]
supports = {{ {supports} }}
masses = {{ {masses} }}
trusses = [{trusses}]
initial_velocity = [{velocities}]

[[contact]]
kind = "nodes"
between = ["bar.1", "ground"]
direction = "-z"
gap = 5
restitution = 0.0

[analysis]
dt = 1e-3
duration = 1.5
"""


@dataclasses.dataclass
class Case:
    """One case, and what the peers may try on it."""
    title: str
    duration: float                                  # [s]
    scene: str                                       # an example, or the folder of a scene
    nodes: list                                      # whose displacements are compared
    component: int                                   # 0 x, 1 y, 2 z
    settings: dict = dataclasses.field(default_factory=dict)
    columns: typing.Optional[str] = None             # of the two-story pair, as in pair.py
    linear: bool = True
    chain: typing.Optional[dict] = None              # masses, springs and one contact on a line
    penalties: tuple = ()                            # [N/m]
    laws: tuple = ("ViscoelasticGap", "JankowskiImpact")
    offsets: tuple = (0.0,)                          # OpenSees' first step as a part of the others
    dampings: tuple = (None,)                        # of ViscoelasticGap, of critical; None: what returns the restitution
    tolerance: float = 1e-12                         # [m] of OpenSees' test on increments
    exact: typing.Optional[typing.Callable] = None   # closed form: histories at given times
    moreau_jean: dict = dataclasses.field(default_factory=dict)  # settings that Moreau-Jean needs here
    moreau_jean_text: str = ""

    def end(self, options):
        return min(QUICK_END, self.duration) if options.quick else self.duration


def bar(folder):
    """The bar, written as a scene into the folder."""
    masses = [10.0 / BAR / (2 if i in (0, BAR) else 1) for i in range(BAR + 1)]
    each = range(1, BAR + 2)
    text = SCENE_OF_BAR.format(
        nodes=", ".join("[%d, 0, 0, %r]" % (i, 5 + 10.0 * (i - 1) / BAR) for i in each),
        supports=", ".join('%d = ["ux", "uy", "rx", "ry", "rz"]' % i for i in each),
        masses=", ".join("%d = %r" % (i, masses[i - 1]) for i in each),
        trusses=", ".join('[%d, %d, %d, "bar", 1]' % (i, i, i + 1) for i in each[:-1]),
        velocities=", ".join('[%d, "uz", -10]' % i for i in each))
    with open(os.path.join(folder, "scene.toml"), "w") as file:
        file.write(text)
    chain = dict(masses=masses, springs=[[i, i + 1, 900.0 * BAR / 10, 0.0] for i in range(BAR)], contact=[None, 0, 5.0, 0.0],
                 q0=[0.0] * (BAR + 1), v0=[-10.0] * (BAR + 1), load=[0.0] * (BAR + 1), watch=[0, BAR // 2, BAR])
    # e = 0 of one end node hardly matters, the wave brings the bar back: penalties without damping, and with the critical one.
    # Strains are differences of displacements of metres: rounding leaves more than nsframe's default tolerance of 1e-8.
    return Case("Elastic bar on a wall, %d elements" % BAR, 1.5, folder, ["bar.%d" % (1 + i) for i in chain["watch"]], 2, chain=chain,
                penalties=(1e4, 1e5, 1e6, 1e7), laws=("ViscoelasticGap",), dampings=(0.0, 1.0), tolerance=1e-10,
                moreau_jean={"analysis.newton_tolerance": 1e-6}, moreau_jean_text=", newton_tolerance 1e-6")


def ball():
    # Impacts at 1 s and 2 s are ends of steps, which penalties don't take well: also with a shorter first step.
    chain = dict(masses=[1.0], springs=[], contact=[None, 0, 1.0, 0.5], q0=[0.0], v0=[0.0], load=[-2.0], watch=[0])
    return Case("Bouncing ball", 3.5, "bouncing_ball", ["ball.1"], 2, chain=chain, penalties=(1e3, 1e4, 1e5, 3e5, 1e6, 1e7),
                offsets=(0.0, 0.37), exact=lambda times: [[ball_height(t) - 1 for t in times]])


def pull_back():
    masses, stiffnesses = [4600.0, 3500.0], [2.11e6, 5.31e6]
    springs = [[None, i, k, 2 * 0.005 * (k * m) ** 0.5] for i, (m, k) in enumerate(zip(masses, stiffnesses))]
    chain = dict(masses=masses, springs=springs, contact=[0, 1, 0.02, 0.6], q0=[-0.024, 0.0], v0=[0.0, 0.0], load=[0.0, 0.0],
                 watch=[0, 1])

    def exact(times):
        solution = PullBack(max(times[-1], INTERVAL))
        states = [solution.states(t) for t in times]
        return [[state[k][0] for state in states] for k in (0, 1)]

    return Case("Pull-back pair", 2.0, "pull_back", ["left.1", "right.1"], 0, chain=chain, penalties=(1e7, 1e8, 1e9, 1e10, 1e11),
                exact=exact)


def two_story(columns, title):
    scene, settings = CASES[columns]
    return Case("Two-story pair, " + title, references.DURATION, scene, list(ROOF_NODES), 0, {**settings, "gravity.acceleration": 0}, columns,
                linear=columns == "elastic", penalties=(1e7, 1e8, 1e9))


NAMES = ("ball", "pull-back", "elastic", "fiber", "bar")


def cases(folder):
    """All cases by name; the bar's scene is written to the folder."""
    return dict(zip(NAMES, (ball(), pull_back(), two_story("elastic", "elastic columns"),
                            two_story("displacement-based", "fiber columns (Steel02, displacement-based)"), bar(folder))))


# --- references: what it is, its own error [m] or None where it is a closed form, times, histories

def reference_of(case, nsframe, end):
    times = [k * INTERVAL for k in range(round(end / INTERVAL) + 1)]
    if case.exact:
        return "closed form", None, times, case.exact(times)
    if case.chain:
        return bar_reference(case, nsframe, end, times)
    head, times, roof = references.read(case.columns)
    if len(times) < 2:
        raise BenchError("run bench/references.py first")
    keep = sum(1 for t in times if t <= end + 1e-9)
    text = "scheme %s, dt = %g ms (bench/reference)" % (head["scheme"], 1e3 * head["dt"])
    return text, head["own_error_m"], times[:keep], [corner[:keep] for corner in roof]


def bar_reference(case, nsframe, end, times):
    fine, coarse = (run_nsframe(nsframe, case, EXACT, dt, end)[1:] for dt in (5e-4, 5e-3))
    own = largest_difference(*fine, *coarse)[0]
    closed = [-10 * t if t < 0.5 else -5.0 if t < 0.5 + 2 / 3 else -5 + 10 * (t - 0.5 - 2 / 3) for t in times]
    apart = max(abs(a - b) for a, b in zip(fine[1][0], closed))
    text = "scheme exact kept each 0.5 ms, of the bar in elements: its lower end is %s m off the continuous bar's closed form"
    return (text % number(apart), own, *fine)


def settings_of(case, scheme, dt, end):
    return {**case.settings, **scheme, "analysis.dt": repr(dt), "analysis.duration": repr(end)}


def run_nsframe(nsframe, case, scheme, dt, end):
    """Summary, times, histories."""
    summary, _, time, nodes = nsframe.run(case.scene, settings_of(case, scheme, dt, end), case.nodes, 1 / max(INTERVAL, dt))
    return summary, time, [nodes[node][case.component] for node in case.nodes]
