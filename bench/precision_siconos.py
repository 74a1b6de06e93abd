"""Siconos for work_precision.py: the linear cases as matrices, what is tried, and the runs that are worth showing.

Standard library only; siconos_cases.py runs in the interpreter that has siconos.
"""
import os
import subprocess
import tempfile

from harness import ROOT, BenchError, measure, progress
from pair import Opensees
from precision_cases import INTERVAL, STEPS
from precision_runs import ask, candidates, fastest, front, judged, nearest, reason, timed_again

SOLVERS = ("SICONOS_LCP_LEMKE", "SICONOS_LCP_ENUM", "SICONOS_LCP_NEWTONMIN", "SICONOS_LCP_PGS")
EVENT_LIMIT = 20.0   # [s] of CPU for an event-driven run


def interpreter(options):
    """The interpreter that imports siconos, or None and the reason."""
    if options.no_siconos:
        return None, "not asked for"
    try:
        probe = subprocess.run([options.siconos_python, "-c", "import numpy, siconos.kernel"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, errors="replace", timeout=120)
    except (OSError, subprocess.TimeoutExpired) as problem:
        return None, str(problem)
    return (options.siconos_python, "") if probe.returncode == 0 else (None, "%s cannot import siconos" % options.siconos_python)


def version():
    """Of the Debian package; Siconos' Python module doesn't tell its own."""
    try:
        found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "python3-siconos"], stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL, text=True)
        return found.stdout.strip() or "of unknown version"
    except OSError:
        return "of unknown version"


# --- matrices

def chain_matrices(chain):
    n = len(chain["masses"])
    M, K, C = ([[0.0] * n for _ in range(n)] for _ in range(3))
    for i, m in enumerate(chain["masses"]):
        M[i][i] = m
    for i, j, k, c in chain["springs"]:
        for matrix, value in ((K, k), (C, c)):
            matrix[j][j] += value
            if i is not None:
                matrix[i][i] += value
                matrix[i][j] -= value
                matrix[j][i] -= value
    a, b, gap, e = chain["contact"]
    H = [0.0] * n
    H[b] = 1.0
    if a is not None:
        H[a] = -1.0
    return dict(M=M, K=K, C=C, H=[H], gap=[gap], e=[e], q0=chain["q0"], v0=chain["v0"], f=chain["load"], r=[0.0] * n, watch=chain["watch"])


def read_matrix(path):
    """A Matrix Market file of reals as rows."""
    with open(path) as file:
        head = file.readline().split()
        lines = [line.split() for line in file if line.strip() and not line.startswith("%")]
    rows, columns = int(lines[0][0]), int(lines[0][1])
    matrix = [[0.0] * columns for _ in range(rows)]
    if "array" in head:
        for at, entry in enumerate(lines[1:]):
            matrix[at % rows][at // rows] = float(entry[0])
        return matrix
    for entry in lines[1:]:
        i, j, value = int(entry[0]) - 1, int(entry[1]) - 1, float(entry[2])
        matrix[i][j] = value
        if "symmetric" in head:
            matrix[j][i] = value
    return matrix


def read_csv(path):
    with open(path) as file:
        return [line.split(",") for line in file.read().split("\n")[1:] if line]


def exported(nsframe, case):
    """The matrices of the linear pair, as nsframe writes them; the same model in Siconos to the last digit."""
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(ROOT, "examples", case.scene, "scene.toml")
        command = [nsframe.program, "export", scene, "-q", "-o", folder]
        for key, value in case.settings.items():
            command += ["--set", "%s=%s" % (key, value)]
        measure(command)
        data = {name: read_matrix(os.path.join(folder, name + ".mtx")) for name in ("M", "K", "C", "H")}
        loads = read_matrix(os.path.join(folder, "loads.mtx"))
        dofs = {(row[1], row[2]): int(row[0]) - 1 for row in read_csv(os.path.join(folder, "dofs.csv"))}
        pairs = read_csv(os.path.join(folder, "contacts.csv"))
    n = len(data["M"])
    data.update(gap=[float(p[2]) for p in pairs], e=[float(p[3]) for p in pairs], q0=[0.0] * n, v0=[0.0] * n,
                f=[row[0] for row in loads], r=[row[1] for row in loads], watch=[dofs[node, "ux"] for node in case.nodes],
                motion=Opensees(None).record)
    return data


# --- runs

class Runs:
    """Of one case; all in one process, but for the event-driven one."""

    KEYS = ("scheme", "theta", "gamma", "dt", "solver", "limit")

    def __init__(self, python, case, nsframe, reference, options):
        self.python, self.reference = python, reference
        model = chain_matrices(case.chain) if case.chain else exported(nsframe, case)
        self.base = dict(model, duration=case.end(options), interval=INTERVAL)

    def run(self, runs, repeat):
        runs = [dict({key: run[key] for key in self.KEYS if key in run}, repeat=repeat) for run in runs]
        return judged(ask(self.python, "siconos_cases.py", dict(self.base, runs=runs))["runs"], self.reference)

    def event_driven(self, repeat):
        """A process of its own: this scheme may end its process, or not end at all."""
        run = dict(scheme="EventDriven", solver=SOLVERS[0], dt=INTERVAL, limit=EVENT_LIMIT)
        try:
            return self.run([run], repeat)
        except BenchError as problem:
            return [dict(run, failed=reason(problem))]


def rows(python, case, nsframe, reference, options):
    """Rows, what was tried, and the version."""
    runs = Runs(python, case, nsframe, reference, options)
    settings = [dict(solver=SOLVERS[0], scheme="Moreau-Jean", theta=theta, gamma=gamma, dt=dt)
                for dt in (STEPS[2:3] if options.quick else STEPS) for theta in (0.5, 1.0) for gamma in (0.5, 1.0, 1.5)]
    progress("Siconos: %d settings for the error" % len(settings))
    tried = runs.run(settings, 1)
    chosen, speeds, found = candidates(tried), [], []
    if chosen:
        typical = nearest(chosen, 1e-3)
        progress("Siconos: %d solvers for the time" % len(SOLVERS))
        quickest, speeds = fastest(lambda setting: runs.run([setting], options.runs)[0],
                                   {key: typical[key] for key in runs.KEYS if key in typical}, [("solver", SOLVERS)])
        solver = quickest["solver"]
        best = front(timed_again(chosen, runs.run([dict(run, solver=solver) for run in chosen], options.runs)))
        found = [dict(run, program="Siconos", series="Siconos, Moreau-Jean",
                      setting="Moreau-Jean, θ = %g, γ = %g; %s" % (run["theta"], run["gamma"], run["solver"])) for run in best]
    progress("Siconos: event-driven")
    found += [dict(run, program="Siconos", series="Siconos, EventDriven", setting="EventDriven, LsodarOSI; %s" % run["solver"])
              for run in runs.event_driven(options.runs)]
    return found, dict(error=tried, time=speeds), version()
