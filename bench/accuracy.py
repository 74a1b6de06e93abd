"""Error against step on examples/bouncing_ball and examples/pull_back, whose solutions are known in closed form.

Writes bench/results/accuracy.md and .json. Standard library only. What the numbers mean: bench/README.md.
"""
import argparse
import math
import sys

from harness import BenchError, Nsframe, arguments, machine, number, progress, step_microseconds, table, write

BALL_STEPS = (2e-3, 1e-3, 5e-4, 2.5e-4, 1e-4)  # [s]
PULL_STEPS = (1e-2, 5e-3, 1e-3, 5e-4, 1e-4, 1e-5)
SCHEMES = ((0.5, 0.5), (0.5, 1.0), (0.5, 1.5), (1.0, 0.5), (1.0, 1.5))  # theta, gamma

# Errors [m] of another implementation of the same scheme, as known to the digits shown; impacts found of three.
KNOWN_BALL = {(0.5, 1.5, 1e-3): 1.5e-3, (0.5, 1.5, 1e-4): 1.5e-4}
KNOWN_PULL = {(1.0, 0.5, 1e-2): (1.6e-2, 0), (1.0, 0.5, 5e-3): (1.8e-2, 1), (1.0, 0.5, 1e-3): (1.28e-2, 2),
              (1.0, 0.5, 1e-4): (1.27e-3, 3), (0.5, 0.5, 1e-2): (7.4e-3, 3), (0.5, 0.5, 5e-3): (3.0e-3, 3),
              (0.5, 0.5, 1e-3): (8.0e-4, 3), (0.5, 0.5, 1e-4): (6.4e-5, 3), (1.0, 1.5, 1e-2): (1.62e-2, 0),
              (1.0, 1.5, 5e-3): (1.64e-2, 1), (1.0, 1.5, 1e-3): (1.20e-2, 2), (1.0, 1.5, 1e-4): (1.18e-3, 3),
              (0.5, 1.5, 1e-2): (4.63e-3, 3), (0.5, 1.5, 5e-3): (3.63e-3, 3), (0.5, 1.5, 1e-3): (3.48e-4, 3),
              (0.5, 1.5, 1e-4): (4.42e-5, 3), (0.5, 1.0, 1e-3): (2.0e-4, 3)}


def ball_height(t):
    """1 m above the floor, g = 2 m/s2, e = 1/2: leaves with 1 m/s at 1 s, rests from 3 s [m]."""
    if t < 1:
        return 1 - t * t
    start, speed = 1.0, 1.0  # a bounce lasts as many seconds as its speed has m/s
    while t >= start + speed and speed > 1e-12:
        start, speed = start + speed, speed / 2
    s = t - start
    return speed * s - s * s if speed > 1e-12 else 0.0


class Oscillator:
    """Free motion of a damped mass on a spring."""

    def __init__(self, mass, stiffness, ratio):
        self.mass, self.w = mass, math.sqrt(stiffness / mass)
        self.a, self.wd = ratio * self.w, self.w * math.sqrt(1 - ratio * ratio)

    def at(self, x, v, s):
        c, d, e = math.cos(self.wd * s), math.sin(self.wd * s) / self.wd, math.exp(-self.a * s)
        return e * (x * c + (v + self.a * x) * d), e * (v * c - (self.w * self.w * x + self.a * v) * d)


class PullBack:
    """Two oscillators 2 cm apart, the first released at -2.4 cm, e = 0.6; impacts by bisection to rounding."""

    def __init__(self, duration, gap=0.02, pulled=-0.024, restitution=0.6, scan=1e-4):
        self.masses = Oscillator(4600, 2.11e6, 0.005), Oscillator(3500, 5.31e6, 0.005)
        self.phases = [(0.0, ((pulled, 0.0), (0.0, 0.0)))]  # start, (x, v) of each mass
        t = scan
        while t < duration:
            if self.gap(t, gap) > 0:
                t += scan
                continue
            low, high = t - scan, t
            while low < (middle := 0.5 * (low + high)) < high:
                low, high = (middle, high) if self.gap(middle, gap) > 0 else (low, middle)
            (xa, va), (xb, vb) = self.states(low)
            impulse = (1 + restitution) * (va - vb) / (1 / self.masses[0].mass + 1 / self.masses[1].mass)
            self.phases.append((low, ((xa, va - impulse / self.masses[0].mass), (xb, vb + impulse / self.masses[1].mass))))
            t = low + scan

    def states(self, t):
        start, state = next(phase for phase in reversed(self.phases) if phase[0] <= t)
        return [mass.at(x, v, t - start) for mass, (x, v) in zip(self.masses, state)]

    def gap(self, t, initial):
        (xa, _), (xb, _) = self.states(t)
        return initial + xb - xa


