"""The figures of docs/langlade_2021.md, from results.json and curves.json alone. Needs matplotlib and numpy."""
import cases
import figures_rows
import matplotlib
import numpy as np
from histories import MICROMETRES_10, ball_height

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from style import BLACK, BLUE, GREEN, GREY, PURPLE, SKY, VERMILLION, figure_legend, legend_below, plain_logarithmic, save  # noqa: E402

STEP_STYLE = {1e-3: ("o", VERMILLION), 1e-4: ("s", BLUE), 1e-5: ("^", GREEN)}


def milliseconds(dt):
    return f"{1e3 * dt:g} ms"


def ball(results, curves, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.9), gridspec_kw={"width_ratios": [1.1, 1]})
    data = curves["ball"]
    times = np.arange(len(data["NSCD"])) / data["rate"]
    best = {p["law"]: p["best"] for p in results["ball"]["penalty"] if p["dt"] == 1e-3 and p["theta"] == 0.5}
    units = {"LVE": "N/m", "NLVE": "N/m$^{1.5}$"}
    left.plot(times, 1e3 * ball_height(times), color=GREY, lw=1, ls=":", label="height, exact")
    for name, colour, style, label in (("LVE", VERMILLION, "--", None), ("NLVE", GREEN, "-.", None), ("NSCD", BLUE, "-", "NSCD, θ = 1")):
        label = label or f"{name}, best k: {best[name]:.2g} {units[name]}, θ = ½"
        error = 1e3 * np.abs(np.array(data[name]) * MICROMETRES_10 - ball_height(times))
        left.plot(times, np.maximum(error, 1e-2), style, color=colour, lw=1.2, label=f"error of {label}")
    left.set(xlabel="time, s", ylabel="mm", title="dt = 1 ms (errors below 0.01 mm drawn there)", xlim=(0, 3.5))
    left.set(yscale="log", ylim=(8e-3, 1500))
    for penalty in results["ball"]["penalty"]:
        if penalty["theta"] == 0.5:
            marker, colour = STEP_STYLE[penalty["dt"]]
            right.loglog(results["ball"]["stiffnesses"], penalty["errors"], "-" if penalty["law"] == "LVE" else "--", color=colour, lw=1.1,
                         marker=marker, ms=3.5, mfc=colour if penalty["law"] == "LVE" else "white",
                         label=f"{penalty['law']}, {milliseconds(penalty['dt'])}")
    for nscd in results["ball"]["nscd"]:
        if nscd["theta"] == 1 and nscd["gamma"] == 1.5:
            right.axhline(nscd["error"], color=STEP_STYLE[nscd["dt"]][1], lw=2, alpha=0.5, label=f"NSCD, {milliseconds(nscd['dt'])}")
    right.set(xlabel="contact stiffness, N/m (LVE) or N/m$^{1.5}$ (NLVE)", ylabel="largest position error, m")
    right.set_title("penalty laws: θ = ½; NSCD: θ = 1")
    legend_below(left, 1)
    legend_below(right, 3)
    save(figure, folder, "ball")


def pull_back(results, curves, folder):
    figure, panels = plt.subplots(1, 3, figsize=(9.5, 3.7), sharey=True)
    data = curves["pull_back"]
    for panel, (e, schemes) in zip(panels, data["e"].items()):
        for scheme, colour, style, name in (("exact", BLUE, "-", "exact"), ("paper", VERMILLION, "--", "θ = 1, 1 ms")):
            for side, width in (("left", 1.4), ("right", 0.9)):
                values = 1e3 * np.array(schemes[scheme][side]) * MICROMETRES_10 + (20 if side == "right" else 0)
                panel.plot(np.arange(len(values)) / data["rate"], values, style, color=colour, lw=width,
                           label=f"{side} mass, {name}")
        panel.axhline(20, color=GREY, lw=0.6, ls=":")
        panel.set(title=f"e = {e}", xlabel="time, s", xlim=(0, 1.5))
    panels[0].set_ylabel("position of the faces, mm")
    figure_legend(figure, panels[0], 4)
    save(figure, folder, "pull_back")


def penalty(results, curves, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4))
    data = curves["penalty"]
    for name, colour, style in (("exact", BLACK, "-"), ("0.01", VERMILLION, "--"), ("1", GREEN, "-."), ("100", BLUE, "-")):
        values = 1e3 * np.array(data[name]["left"]) * MICROMETRES_10
        exact = name == "exact"
        left.plot(np.arange(len(values)) / data["rate"], values, style, color=colour, lw=3 if exact else 1.2, alpha=0.25 if exact else 1,
                  label="Newton's impacts, exact" if exact else f"LVE, k$_s$ = {name} max(k$_1$, k$_2$)")
    left.set(xlabel="time, s", ylabel="displacement of the left mass, mm", title="θ = ½, 1 ms, e = 0.65", xlim=(0, 1.5))
    for series in results["penalty"]["series"]:
        if series["theta"] == 0.5:
            marker, colour = STEP_STYLE[series["dt"]]
            linear = series["law"] == "LVE"
            right.loglog(results["penalty"]["ratios"], 1e3 * np.array(series["errors"]), "-" if linear else "--", color=colour, lw=1.1,
                         marker=marker, ms=4, mfc=colour if linear else "white", label=f"{series['law']}, {milliseconds(series['dt'])}")
    right.set(xlabel="k$_s$ / max(k$_1$, k$_2$)", ylabel="largest displacement error, mm", title="θ = ½; error of 24 mm pulled")
    legend_below(left, 2)
    legend_below(right, 3)
    save(figure, folder, "penalty")


