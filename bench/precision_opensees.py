"""OpenSees for work_precision.py: what is tried, and the runs that are worth showing. Standard library only."""
from harness import BenchError, progress
from pair import Opensees
from precision_cases import INTERVAL, STEPS
from precision_runs import ask, candidates, done, error_of, fastest, front, judged, nearest, reason, timed_again

# Masses and springs: what decides the error, at every step; then what decides the time, at 1 ms, one choice after the other.
IMPLICIT = [dict(integrator=i) for i in (["Newmark", 0.5, 0.25], ["HHT", 0.9])]
EXPLICIT = dict(integrator=["ExplicitDifference"], system="Diagonal", algorithm="Linear")
ALGORITHMS = ("KrylovNewton", "Newton", "ModifiedNewton")
CHAIN_SPEED = [("system", ("FullGeneral", "BandSPD", "ProfileSPD", "BandGeneral")), ("algorithm", ALGORITHMS)]
LOOSE = 1e4  # times the case's tolerance, tried last

# The two-story pair: penalty, integrator and step decide the error, the rest the time.
PAIR_START = dict(system="BandSPD", algorithm="KrylovNewton", damping="modalDampingQ", tolerance=1e-8, penalty=1e8, dt=1e-3,
                  integrator=IMPLICIT[0]["integrator"])
PAIR_SPEED = [("system", ("BandSPD", "ProfileSPD", "UmfPack")), ("algorithm", ALGORITHMS), ("damping", ("modalDampingQ", "modalDamping")),
              ("tolerance", (1e-8, 1e-6))]
ALGEBRA = ("system", "algorithm", "damping")
SPEED_END = 1.5   # [s] of motion in which the settings of the pair are tried for speed
PAIR_STEPS = {"elastic": STEPS, "displacement-based": STEPS[:5]}
SLOW_STEP, SLOW_PENALTY = 6e-4, 1e8  # at shorter steps than this the softest penalties aren't tried: they bound the error


def words(values):
    return " ".join("%g" % v if isinstance(v, float) else str(v) for v in values)


def chain_text(run):
    parts = ["%s %.0e" % (run["law"], run["penalty"])]
    if run.get("damping") is not None:
        parts.append("damping %g" % run["damping"])
    parts.append(words(run["integrator"]))
    if run["offset"]:
        parts.append("first step %g dt" % run["offset"])
    return "%s; %s, %s, tolerance %g" % (", ".join(parts), run["system"], run["algorithm"], run["tolerance"])


class ChainRuns:
    """Masses, springs and one contact: all settings in one process."""

    KEYS = ("law", "penalty", "integrator", "dt", "offset", "damping", "system", "algorithm", "tolerance")

    def __init__(self, python, case, reference, options):
        self.python, self.case, self.reference, self.options = python, case, reference, options
        self.base = dict(case.chain, duration=case.end(options), interval=INTERVAL)
        self.version = ""

    def run(self, runs, repeat):
        runs = [dict({key: run[key] for key in self.KEYS if key in run}, repeat=repeat) for run in runs]
        answer = ask(self.python, "opensees_chain.py", dict(self.base, runs=runs))
        self.version = answer["version"]
        return judged(answer["runs"], self.reference, self.case.exact)

    def settings(self):
        small = len(self.case.chain["masses"]) < 3
        algebra = dict(system="ProfileSPD" if small else "BandSPD", algorithm="KrylovNewton")
        result = [dict(algebra, **way, law=law, penalty=penalty, dt=dt, offset=offset, tolerance=self.case.tolerance,
                       **({} if damping is None else {"damping": damping}))
                  for dt in STEPS for law in self.case.laws for penalty in self.case.penalties
                  for way in IMPLICIT for offset in self.case.offsets
                  for damping in (self.case.dampings if law == "ViscoelasticGap" else (None,))]
        result += [dict(run, **EXPLICIT) for run in result if run["integrator"][0] == "HHT"]
        return result[:2] + result[-1:] if self.options.quick else result


def chain(python, case, reference, options):
    """Rows, what was tried, and the version."""
    runs = ChainRuns(python, case, reference, options)
    settings = runs.settings()
    progress("OpenSees: %d settings for the error" % len(settings))
    tried = runs.run(settings, 1)
    chosen = candidates(tried)
    implicit = [run for run in chosen if run["algorithm"] != "Linear"]
    speeds = []
    if implicit:
        typical = nearest(implicit, 1e-3)
        progress("OpenSees: what is fastest")
        choices = [] if options.quick else CHAIN_SPEED + [("tolerance", (case.tolerance, LOOSE * case.tolerance))]
        start = {key: typical[key] for key in runs.KEYS if key in typical}
        algebra, speeds = fastest(lambda setting: runs.run([setting], options.runs)[0], start, choices)
        algebra = {key: algebra[key] for key in ("system", "algorithm", "tolerance")}
        implicit_again = [{**run, **algebra} if run["algorithm"] != "Linear" else run for run in chosen]
        chosen = timed_again(runs.run(chosen, options.runs), runs.run(implicit_again, options.runs))
    rows = [dict(run, program="OpenSees", series="OpenSees", setting=chain_text(run)) for run in front(chosen)]
    return rows, dict(error=tried, time=speeds), runs.version


def pair(python, case, reference, options):
    """The same for the two-story pair; a process a run."""
    opensees, end = Opensees(python), case.end(options)

    def run(setting, duration, repeat):
        arguments = ["--history", INTERVAL, "--repeat", repeat, "--integrator", *setting["integrator"]]
        for key in ("penalty", "system", "algorithm", "damping", "tolerance"):
            arguments += ["--" + key, setting[key]]
        try:
            data, _ = opensees.run(case.columns, setting["dt"], duration, arguments)
            row = dict(setting, cpu_s=1e-6 * data["step_us"] * data["steps"], parted_steps=data["parted_steps"], version=data["version"])
            keep = round(duration / INTERVAL) + 1
            row["error_m"] = error_of((None, None, reference[2][:keep], [values[:keep] for values in reference[3]]), setting["dt"],
                                      data["time"], data["roof"])
        except BenchError as problem:
            return dict(setting, failed=reason(problem))
        return row

    def short(setting):
        progress("OpenSees for the time: %s, tolerance %g" % (", ".join(setting[key] for key in ALGEBRA), setting["tolerance"]))
        return run(setting, min(SPEED_END, end), 1)

    algebra, speeds = fastest(short, PAIR_START, [] if options.quick else PAIR_SPEED)
    settings = [{**algebra, **way, "penalty": penalty, "dt": dt} for dt in PAIR_STEPS[case.columns] for penalty in case.penalties
                for way in IMPLICIT if dt > SLOW_STEP or (penalty >= SLOW_PENALTY and way is IMPLICIT[0])]
    tried = []
    for setting in settings[:1] if options.quick else settings:
        progress("OpenSees: penalty %.0e N/m, %s, dt = %g ms" % (setting["penalty"], words(setting["integrator"]), 1e3 * setting["dt"]))
        tried.append(run(setting, end, 1))
    chosen = candidates(tried)
    again = [run(row, end, options.runs) if row["cpu_s"] < options.long else row for row in chosen]
    rows = [dict(row, program="OpenSees", series="OpenSees", setting="ViscoelasticGap %.0e, %s; %s, tolerance %g" % (
        row["penalty"], words(row["integrator"]), ", ".join(row[key] for key in ALGEBRA), row["tolerance"]))
            for row in front(timed_again(chosen, again))]
    versions = [run["version"] for run in done(speeds + tried)]
    return rows, dict(error=tried, time=speeds), versions[0] if versions else "that failed"
