"""The parts of the page that need no record: the ball (Fig. 5) and the pull-back (Fig. 8-11). Needs h5py and numpy.

Each function returns numbers for results.json and curves for curves.json.
"""
import cases
import histories
import numpy as np
from program import median, rounded

LAWS = {"LVE": ("linear-viscoelastic", "contact.stiffness"), "NLVE": ("jankowski", "contact.hertz_stiffness")}
BALL_STIFFNESSES = [float(f"{10 ** (i / 3):.3g}") for i in range(6, 25)]  # 1e2 to 1e8 N/m, or N/m^1.5
RATIOS = (0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000)  # of k_s over the stiffer body's stiffness
STIFFER = 5928029.839448306  # [N/m] of the scene pull_back
CROSSING = 0.01  # [m] where the nonlinear law with k_h = k_s / CROSSING^(1/2) is as stiff as the linear one


def theta_name(theta):
    return f"theta {theta:g}"


def stepping(theta, dt, gamma=1.5):
    return {"analysis.scheme": "moreau-jean", "analysis.theta": theta, "analysis.gamma": gamma, "analysis.dt": dt}


def ball(program):
    def error(folder, summary):
        times, columns = histories.displacements(folder, 2)
        height = 1 + columns["ball.1"]
        return {"error": rounded(float(np.abs(height - histories.ball_height(times)).max()), 4), "height": (times, height)}

    kept = histories.kept(["ball.1"])
    jobs = {("NSCD", theta, gamma, dt): ("bouncing_ball.toml", {**kept, **stepping(theta, dt, gamma)}, error)
            for theta in (1, 0.5) for gamma in (1.5, 0.5) for dt in (1e-3, 1e-4)}
    for name, (law, key) in LAWS.items():
        for dt in (1e-3, 1e-4):
            for theta in (0.5, 1):
                for k in BALL_STIFFNESSES:
                    settings = {**kept, **stepping(theta, dt), "contact.law": law, key: k}
                    jobs[name, theta, dt, k] = ("bouncing_ball.toml", settings, error)
    runs = program.run_all(jobs)

    numbers = {"nscd": [{"theta": theta, "gamma": gamma, "dt": dt, "error": runs["NSCD", theta, gamma, dt]["error"]}
                        for theta in (1, 0.5) for gamma in (1.5, 0.5) for dt in (1e-3, 1e-4)],
               "stiffnesses": BALL_STIFFNESSES, "penalty": []}
    for name in LAWS:
        for dt in (1e-3, 1e-4):
            for theta in (0.5, 1):
                errors = [runs[name, theta, dt, k]["error"] for k in BALL_STIFFNESSES]
                best = int(np.argmin(errors))
                numbers["penalty"].append({"law": name, "theta": theta, "dt": dt, "errors": errors,
                                           "best": BALL_STIFFNESSES[best], "best_error": errors[best]})

    def thinned(key):
        times, height = runs[key]["height"]
        return histories.curve(height[::10 if times[1] > 5e-4 else 100])

    best = {p["law"]: p["best"] for p in numbers["penalty"] if p["dt"] == 1e-3 and p["theta"] == 0.5}
    curves = {"rate": 100, "NSCD": thinned(("NSCD", 1, 1.5, 1e-3)), **{name: thinned((name, 0.5, 1e-3, best[name])) for name in LAWS}}
    return numbers, curves


def pull_back_pair(folder, summary):
    times, columns = histories.displacements(folder)
    poundings = summary["poundings"]
    return {"times": times, "left": columns["left.1"], "right": columns["right.1"], "poundings": len(poundings),
            "at": [round(p["t"], 5) for p in poundings], "impulses": [rounded(p["impulse"]) for p in poundings],
            "duration": rounded(median([p["duration"] for p in poundings]), 3),
            "restitution": rounded(median([p["effective_restitution"] for p in poundings]), 3),
            "effective": {mode["structure"]: rounded(mode["effective"], 4) for mode in summary["numerical_damping"]}}


def difference(run, reference):
    """Largest difference of either displacement at the whole milliseconds [m]."""
    assert np.allclose(run["times"], reference["times"], atol=1e-9), "histories are not sampled alike"
    return rounded(max(float(np.abs(run[side] - reference[side]).max()) for side in ("left", "right")), 4)


def told(run, reference):
    return {"poundings": run["poundings"], "at": run["at"], "impulses": run["impulses"], "error": difference(run, reference)}