def identification(results, folder):
    figure, panel = plt.subplots(figsize=(6.4, 3.9))
    data = results["identification"]
    for fit, colour, style, label in (("asked", VERMILLION, "--", "θ = 1 fitted exactly, damping as asked (0.5 %)"),
                                      ("effective", BLUE, "-", "θ = 1 fitted exactly, damping as the scheme gives it"),
                                      ("by_paper", GREEN, "-.", "exact motion fitted with θ = 1, 1 ms")):
        panel.plot(data["restitutions"], 1e3 * np.array(data[fit]["misfits"]), style, color=colour, lw=1.4, label=label)
        panel.plot(data[fit]["e"], 1e3 * data[fit]["misfit"], "o", color=colour, ms=5)
    panel.axvline(0.6, color=GREY, lw=0.8, ls=":")
    panel.set(xlabel="restitution e of the fit (0.6 in the motion that is fitted)", ylabel="rms difference of displacements, mm")
    panel.set(xlim=(0, 1), ylim=(0, None))
    legend_below(panel, 1)
    save(figure, folder, "identification")


def spectra(curves, folder):
    data = curves["floor_spectra"]
    styles = {"no contact": (GREY, ":", "no contact"), "converged, e = 0.2": (SKY, "-.", "exact, e = 0.2"),
              "converged, e = 0.6": (BLUE, "-", "exact, e = 0.6"), "converged, e = 0.9": (PURPLE, "-.", "exact, e = 0.9"),
              "paper": (VERMILLION, "--", "θ = 1, 1 ms, e = 0.6"), "converged": (BLUE, "-", "exact, flexible slabs"),
              "converged, rigid slabs": (GREEN, "-.", "exact, rigid slabs")}
    for table, floors, periods, file in (("table_5", cases.PlaneFrame.floors, (1 / 3.50, 1 / 6.55), "plane_spectra"),
                                         ("table_8", cases.TwoStory.floors, (1 / 2.10, 1 / 3.69), "two_story_spectra")):
        figure, panels = plt.subplots(2, 2, figsize=(9, 6.4), sharex=True)
        for column, ((side, node), period) in enumerate(zip(floors.items(), periods)):
            for name, found in data[table].items():
                colour, style, label = styles[name]
                for row, kind in enumerate(("psv", "psa")):
                    panels[row, column].plot(data["periods"], found[node][kind], style, color=colour, lw=1.3, label=label)
            for row in (0, 1):
                panels[row, column].set_xscale("log")
                panels[row, column].set_yscale("log")
                plain_logarithmic(panels[row, column].xaxis)
                plain_logarithmic(panels[row, column].yaxis)
                panels[row, column].axvline(period, color=BLACK, lw=0.7, ls=":")
            panels[0, column].set_title(f"{side} {'floor' if table == 'table_5' else 'roof'} (dots: its fundamental period)")
            panels[1, column].set_xlabel("period, s")
        panels[0, 0].set_ylabel("PSV, m/s")
        panels[1, 0].set_ylabel("PSA, m/s²")
        figure_legend(figure, panels[0, 0], 3)
        save(figure, folder, file)


def difference_quotients(curves, folder):
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True, sharex=True)
    data = curves["floor_spectra"]
    for panel, way, title in ((panels[0], "difference", "from accelerations Δv/h"), (panels[1], "jumps", "impacts as jumps of velocity")):
        for (step, found), (colour, style) in zip(data["steps"].items(), ((VERMILLION, "-"), (BLUE, "--"), (GREEN, ":"))):
            panel.loglog(data["step_periods"], found[way], style, color=colour, lw=1.6, label=f"kept each {milliseconds(float(step))}")
        panel.set(xlabel="period, s", title=title)
        plain_logarithmic(panel.xaxis)
        plain_logarithmic(panel.yaxis)
    panels[0].set_ylabel("PSA of the left floor, m/s²")
    panels[0].legend(frameon=False)
    save(figure, folder, "difference_quotients")


def draw(results, curves, folder):
    plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "axes.titlesize": 9, "legend.fontsize": 8,
                         "axes.spines.top": False, "axes.spines.right": False})
    ball(results, curves, folder)
    pull_back(results, curves, folder)
    penalty(results, curves, folder)
    identification(results, folder)
    spectra(curves, folder)
    difference_quotients(curves, folder)
    figures_rows.draw(results, curves, folder)
