"""A linear model with contacts in Siconos, run as a process of its own by work_precision.py.

Needs siconos and numpy, nothing else. Massless coordinates are condensed, and what isn't connected becomes a system of its
own: both make Siconos faster. Units: N, m, s. Input and output are JSON: see work_precision.py.
"""
import json
import sys
import time

import numpy as np
import siconos.numerics as sn
import siconos.kernel as sk


def condensed(case):
    """M, K, C, H, loads and starting values without the massless coordinates, and the coordinates to watch."""
    M, K, C, H = (np.atleast_2d(np.array(case[name], float)) for name in ("M", "K", "C", "H"))
    q0, v0, f, r = (np.array(case[name], float) for name in ("q0", "v0", "f", "r"))
    heavy = np.flatnonzero(M.diagonal() > 0)
    light = np.flatnonzero(M.diagonal() == 0)
    if len(light):
        if C[light].any() or H[:, light].any() or f[light].any() or r[light].any():
            raise ValueError("a massless coordinate is damped, loaded or in contact")
        K = K[np.ix_(heavy, heavy)] - K[np.ix_(heavy, light)] @ np.linalg.solve(K[np.ix_(light, light)], K[np.ix_(light, heavy)])
        K = 0.5 * (K + K.T)
    else:
        K = K[np.ix_(heavy, heavy)]
    place = {int(d): i for i, d in enumerate(heavy)}
    return dict(M=M[np.ix_(heavy, heavy)], K=K, C=C[np.ix_(heavy, heavy)], H=H[:, heavy], q0=q0[heavy], v0=v0[heavy], f=f[heavy],
                r=r[heavy], watch=[place[d] for d in case["watch"]])


def with_ramp(model, motion):
    """A load that is linear between its samples, for a scheme that only takes constant ones: the velocity of one more mass.

    The force of that mass is the slope, set at each sample; its velocity acts on every coordinate through the damping matrix.
    Acceleration enters as f = r a.
    """
    n = len(model["M"])
    grown = {name: np.zeros((n + 1, n + 1)) for name in ("M", "K", "C")}
    for name in grown:
        grown[name][:n, :n] = model[name]
    grown["M"][n, n] = 1.0
    grown["C"][:n, n] = -model["r"]
    return dict(model, **grown, H=np.hstack([model["H"], np.zeros((len(model["H"]), 1))]), q0=np.append(model["q0"], 0.0),
                v0=np.append(model["v0"], motion["acceleration"][0]), f=np.append(model["f"], 0.0), r=np.append(model["r"], 0.0))


def parts(model):
    """Coordinates of each connected part."""
    linked = (model["M"] != 0) | (abs(model["K"]) > 1e-12 * abs(model["K"]).max()) | (model["C"] != 0) | (model["C"].T != 0)
    left, found = set(range(len(linked))), []
    while left:
        part, edge = set(), {min(left)}
        while edge:
            part |= edge
            edge = {int(j) for i in edge for j in np.flatnonzero(linked[i])} - part
        found.append(sorted(part))
        left -= part
    return found


def build(case, model, run):
    """The simulation, the systems' coordinates and loads, and what must live as long as they."""
    duration = case["duration"]
    nsds = sk.NonSmoothDynamicalSystem(0.0, duration)
    systems, keep = [], []
    blocks = parts(model)
    for block in blocks:
        M, K, C = (np.asfortranarray(model[name][np.ix_(block, block)]) for name in ("M", "K", "C"))
        q0, v0, f = (model[name][block].copy() for name in ("q0", "v0", "f"))
        system = sk.LagrangianLinearTIDS(q0, v0, M)
        if K.any():
            system.setKPtr(K)
        if C.any():
            system.setCPtr(C)
        system.setFExtPtr(f)
        nsds.insertDynamicalSystem(system)
        systems.append(system)
        keep += [q0, v0, M, K, C, f]
    for row, gap, e in zip(model["H"], case["gap"], case["e"]):
        used = [k for k, block in enumerate(blocks) if row[block].any()]
        H, b = np.concatenate([row[blocks[k]] for k in used])[None, :].copy(), np.array([gap])
        relation = sk.LagrangianLinearTIR(H, b)
        interaction = sk.Interaction(sk.NewtonImpactNSL(e), relation)
        nsds.link(interaction, *[systems[k] for k in used])
        keep += [H, b, relation, interaction]
    steps = sk.TimeDiscretisation(0.0, run["dt"])
    solver = lambda: sk.LCP(getattr(sn, run["solver"]))
    if run["scheme"] == "EventDriven":
        simulation, osi = sk.EventDriven(nsds, steps), sk.LsodarOSI()
        problems = [solver(), solver()]
        simulation.insertIntegrator(osi)
        simulation.insertNonSmoothProblem(problems[0], sk.SICONOS_OSNSP_ED_IMPACT)
        simulation.insertNonSmoothProblem(problems[1], sk.SICONOS_OSNSP_ED_SMOOTH_ACC)
    else:
        osi, problems = sk.MoreauJeanOSI(run["theta"], run["gamma"]), [solver()]
        simulation = sk.TimeStepping(nsds, steps, osi, problems[0])
    return simulation, [s.q() for s in systems], [s.fExt() for s in systems], blocks, keep + [nsds, systems, osi, problems, steps]


