"""Tables of docs/langlade_2021.md from results.json. Standard library only."""
import cases
from program import command_text

MOTION_NAMES = {"cadarache": "Cadarache (stand-in)", "el_centro": "El Centro", "northridge": "Northridge", "kobe": "Kobe"}
NOT_GIVEN = "record not given"


def table(heading, rows):
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def mm(metres, digits=3):
    return f"{1e3 * metres:.{digits}g}"


def mm1(metres):
    return f"{1e3 * metres:.1f}"


HEADINGS = ("PEER NGA STRONG MOTION DATABASE RECORD", "PACIFIC ENGINEERING AND ANALYSIS STRONG-MOTION DATA")


def recorded(description):
    """What a file says of its record, without what every file of its source says."""
    return next((part.strip() for part in description.split(";") if part.strip() not in HEADINGS), description)


def scientific(value, digits=2):
    """1.5e-3 in place of 0.0015 and 1.50e-03."""
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def stepped(dt):
    return f"{1e3 * dt:g} ms"


def row_name(row):
    return f"{MOTION_NAMES[row['motion']]} {row['pga']:.2f} g"


def found_of(results, system, row):
    return results[system.name]["rows"].get(row["id"])


def figure(name, caption):
    return f"![{name.replace('_', ' ')}](images/langlade_2021/{name}.png)\n\n*{caption}*\n"


def found_rows(results, system):
    return [(row, found) for row, found in each(results, system) if found]


def same_counts(rows):
    """Rows in which an exact solution with the damping of the paper's scheme has that scheme's count."""
    return sum(found["paper"]["buildings"] == found["damped_as_paper"]["buildings"] for _, found in rows)


def energy_share(found, key):
    """Of what leaves the frames under the paper's scheme, in percent."""
    energy = found["paper"]["energy"]
    return 100 * energy[key] / (energy["numerical"] + energy["damping"] + energy["contact"])


def each(results, system):
    """(row, what was found or None)"""
    return [(row, found_of(results, system, row)) for row in system.rows]


def counts_told(run, corners):
    return f"{run['buildings']} ({run['pairs']})" if corners else str(run["buildings"])


def records(results):
    """The record of every motion, with what it is instead of the paper's."""
    rows = []
    for motion, told in cases.MOTIONS.items():
        entry = next((found["record"] for system in cases.SYSTEMS for row, found in found_rows(results, system)
                      if row["motion"] == motion), None)
        if entry is None:
            rows.append([told["paper"], NOT_GIVEN, "", "", "", told["difference"]])
            continue
        if entry["made"]:
            options = " ".join(f'"{part}"' if " " in part else part for part in cases.ARTIFICIAL)
            used = f"`nsframe motion artificial {options} --seed {cases.SEED}`"
        else:
            used = f"{recorded(entry['description'])} (`{entry['file']}`)"
        where = "made by the script" if entry["made"] else "shipped" if entry["shipped"] else "**not shipped**"
        rows.append([told["paper"], used, where, f"{entry['pga_g']:.3f} g", f"{entry['pgv']:.3f} m/s", told["difference"]])
    return table(["motion of the paper", "record used here", "file", "PGA", "PGV", "difference"], rows)


def ball_nscd(results):
    rows = [[f"{run['theta']:g}", f"{run['gamma']:g}", stepped(run["dt"]), f"{scientific(run['error'])} m"]
            for run in results["ball"]["nscd"]]
    return table(["θ", "γ", "step", "largest position error"], rows)


def ball_penalty(results):
    rows = []
    for run in results["ball"]["penalty"]:
        unit = "N/m" if run["law"] == "LVE" else "N/m^1.5"
        best = [f"{scientific(run['best'])} {unit}", f"{scientific(run['best_error'])} m"]
        rows.append([run["law"], f"{run['theta']:g}", stepped(run["dt"]), *best])
    return table(["law", "θ", "step", "stiffness of the least error", "largest position error"], rows)


def pull_back(results):
    names = (("paper", "θ = 1, γ = 3/2, 1 ms"), ("paper, 0.1 ms", "the same at 0.1 ms"), ("half", "θ = ½, γ = 3/2, 1 ms"),
             ("exact", "exact"))
    rows = []
    for e, runs in results["pull_back"]["restitutions"].items():
        for name, label in names:
            run = runs[name]
            error = "0" if name == "exact" else mm(run["error"], 2)
            times, impulses = (", ".join(f"{value:{form}}" for value in run[key]) for key, form in (("at", ".4f"), ("impulses", ".0f")))
            rows.append([e, label, run["poundings"], times, impulses, error])
    return table(["e", "scheme", "impacts", "at, s", "impulses, N s", "largest error, mm"], rows)


