"""Tables 5 and 8: every row under the paper's scheme and converged, and how its count moves. Needs h5py and numpy.

A row whose record is not given keeps what results.json has of it, record and all.
"""
import cases
import histories
from program import building_poundings, modes, outcome

SHOWN = {"table_5": ["left.4", "right.3"], "table_8": ["left.22", "left.23", "right.21", "right.24"]}
LENGTH = 10.0  # [s] of the histories in the figures
STEPS = {"table_5": (5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5), "table_8": (5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5)}
STEPPED = {"table_5": ("el_centro_040", "el_centro_045"), "table_8": ("el_centro_030",)}


def count(summary):
    return len(building_poundings(summary))


def both(jobs, name, system, settings, read):
    for scheme, analysis in cases.SCHEMES.items():
        jobs[(*name, scheme)] = (system.scene, {**settings, **analysis}, read)


def counted(folder, summary):
    return count(summary)


def first_runs(system, row, record, rate):
    """Jobs of a row that later ones need: with histories under both schemes, and the modes of the paper's."""
    kept = histories.kept(dict.fromkeys([*SHOWN[system.name], *system.floors.values()]), rate)  # peaks are told of kept nodes only
    settings = {**cases.row_settings(system, row, record.file), **kept}

    def read(folder, summary):
        times, columns = histories.displacements(folder)
        shown = {node: columns[node] for node in SHOWN[system.name]}
        return {**outcome(summary, system.floors), "modes": modes(summary), "histories": (times, shown)}

    jobs = {}
    both(jobs, (system.name, row["id"]), system, settings, read)
    return jobs


def later_runs(system, row, record, others, ratios):
    """Jobs whose results are counts of poundings of the buildings, or whole outcomes."""
    name, base = (system.name, row["id"]), cases.row_settings(system, row, record.file)

    def told(folder, summary):
        return outcome(summary, system.floors)

    jobs = {}
    for variation, settings in cases.variations(system, row).items():
        both(jobs, (*name, "variations", variation), system, {**base, **settings}, counted)
    for label, other in others.items():
        both(jobs, (*name, "records", label), system, {**base, "motion.file": other.file}, counted)
    jobs[(*name, "fine")] = (system.scene, {**base, **cases.FINE_SCHEME}, told)
    jobs[(*name, "half")] = (system.scene, {**base, **cases.HALF_SCHEME}, told)
    jobs[(*name, "damped_as_paper")] = (system.scene, {**base, **cases.EXACT_SCHEME, **system.damping(row, ratios=ratios)}, told)
    if system is cases.TwoStory:
        both(jobs, (*name, "rigid"), system, {**base, **cases.RIGID_SLABS}, told)
        for strength in (235, 355):
            steel = {**base, **cases.yielding(strength)}
            jobs[(*name, f"S{strength}", "paper")] = (system.scene, {**steel, **cases.PAPER_SCHEME}, told)
            jobs[(*name, f"S{strength}", "converged")] = (system.scene, {**steel, **cases.YIELDING_SCHEME}, told)
    if row["id"] in STEPPED[system.name]:
        for theta in (1, 0.5):
            for dt in STEPS[system.name]:
                stepping = {"analysis.scheme": "moreau-jean", "analysis.theta": theta, "analysis.gamma": 1.5, "analysis.dt": dt}
                jobs[(*name, "steps", f"{theta:g}", f"{dt:g}")] = (system.scene, {**base, **stepping}, counted)
    return jobs


def put(tree, path, value):
    for part in path[:-1]:
        tree = tree.setdefault(part, {})
    tree[path[-1]] = value


def curves_of(runs, rate):
    """Ten seconds from 1.5 s before the first converged pounding on; the first ten where there is none."""
    begin = max(0.0, round(runs["converged"]["times"][0] - 1.5, 1)) if runs["converged"]["times"] else 0.0
    found = {}
    for scheme, run in runs.items():
        times, columns = run["histories"]
        found[scheme] = {**histories.window(times, columns, begin, LENGTH, rate),
                         "poundings": [t for t in run["times"] if begin <= t <= begin + LENGTH]}
    return found


def measure(program, records, results, curves):
    """Fills results[table]["rows"] and curves for the rows whose record is there; the others stay as they are."""
    chosen = [(system, row, *records[row["motion"]]) for system in cases.SYSTEMS for row in system.rows
              if records.get(row["motion"], (None,))[0]]
    rates = {row["id"]: 100 if row["motion"] == "el_centro" else 50 for _, row, _, _ in chosen}
    first, later = {}, {}
    for system, row, record, _ in chosen:
        first.update(first_runs(system, row, record, rates[row["id"]]))
    first = program.run_all(first)
    for system, row, record, others in chosen:
        ratios = system.effective_ratios(first[system.name, row["id"], "paper"]["modes"])
        later.update(later_runs(system, row, record, others, ratios))
    # the longest first, so that both processes end together
    long = ("S355", "S235", "5e-05", "2e-05")
    found = program.run_all(dict(sorted(later.items(), key=lambda job: not any(part in long for part in job[0]))))
    later = {name: found[name] for name in later}

    for system, row, record, others in chosen:
        name = (system.name, row["id"])
        runs = {scheme: first[(*name, scheme)] for scheme in cases.SCHEMES}
        curves["rows"][f"{system.name}_{row['id']}"] = curves_of(runs, rates[row["id"]])
        earlier = {} if others else results[system.name]["rows"].get(row["id"], {}).get("records", {})
        # counts of other records stay when none is given now
        entry = {"record": record.told, "records": {k: v for k, v in earlier.items() if k != record.measured["description"]}}
        for scheme, run in runs.items():
            entry[scheme] = {key: value for key, value in run.items() if key not in ("histories", "modes")}
        entry["added_damping"] = {side: {mode: round(m["added"], 5) for mode, m in of.items() if mode in cases.MODES}
                                  for side, of in runs["paper"]["modes"].items()}
        for path, value in later.items():
            if path[:2] == name:
                put(entry, path[2:], value)
        results[system.name]["rows"][row["id"]] = entry
    if "table_7" not in results or ("table_8", "el_centro_030", "paper") in first:
        results["table_7"] = frequencies(program)


def frequencies(program):
    """Of flexible and rigid slabs, and the size of the model."""
    still = {"analysis.duration": 1e-3, "analysis.dt": 1e-3}
    found = {}
    for slabs, settings in (("flexible", {}), ("rigid", cases.RIGID_SLABS)):
        summary = program.run(cases.TwoStory.scene, {**still, **settings})
        found[slabs] = {side: [float(f"{of[mode]['frequency']:.6g}") for mode in cases.MODES] for side, of in modes(summary).items()}
        found[f"{slabs}_size"] = {"nodes": summary["nodes"], "elements": summary["elements"], "dofs": summary["dofs"]}
    return found