def once(case, model, run, record):
    """CPU time of the loop [s], times and histories at the interval."""
    motion = case.get("motion")
    ramp = len(model["M"]) if motion and run["scheme"] == "EventDriven" else None
    if ramp is not None:
        model = with_ramp(model, motion)
    simulation, q, load, blocks, keep = build(case, model, run)
    where = {d: (k, i) for k, block in enumerate(blocks) for i, d in enumerate(block)}
    watch = [where[d] for d in model["watch"]]
    interval, kept, times, history = case["interval"], 1, [0.0], [[float(q[k][i])] for k, i in watch]
    dt, steps = run["dt"], round(case["duration"] / run["dt"])

    def keep_if_due(t):
        nonlocal kept
        if t > (kept - 1e-6) * interval:
            kept = int(t / interval + 1e-6)
            if abs(t - kept * interval) < 1e-6 * interval:
                times.append(t)
                for (k, i), values in zip(watch, history):
                    values.append(float(q[k][i]))
            kept += 1

    if run["scheme"] == "EventDriven":
        slopes = (np.diff(motion["acceleration"]) / motion["dt"]).tolist() if motion else []
        start, events = time.process_time(), 0
        while simulation.hasNextEvent():
            if ramp is not None:
                block, place = where[ramp]
                load[block][place] = slopes[min(int(simulation.startingTime() / motion["dt"] + 1e-9), len(slopes) - 1)]
            simulation.advanceToEvent()
            if record:
                keep_if_due(simulation.nextTime())
            simulation.processEvents()
            events += 1
            if time.process_time() - start > run["limit"]:
                raise RuntimeError("%d events in %g s of CPU: at t = %.4g s" % (events, run["limit"], simulation.startingTime()))
        return time.process_time() - start, times, history
    weights = None
    if motion:
        grid = motion["dt"] * np.arange(len(motion["acceleration"]))
        ends = np.interp(dt * np.arange(steps + 1), grid, motion["acceleration"], right=0.0)
        weights = ((1 - run["theta"]) * ends[:-1] + run["theta"] * ends[1:]).tolist()
        shapes = [model["r"][block].copy() for block in blocks]
    start = time.process_time()
    if not weights and not record:
        simulation.run()  # no Python in the loop
        return time.process_time() - start, times, history
    for k in range(steps):
        if weights:
            for shape, values in zip(shapes, load):
                np.multiply(shape, weights[k], out=values)
        simulation.computeOneStep()
        if record:
            keep_if_due(simulation.nextTime())
        simulation.nextStep()
    return time.process_time() - start, times, history


def execute(case, model, run):
    """Runs once with the history, then `repeat` - 1 times without; or says why it failed."""
    try:
        cpu, times, history = once(case, model, run, True)
        every = [cpu]
        while len(every) < run["repeat"] and cpu < 2:
            every.append(once(case, model, run, False)[0])
    except Exception as problem:  # Siconos throws its own kinds
        return dict(run, failed=str(problem).strip().splitlines()[-1] if str(problem).strip() else type(problem).__name__)
    return dict(run, cpu_s=min(every), time=times, history=history)


def main(source, target):
    with open(source) as file:
        case = json.load(file)
    model = condensed(case)
    results = [execute(case, model, run) for run in case["runs"]]
    with open(target, "w") as file:
        json.dump(dict(coordinates=len(model["M"]), runs=results), file)


if __name__ == "__main__":
    main(*sys.argv[1:])
