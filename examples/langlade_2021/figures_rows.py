"""Figures of the rows of Tables 5 and 8: counts, histories, what the scheme does. Needs matplotlib and numpy."""
import cases
import matplotlib
import numpy as np
from histories import MICROMETRES_10

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from style import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILLION, figure_legend, legend_below, plain_logarithmic, save  # noqa: E402

SCHEME_STYLE = {"converged": (BLUE, "-", "converged (exact)"), "paper": (VERMILLION, "--", "paper's scheme (θ = 1, 1 ms)")}
MOTION_NAMES = {"cadarache": "stand-in for Cadarache", "el_centro": "El Centro", "northridge": "Northridge", "kobe": "Kobe"}


def row_name(row):
    return f"{MOTION_NAMES[row['motion']]}, {row['pga']:.2f} g"


def measured_rows(results, system):
    return [(row, results[system.name]["rows"][row["id"]]) for row in system.rows if row["id"] in results[system.name]["rows"]]


def counts(results, folder):
    """Of every row the paper's two counts, ours, and the range that the variations give."""
    figure, panels = plt.subplots(1, 2, figsize=(9.5, 4.6))
    for panel, system, title in zip(panels, cases.SYSTEMS, ("Table 5, plane frames", "Table 8, two-story frames")):
        rows = measured_rows(results, system)
        for y, (row, found) in enumerate(rows):
            for scheme, offset in (("paper", 0.14), ("converged", -0.14)):
                colour, _, label = SCHEME_STYLE[scheme]
                varied = [counts[scheme] for counts in found["variations"].values()] + [found[scheme]["buildings"]]
                panel.plot([min(varied), max(varied)], [y + offset] * 2, color=colour, lw=4, alpha=0.3, solid_capstyle="butt",
                           label=f"{label}: range with gap, e, damping" if y == 0 else None)
                panel.plot(found[scheme]["buildings"], y + offset, "o" if scheme == "converged" else "s", color=colour, ms=5.5,
                           label=label if y == 0 else None)
            panel.plot(row["simulated"], y, "x", color=BLACK, ms=7, mew=1.6, label="paper, simulated" if y == 0 else None)
            panel.plot(row["measured"], y, "D", mfc="none", mec=BLACK, ms=8, label="paper, measured" if y == 0 else None)
        panel.set_yticks(range(len(rows)), [row_name(row) for row, _ in rows])
        panel.invert_yaxis()
        panel.set(xlabel="poundings of the buildings", title=title, xlim=(-1.2, None))
    figure_legend(figure, panels[0], 3)
    save(figure, folder, "counts")


def plane_histories(results, curves, folder):
    rows = measured_rows(results, cases.PlaneFrame)
    figure, panels = plt.subplots(len(rows), 1, figsize=(9, 1.75 * len(rows)), squeeze=False)
    for panel, (row, _) in zip(panels[:, 0], rows):
        for scheme in SCHEME_STYLE:
            found = curves["rows"][f"table_5_{row['id']}"][scheme]
            colour, style, label = SCHEME_STYLE[scheme]
            for node, offset, width in (("left.4", 0, 1.2), ("right.3", 20, 0.8)):
                values = 1e3 * MICROMETRES_10 * np.array(found["nodes"][node]) + offset
                panel.plot(found["start"] + np.arange(len(values)) / found["rate"], values, style, color=colour, lw=width,
                           label=label if offset == 0 else None)
            y = 46 if scheme == "converged" else 41
            marker = "v" if scheme == "converged" else "|"
            panel.plot(found["poundings"], [y] * len(found["poundings"]), marker, color=colour, ms=5, mew=1.5)
        panel.set(xlim=(found["start"], found["start"] + 10), ylim=(-42, 50), ylabel="mm")
        panel.set_title(row_name(row), loc="left")
    panels[-1, 0].set_xlabel("time, s")
    figure_legend(figure, panels[0, 0], 2, 0.005)
    save(figure, folder, "plane_histories")


def two_story_histories(results, curves, folder):
    rows = measured_rows(results, cases.TwoStory)
    figure, panels = plt.subplots(len(rows), 2, figsize=(10, 1.95 * len(rows)), squeeze=False, sharey="col",
                                gridspec_kw={"width_ratios": [1.6, 1]})
    for (displacement, twist), (row, _) in zip(panels, rows):
        for scheme in SCHEME_STYLE:
            found = curves["rows"][f"table_8_{row['id']}"][scheme]
            colour, style, label = SCHEME_STYLE[scheme]
            nodes = {node: 1e3 * MICROMETRES_10 * np.array(values) for node, values in found["nodes"].items()}
            times = found["start"] + np.arange(len(nodes["left.22"])) / found["rate"]
            displacement.plot(times, nodes["left.22"], style, color=colour, lw=1.2, label=label)
            displacement.plot(times, nodes["right.21"] + 10 * row["gaps"][0], style, color=colour, lw=0.8)
            twist.plot(times, nodes["left.22"] - nodes["left.23"], style, color=colour, lw=1.0, label=label)
        displacement.set_title(row_name(row), loc="left")
        displacement.set_ylabel("mm")
        for panel in (displacement, twist):
            panel.set_xlim(times[0], times[0] + 10)
    panels[0, 0].set_title(f"corners at the narrow gap: {row_name(rows[0][0])}", loc="left")
    panels[0, 1].set_title("left roof: corner at the narrow less that at the wide gap", loc="left")
    for panel in panels[-1]:
        panel.set_xlabel("time, s")
    figure_legend(figure, panels[0, 0], 2, 0.005)
    save(figure, folder, "two_story_histories")