def pull_back(program):
    kept = histories.kept(["left.1", "right.1"], 1000)
    schemes = {"paper": cases.PAPER_SCHEME, "paper, 0.1 ms": cases.FINE_SCHEME, "half": {**cases.HALF_SCHEME, "analysis.gamma": 1.5},
               "exact": cases.EXACT_SCHEME}
    restitutions, pulls = (0.2, 0.6, 0.9), (2.1, 2.4, 2.7, 3.0, 3.4)

    def job(*settings):
        return ("pull_back.toml", {key: value for part in (kept, *settings) for key, value in part.items()}, pull_back_pair)

    jobs = {("e", name, e): job(scheme, {"contact.restitution": e}) for name, scheme in schemes.items() for e in restitutions}
    jobs.update({("pull", name, pull): job(schemes[name], {"structure.left.initial_displacement": f'[[1, "ux", "-{pull:g} cm"]]'})
                 for name in ("paper", "exact") for pull in pulls})
    runs = program.run_all(jobs)
    numbers = {"restitutions": {}, "pulls": {}, "effective": runs["e", "paper", 0.6]["effective"]}
    for e in restitutions:
        numbers["restitutions"][f"{e:g}"] = {name: told(runs["e", name, e], runs["e", "exact", e]) for name in schemes}
    for pull in pulls:
        numbers["pulls"][f"{pull:g}"] = {name: runs["pull", name, pull]["poundings"] for name in ("paper", "exact")}
    curves = {"rate": 200, "e": {f"{e:g}": {name: {side: histories.curve(runs["e", name, e][side][::5]) for side in ("left", "right")}
                                            for name in ("paper", "exact")} for e in restitutions}}
    return numbers, curves


def pull_back_penalty(program):
    """k_s over the stiffer body's, against the step, for the linear and the nonlinear visco-elastic law; e = 0.65 as in the paper."""
    kept = {**histories.kept(["left.1", "right.1"], 1000), "contact.restitution": 0.65}
    jobs = {"exact": ("pull_back.toml", {**kept, **cases.EXACT_SCHEME}, pull_back_pair)}
    for ratio in RATIOS:
        for name, (law, key) in LAWS.items():
            k = ratio * STIFFER / (CROSSING**0.5 if name == "NLVE" else 1)
            for theta, dts in ((0.5, (1e-3, 1e-4, 1e-5)), (1, (1e-3, 1e-4))):
                for dt in dts:
                    settings = {**kept, **stepping(theta, dt), "contact.law": law, key: f"{k:.9g}"}
                    jobs[name, theta, dt, ratio] = ("pull_back.toml", settings, pull_back_pair)
    runs = program.run_all(jobs)
    numbers = {"ratios": list(RATIOS), "exact_poundings": runs["exact"]["poundings"], "series": []}
    for name in LAWS:
        for theta, dts in ((0.5, (1e-3, 1e-4, 1e-5)), (1, (1e-3, 1e-4))):
            for dt in dts:
                series = [runs[name, theta, dt, ratio] for ratio in RATIOS]
                numbers["series"].append({"law": name, "theta": theta, "dt": dt,
                                          "errors": [difference(run, runs["exact"]) for run in series],
                                          "poundings": [run["poundings"] for run in series],
                                          "durations": [run["duration"] for run in series],
                                          "restitutions": [run["restitution"] for run in series]})
    shown = {"exact": "exact", "0.01": ("LVE", 0.5, 1e-3, 0.01), "1": ("LVE", 0.5, 1e-3, 1), "100": ("LVE", 0.5, 1e-3, 100)}
    curves = {"rate": 200, **{name: {side: histories.curve(runs[key][side][::5]) for side in ("left", "right")}
                              for name, key in shown.items()}}
    return numbers, curves


def identification(program):
    """What a fit of e makes of the scheme's damping, on the pull-back with 0.5 %; the least root mean square of both displacements'
    difference over e = 0, 0.02 ... 1.

    asked, effective: the paper's scheme at e = 0.6 fitted by an exact solver, with the ratios asked for and with those that scheme
    and step give. by_paper: the exact motion at e = 0.6 fitted by the paper's scheme.
    """
    kept = histories.kept(["left.1", "right.1"], 1000)
    found = {"paper": cases.PAPER_SCHEME, "exact": cases.EXACT_SCHEME}
    targets = program.run_all({name: ("pull_back.toml", {**kept, **scheme}, pull_back_pair) for name, scheme in found.items()})
    effective = targets["paper"]["effective"]
    damped = {f"structure.{side}.damping.ratios": f"[{ratio}]" for side, ratio in effective.items()}
    fits = {"asked": ("paper", cases.EXACT_SCHEME), "effective": ("paper", {**cases.EXACT_SCHEME, **damped}),
            "by_paper": ("exact", cases.PAPER_SCHEME)}
    values = [round(0.02 * i, 2) for i in range(51)]
    runs = program.run_all({(fit, e): ("pull_back.toml", {**kept, **settings, "contact.restitution": e}, pull_back_pair)
                            for fit, (_, settings) in fits.items() for e in values})
    numbers = {"restitutions": values}
    for fit, (target, _) in fits.items():
        misfit = [float(np.sqrt(np.mean([np.mean((runs[fit, e][side] - targets[target][side]) ** 2) for side in ("left", "right")])))
                  for e in values]
        best = int(np.argmin(misfit))
        numbers[fit] = {"e": values[best], "misfit": rounded(misfit[best], 3), "misfit_at_0.6": rounded(misfit[values.index(0.6)], 3),
                        "misfits": histories.short(misfit, 3), "poundings": runs[fit, values[best]]["poundings"]}
    return numbers
