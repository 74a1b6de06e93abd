"""Two oscillators that pound on a moving ground, exactly: the plane frames of Table 5 by a second route. Standard library only.

Between impacts each displacement is the closed form for ground accelerations that are straight lines; an impact is found by
bisection where the gap is negative after a millisecond, and changes both velocities by Newton's law. None of the program is used.
"""
import math

GRAVITY = 9.80665  # [m/s2]


class Oscillator:
    def __init__(self, mass, frequency, damping_ratio):
        self.mass, self.w, self.xi = mass, 2 * math.pi * frequency, damping_ratio
        self.wd = self.w * math.sqrt(1 - damping_ratio**2)

    def after(self, state, start, slope, t):
        """Displacement and velocity relative to the ground after t, under the ground acceleration start + slope t."""
        w, xi = self.w, self.xi
        rest = -start / w**2 + 2 * xi * slope / w**3  # the particular solution is rest + drift t
        drift = -slope / w**2
        x, v = state[0] - rest, state[1] - drift
        decay, c, s = math.exp(-xi * w * t), math.cos(self.wd * t), math.sin(self.wd * t)
        return (decay * (x * c + (v + xi * w * x) / self.wd * s) + rest + drift * t,
                decay * (v * c - (w**2 * x + xi * w * v) / self.wd * s) + drift)


def read_at2(file):
    """Step [s] and accelerations [m/s2]."""
    with open(file, encoding="utf-8") as text:
        lines = text.read().splitlines()
    step = float(lines[3].split("DT=")[1].split()[0].rstrip(","))
    return step, [GRAVITY * float(word) for line in lines[4:] for word in line.split()]


def impacts(left, right, gap, restitution, step, ground, parts):
    """(time, impulse) of every impact; each step of the record is looked at in `parts` parts."""
    oscillators, states, found = (left, right), [(0.0, 0.0), (0.0, 0.0)], []

    def moved(start, slope, t):
        return [o.after(state, start, slope, t) for o, state in zip(oscillators, states)]

    for k in range(len(ground) - 1):
        slope = (ground[k + 1] - ground[k]) / step
        for part in range(parts):
            now, left_over = part * step / parts, step / parts
            while True:
                end = moved(ground[k] + slope * now, slope, left_over)
                if gap + end[1][0] - end[0][0] > 0:
                    states = end
                    break
                low, high = 0.0, left_over
                for _ in range(60):
                    middle = 0.5 * (low + high)
                    at = moved(ground[k] + slope * now, slope, middle)
                    low, high = (middle, high) if gap + at[1][0] - at[0][0] > 0 else (low, middle)
                if low == 0:
                    raise RuntimeError(f"the masses stay together at {k * step + now} s")
                (x0, v0), (x1, v1) = moved(ground[k] + slope * now, slope, low)
                impulse = (1 + restitution) * (v0 - v1) / (1 / left.mass + 1 / right.mass)
                states = [(x0, v0 - impulse / left.mass), (x1, v1 + impulse / right.mass)]
                now, left_over = now + low, left_over - low
                found.append((k * step + now, impulse))
    return found


def plane_frames(file, pga, ratios):
    """Impacts of the frames of Table 5 under a record scaled to pga [g]."""
    step, ground = read_at2(file)
    scale = pga * GRAVITY / max(abs(value) for value in ground)
    left, right = Oscillator(4600.0, 3.50, ratios[0]), Oscillator(3500.0, 6.55, ratios[1])
    return impacts(left, right, 0.02, 0.6, step, [scale * value for value in ground], round(step / 1e-3))