def run(nsframe, example, nodes, theta, gamma, dt, duration):
    settings = {"analysis.theta": theta, "analysis.gamma": gamma, "analysis.dt": repr(dt),
                "analysis.duration": repr(duration)}
    summary, _, time, history = nsframe.run(example, settings, nodes)
    return summary, time, history


def sweep(steps, known, one):
    """Rows over schemes and steps; `one(theta, gamma, dt)` gives error [m], impacts and the run's summary."""
    rows = []
    for theta, gamma in SCHEMES:
        previous = None
        for dt in steps:
            error, impacts, summary = one(theta, gamma, dt)
            order = math.log(previous[1] / error) / math.log(previous[0] / dt) if previous and previous[1] > 0 and error > 0 else None
            previous = dt, error
            figure = known.get((theta, gamma, dt))
            rows.append(dict(theta=theta, gamma=gamma, dt=dt, error_m=error, order=order, impacts=impacts,
                             step_us=step_microseconds(summary),
                             known_m=figure[0] if isinstance(figure, tuple) else figure,
                             known_impacts=figure[1] if isinstance(figure, tuple) else None))
    return rows


def rows_text(rows, with_impacts):
    lines = []
    for row in rows:
        cells = ["%g" % row["theta"], "%g" % row["gamma"], "%g" % row["dt"], number(row["error_m"]),
                 "–" if row["order"] is None else "%.2f" % row["order"], number(row["known_m"])]
        if with_impacts:
            cells += [str(row["impacts"]), number(row["known_impacts"], 1)]
        lines.append(cells)
    head = ["theta", "gamma", "dt, s", "largest error, m", "order", "known, m"]
    return table(head + (["impacts", "known"] if with_impacts else []), lines)


def main():
    options = arguments(argparse.ArgumentParser(description=__doc__.splitlines()[0])).parse_args()
    nsframe = Nsframe(options.program)
    ball_end, pull_end = (0.05, 0.15) if options.quick else (3.5, 2.0)
    exact = PullBack(pull_end)

    def ball(theta, gamma, dt):
        summary, time, history = run(nsframe, "bouncing_ball", ["ball.1"], theta, gamma, dt, ball_end)
        error = max(abs(1 + u - ball_height(t)) for t, u in zip(time, history["ball.1"][2]))
        return error, len(summary["impacts"]), summary

    def pull(theta, gamma, dt):
        summary, time, history = run(nsframe, "pull_back", ["left.1", "right.1"], theta, gamma, dt, pull_end)
        left, right = history["left.1"][0], history["right.1"][0]
        error = 0.0
        for t, a, b in zip(time, left, right):
            (xa, _), (xb, _) = exact.states(t)
            error = max(error, abs(a - xa), abs(b - xb))
        return error, len(summary["impacts"]), summary

    progress("bouncing ball")
    balls = sweep(BALL_STEPS[:2] if options.quick else BALL_STEPS, KNOWN_BALL, ball)
    progress("pull-back")
    pulls = sweep(PULL_STEPS[:2] if options.quick else PULL_STEPS, KNOWN_PULL, pull)
    fastest = [min((row["step_us"] for row in rows), default=0.0) for rows in (balls, pulls)]
    text = ("# Accuracy: error against step\n\n%s. Moreau-Jean; largest error of a displacement at any step; the order is measured\n"
            "between a row and the one above. \"Known\": another implementation of the scheme on the same case.\n\n"
            "## Bouncing ball, %g s\n\n%s\nLeast time a step: %s µs.\n\n"
            "## Pull-back pair, %g s\n\nExact: %d impacts, at %s s.\n\n%s\nLeast time a step: %s µs.\n"
            % (machine(), ball_end, rows_text(balls, False), number(fastest[0]), pull_end, len(exact.phases) - 1,
               ", ".join("%.12f" % start for start, _ in exact.phases[1:]), rows_text(pulls, True), number(fastest[1])))
    write(options.results, "accuracy", text, dict(bouncing_ball=balls, pull_back=pulls))


if __name__ == "__main__":
    try:
        main()
    except BenchError as problem:
        sys.exit("error: %s" % problem)