def pulls(results):
    found = results["pull_back"]["pulls"]
    rows = [[label, *[run[name] for run in found.values()]] for name, label in (("paper", "θ = 1, 1 ms"), ("exact", "exact"))]
    return table(["pulled by, cm", *found], rows)


def penalty(results, law):
    data = results["penalty"]
    series = [s for s in data["series"] if s["law"] == law]
    rows = []
    for i, ratio in enumerate(data["ratios"]):
        finest = next(s for s in series if s["theta"] == 0.5 and s["dt"] == 1e-5)
        cells = [f"{s['poundings'][i]}, {mm(s['errors'][i], 3)}" for s in series]
        rows.append([f"{ratio:g}", f"{1e3 * finest['durations'][i]:.2g}", *cells])
    return table(["k_s over the stiffer body's", "contact lasts, ms"] + [f"θ = {s['theta']:g}, {stepped(s['dt'])}" for s in series], rows)


def rows_told(results, system):
    """The table of the issue: paper's counts, ours under the paper's scheme and converged."""
    corners = system is cases.TwoStory
    rows = []
    for row, found in each(results, system):
        what = [f"{100 * row['ratios'][0]:g}–{100 * row['ratios'][1]:g}"] if not corners else [f"{row['gaps'][0]:g} / {row['gaps'][1]:g}"]
        head = [row_name(row), *what, row["simulated"], row["measured"]]
        if found is None:
            rows.append(head + [NOT_GIVEN] + [""] * 5)
            continue
        cells = [counts_told(found[name], corners) for name in ("paper", "fine", "half", "converged", "damped_as_paper")]
        peaks = [" / ".join(mm1(found[name]["peak"][side]) for side in ("left", "right")) for name in ("paper", "converged")]
        rows.append(head + cells + [f"{peaks[0]}; {peaks[1]}"])
    return table(["motion", "gaps, cm" if corners else "ξ1–ξ2, %", "paper, simulated", "paper, measured",
                  "ours, paper's scheme: θ = 1, γ = 3/2, 1 ms", "θ = 1, 0.1 ms", "θ = γ = ½, 1 ms", "**converged** (`exact`)",
                  "`exact`, damped as the paper's scheme damps", "peaks left / right, mm: paper's scheme; converged"], rows)


def variations(results, system):
    """Counts as 'paper's scheme, converged', one thing varied at a time."""
    names = list(cases.variations(system, system.rows[0]))
    rows = []
    for row, found in each(results, system):
        if found is None:
            rows.append([row_name(row), NOT_GIVEN] + [""] * len(names))
            continue
        cells = [f"{found['paper']['buildings']}, {found['converged']['buildings']}"]
        cells += [f"{found['variations'][name]['paper']}, {found['variations'][name]['converged']}" for name in names]
        rows.append([row_name(row), *cells])
    return table(["motion", "as in the table", *[name.replace("x 0.5", "halved").replace("x 2", "doubled") for name in names]], rows)


def other_records(results):
    rows = []
    for system in cases.SYSTEMS:
        for row, found in each(results, system):
            if found is None:
                continue
            label = f"{row_name(row)}, Table {5 if system is cases.PlaneFrame else 8}"
            rows.append([label, "as above", found["paper"]["buildings"], found["converged"]["buildings"]])
            rows += [["", recorded(name), counts["paper"], counts["converged"]] for name, counts in found.get("records", {}).items()]
    return table(["row", "record", "paper's scheme", "converged"], rows)


def counting(results):
    rows = []
    for row, found in each(results, cases.TwoStory):
        if found:
            keys = ("impacts", "pairs", "buildings", "buildings_100_ms")
            rows.append([row_name(row)] + [found[name][key] for name in ("paper", "converged") for key in keys])
    what = ["impulses", "poundings of corners", "of the buildings, 20 ms", "100 ms"]
    return table(["motion", *[f"paper's scheme: {w}" for w in what], *[f"converged: {w}" for w in what]], rows)