def added_damping(results, folder):
    """What theta = 1 at 1 ms gives each mode, and where the input energy of every row goes under the paper's scheme."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.3))
    frequency = np.linspace(1, 30, 200)
    for step, style in ((1e-3, "-"), (1e-4, "--")):
        left.plot(frequency, 100 * np.pi * frequency * step, style, color=GREY, lw=1.2,
                  label=f"added by θ = 1 at {1e3 * step:g} ms, about ωh/2")
    frames = results["table_5"]["rows"]["el_centro_045"]
    pairs = [(f, frames["added_damping"][side]["L1"], 0.005) for side, f in (("left", 3.50), ("right", 6.55))]
    story = results["table_8"]["rows"]["el_centro_030"]["added_damping"]
    pairs += [(f, story[side][mode], ratio) for side in story
              for mode, f, ratio in zip(cases.MODES, results["table_7"]["flexible"][side], cases.TABLE_6[side])]
    hertz, added, asked = (np.array(column) for column in zip(*pairs))
    left.plot(hertz, 100 * asked, "D", mfc="none", mec=BLACK, ms=5, label="asked for (Tables 5, 6)")
    left.plot(hertz, 100 * (asked + added), "s", color=VERMILLION, ms=4.5, label="what the modes get at 1 ms")
    left.set(xlabel="frequency, Hz", ylabel="damping ratio, %", yscale="log", ylim=(0.08, 20))
    legend_below(left, 1)
    names, shares = [], []
    for system in cases.SYSTEMS:
        for row, found in measured_rows(results, system):
            energy = found["paper"]["energy"]
            total = energy["damping"] + energy["contact"] + energy["numerical"]
            names.append(f"{row_name(row)} ({'T5' if system is cases.PlaneFrame else 'T8'})")
            shares.append([100 * energy[key] / total for key in ("numerical", "damping", "contact")])
    begin = np.zeros(len(names))
    for column, (label, colour) in enumerate((("the scheme", VERMILLION), ("damping asked for", ORANGE), ("impacts", BLUE))):
        widths = np.array([share[column] for share in shares])
        right.barh(range(len(names)), widths, left=begin, color=colour, label=label)
        begin += widths
    right.set_yticks(range(len(names)), names, fontsize=7.5)
    right.invert_yaxis()
    right.set(xlabel="energy taken out in a run with θ = 1 at 1 ms, %", xlim=(0, 100))
    legend_below(right, 3)
    save(figure, folder, "added_damping")


def steps(results, folder):
    shown = [(system, row) for system in cases.SYSTEMS for row in system.rows if "steps" in results[system.name]["rows"].get(row["id"], {})]
    figure, panels = plt.subplots(1, len(shown), figsize=(9.5, 3.5), squeeze=False)
    for panel, (system, row) in zip(panels[0], shown):
        found = results[system.name]["rows"][row["id"]]
        for theta, colour, marker, style in (("1", VERMILLION, "s", "--"), ("0.5", GREEN, "^", "-")):
            values = found["steps"][theta]
            panel.semilogx([1e3 * float(dt) for dt in values], list(values.values()), style, color=colour, marker=marker, ms=5, lw=1.2,
                           label=f"θ = {'½' if theta == '0.5' else theta}")
        panel.axhline(found["converged"]["buildings"], color=BLUE, lw=2, alpha=0.5, label="exact")
        panel.axhline(row["simulated"], color=BLACK, lw=1, ls=":", label="paper, simulated")
        panel.axhline(row["measured"], color=BLACK, lw=1, ls="-.", label="paper, measured")
        panel.set(xlabel="step, ms", title=f"{'plane' if system is cases.PlaneFrame else 'two-story'}, {row_name(row)}", ylim=(-0.5, None))
        plain_logarithmic(panel.xaxis)
        panel.invert_xaxis()
    panels[0, 0].set_ylabel("poundings of the buildings")
    figure_legend(figure, panels[0, 0], 5)
    save(figure, folder, "steps")


def draw(results, curves, folder):
    counts(results, folder)
    plane_histories(results, curves, folder)
    two_story_histories(results, curves, folder)
    added_damping(results, folder)
    steps(results, folder)
