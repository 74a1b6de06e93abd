"""Tables and diagram of work_precision.py: Markdown, and SVG and PNG where matplotlib can be imported."""
import os

from harness import number, table
from precision_runs import SAME, done

PEERS = ("OpenSees", "Siconos")
HALF, PAPER = "moreau-jean, θ = γ = 1/2", "moreau-jean, θ = 1, γ = 3/2"
STYLE = {"exact": ("*", "#c1272d"), "exponential": ("o", "#0b5fa5"), HALF: ("s", "#4c9f70"), PAPER: ("v", "#9bc48a"),
         "OpenSees": ("D", "#e08214"), "Siconos, Moreau-Jean": ("^", "#8a4fbf"), "Siconos, EventDriven": ("P", "#5b3a8c")}


def compared(rows):
    """For each row of a peer: nsframe's cheapest row of no larger error, and the ratio of times."""
    own = [row for row in done(rows) if row["program"] == "nsframe"]
    result = []
    for row in done(rows):
        if row["program"] == "nsframe":
            continue
        better = min((r for r in own if r["error_m"] <= row["error_m"]), key=lambda r: r["cpu_s"], default=None)
        result.append(dict(program=row["program"], peer=row["series"], setting=row["setting"], dt=row["dt"], error_m=row["error_m"],
                           cpu_s=row["cpu_s"], nsframe=better and "%s, dt = %g ms" % (better["setting"], 1e3 * better["dt"]),
                           nsframe_error_m=better and better["error_m"], nsframe_cpu_s=better and better["cpu_s"],
                           part=better and better["cpu_s"] / row["cpu_s"]))
    return result


def part_text(part):
    """Of a peer's time: 1/42, or 1.3 where it is more."""
    if part is None:
        return "never as accurate"
    return "%s" % number(part, 2) if part > 0.5 else "1/%s" % number(1 / part, 2)


def span(values, text):
    first, last = text(min(values)), text(max(values))
    return first if first == last else "%s to %s" % (first, last)


def verdict(case, program):
    """Of one case and peer, whether the goal holds: cells of the first table."""
    rows = [c for c in case["compared"] if c["program"] == program]
    if not rows:
        return None
    parts = [c["part"] for c in rows]
    goal = case["goal"]
    kept = [part is not None and part <= goal for part in parts]
    holds = "yes" if all(kept) else "no" if not any(kept) else "at %d of %d" % (sum(kept), len(kept))
    known = [part for part in parts if part is not None]
    share = ("%s to %s" % (part_text(max(known)), part_text(min(known))) if len(known) > 1 else part_text(known[0])) if known else "–"
    if len(known) < len(parts):
        share += "; never as accurate as %d of its runs" % (len(parts) - len(known))
    return [case["title"], program, span([1e3 * c["error_m"] for c in rows], number), span([1e3 * c["cpu_s"] for c in rows], number), share,
            "1/%g" % (1 / goal) if goal < 1 else "1", holds]


def verdicts(data):
    lines = [line for case in data["cases"].values() for program in PEERS for line in [verdict(case, program)] if line]
    if not lines:
        return ""
    return ("Time that nsframe needs at the errors that a peer reaches, as a part of the peer's:\n\n" + table(
        ["case", "peer", "its errors, mm", "its CPU, ms", "nsframe's part of its time", "goal", "holds"], lines) + "\n")


def label(run):
    if "solver" in run:
        return run["solver"]
    return ", ".join(["%s" % run[key] for key in ("system", "algorithm", "damping") if isinstance(run.get(key), str)]
                     + ["tolerance %g" % run["tolerance"]])


def tried_text(program, tried):
    """What was tried: how many settings for the error, with the best and the worst at each step, and every one for the time."""
    error, time = tried.get("error", []), tried.get("time", [])
    lines = []
    if error:
        at = {dt: [run["error_m"] for run in done(error) if run["dt"] == dt] for dt in {run["dt"] for run in done(error)}}
        spans = "; ".join("%g ms %s to %s m" % (1e3 * dt, number(min(e)), number(max(e))) for dt, e in sorted(at.items(), reverse=True))
        lines.append("%s: %d settings tried for the error (%d failed; error at %s)" % (
            program, len(error), len(error) - len(done(error)), spans))
    if time:
        best = min((run["error_m"] for run in done(time)), default=0)

        def told(run):
            if "failed" in run:
                return "failed"
            off = " (error %s m)" % number(run["error_m"]) if run["error_m"] > SAME * best else ""
            return "%s ms%s" % (number(1e3 * run["cpu_s"]), off)

        lines.append("%s, time at %g ms, error %s m: %s" % (program, 1e3 * time[0]["dt"], number(best), "; ".join(
            "%s %s" % (label(run), told(run)) for run in time)))
    return "".join("- %s.\n" % line for line in lines)