def frequencies(results):
    rows = []
    for side, number in (("left", 1), ("right", 2)):
        ours, rigid = results["table_7"]["flexible"][side], results["table_7"]["rigid"][side]
        rows.append([f"structure {number}, measured (paper)", *[f"{value:g}" for value in cases.TABLE_7_MEASURED[side]]])
        rows.append(["model (paper)", *[f"{value:g}" for value in cases.TABLE_7_MODEL[side]]])
        rows.append(["nsframe, flexible slabs", *[f"{value:.4g}" for value in ours]])
        differences = [f"{100 * (a / b - 1):+.1f} %".replace("-0.0", "+0.0") for a, b in zip(ours, cases.TABLE_7_MODEL[side])]
        rows.append(["difference from the paper's model", *differences])
        rows.append(["nsframe, rigid slabs", *[f"{value:.4g}" for value in rigid]])
    return table(["Hz", "1L", "2L", "1T", "2T", "1To", "2To"], rows)


def slabs(results):
    rows = []
    for row, found in each(results, cases.TwoStory):
        if found is None:
            rows.append([row_name(row), NOT_GIVEN] + [""] * 7)
            continue
        for label, runs in (("flexible", found), ("rigid", found["rigid"])):
            for scheme, name in (("converged", "converged"), ("paper", "paper's")):
                run = runs[scheme]
                rows.append([row_name(row) if label == "flexible" and scheme == "converged" else "", label, name, counts_told(run, True),
                             "–" if run["first_impulse"] is None else f"{run['first_impulse']:.0f}", f"{run['impulse']:.0f}",
                             "–" if run["restitution"] is None else f"{run['restitution']:.2f}",
                             " / ".join(mm1(run["peak"][side]) for side in ("left", "right")),
                             " / ".join(f"{1e3 * run['twist'][side]:.2f}" for side in ("left", "right"))])
    return table(["motion", "slabs", "scheme", "poundings (of corners)", "first impulse, N s", "sum of impulses, N s", "median restitution",
                  "roof peaks, mm", "roof twists, mrad"], rows)


def steel(results):
    rows = []
    for row, found in each(results, cases.TwoStory):
        if found:
            counts = [counts_told(runs[scheme], True) for runs in (found, found["S355"], found["S235"]) for scheme in cases.SCHEMES]
            rows.append([row_name(row), f"{row['simulated']} / {row['measured']}", *counts])
    return table(["motion", "paper, simulated / measured"] + [f"{name}: {scheme}" for name in ("elastic", "355 MPa", "235 MPa")
                                                              for scheme in ("paper's scheme", "converged")], rows)


def damping(results):
    rows = []
    frames = results["table_5"]["rows"]["el_centro_045"]["added_damping"]
    for side, f in (("left", 3.50), ("right", 6.55)):
        rows.append([f"plane frame, {side}", f"{f:.2f}", "0.50", f"{100 * (0.005 + frames[side]['L1']):.2f}"])
    story = results["table_8"]["rows"]["el_centro_030"]["added_damping"]
    for side in ("left", "right"):
        for mode, f, ratio in zip(cases.MODES, results["table_7"]["flexible"][side], cases.TABLE_6[side]):
            rows.append([f"two-story, {side}, {mode}", f"{f:.2f}", f"{100 * ratio:.1f}", f"{100 * (ratio + story[side][mode]):.2f}"])
    return table(["mode", "Hz", "asked for, %", "what θ = 1 at 1 ms makes of it, %"], rows)


def energy_shares(results):
    rows = [[f"{row_name(row)}, Table {5 if system is cases.PlaneFrame else 8}"]
            + [f"{energy_share(found, key):.0f} %" for key in ("numerical", "damping", "contact")]
            for system in cases.SYSTEMS for row, found in found_rows(results, system)]
    return table(["row", "the scheme", "damping asked for", "impacts"], rows)


def commands():
    lines = []
    for system in cases.SYSTEMS:
        for row in system.rows:
            settings = {"motion.file": f"/path/to/{row['motion'].upper()}.at2", **cases.motion_settings(row), **system.gap(row)}
            if system is cases.PlaneFrame:
                settings.update(system.damping(row))
            if row["motion"] == "el_centro":
                del settings["motion.file"]
            lines.append(command_text(system.scene, settings))
    return "    " + "\n    ".join(lines) + "\n"