def case_text(data):
    lines = []
    for row in data["rows"]:
        failed = row.get("failed")
        lines.append([row["program"], row["setting"], "%g" % (1e3 * row["dt"]), "–" if failed else number(1e3 * row["cpu_s"]),
                      failed if failed else number(row["error_m"])])
    own = "" if data["own_error_m"] is None else "; its own error %s m" % number(data["own_error_m"])
    text = "## %s\n\n%s. %g s. Reference: %s%s.\n\n%s" % (data["title"], data["measured"], data["duration"], data["reference"], own, table(
        ["program", "setting", "dt, ms", "CPU, ms", "largest error, m"], lines))
    if data["compared"]:
        rows = [[c["peer"], "%g" % (1e3 * c["dt"]), number(c["error_m"]), number(1e3 * c["cpu_s"]), c["nsframe"] or "none",
                 number(c["nsframe_error_m"]), number(c["nsframe_cpu_s"] and 1e3 * c["nsframe_cpu_s"]), part_text(c["part"])]
                for c in data["compared"]]
        text += "\nAt the error of each peer's run, nsframe's cheapest run that is no less accurate:\n\n" + table(
            ["peer", "dt, ms", "its error, m", "its CPU, ms", "nsframe", "error, m", "CPU, ms", "part of its time"], rows)
    tried = "".join(tried_text(program, found) for program, found in data["tried"].items())
    return text + ("\n" + tried if tried else "")


def panel_of(panel, case, handles):
    for program, colour in (("OpenSees", STYLE["OpenSees"][1]), ("Siconos", STYLE["Siconos, Moreau-Jean"][1])):
        shown = done(case["tried"].get(program, {}).get("error", []))
        panel.plot([1e3 * run["cpu_s"] for run in shown], [run["error_m"] for run in shown], linestyle="none", marker=".", markersize=3,
                   color=colour, alpha=0.25)
    for series, (marker, colour) in STYLE.items():
        rows = [row for row in done(case["rows"]) if row["series"] == series]
        lines = sorted((row for row in rows if "accuracy" not in row["setting"]), key=lambda row: row["cpu_s"])
        points = [row for row in rows if "accuracy" in row["setting"]]
        for shown, line, fill, name in ((lines, "-", colour, series), (points, "none", "white", series + ", by accuracy")):
            if shown:
                handles[name], = panel.plot([1e3 * row["cpu_s"] for row in shown], [max(row["error_m"], 1e-17) for row in shown],
                                            linestyle=line, marker=marker, color=colour, markerfacecolor=fill, linewidth=1,
                                            markersize=8 if marker == "*" else 5)
    panel.set(xscale="log", yscale="log", title=case["title"], xlabel="CPU time of the step loop, ms",
              ylabel="largest displacement error, m")
    panel.title.set_fontsize(9)
    if case["own_error_m"]:
        panel.axhline(case["own_error_m"], color="grey", linestyle=":", linewidth=1)
    panel.grid(True, alpha=0.3)


def draw(folder, data):
    """The diagram as SVG and PNG, or why there is none; as a line of Markdown."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError as problem:
        return "No diagram: %s." % problem
    plt.rcParams.update({"svg.hashsalt": "work_precision", "font.size": 9})
    count = len(data["cases"]) + 1  # and one for the legend
    columns = min(3, count)
    figure, panels = plt.subplots(-(-count // columns), columns, figsize=(4.4 * columns, 3.7 * -(-count // columns)), squeeze=False)
    panels = [panel for row in panels for panel in row]
    handles = {}
    for panel, case in zip(panels, data["cases"].values()):
        panel_of(panel, case, handles)
    for panel in panels[len(data["cases"]):]:
        panel.axis("off")
    names = [name if name.startswith(PEERS) else "nsframe, " + name for name in handles]
    panels[-1].legend(list(handles.values()), names, loc="center", frameon=False, title="faint: every setting tried for a peer")
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "work_precision.svg"), metadata={"Date": None})
    figure.savefig(os.path.join(folder, "work_precision.png"), dpi=130)
    plt.close(figure)
    return "![error against CPU time](work_precision.svg)"
