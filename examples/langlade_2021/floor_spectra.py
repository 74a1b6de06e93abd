"""Floor spectra of the frames under El Centro (Fig. 14, 15-16), and what dv/h makes of them. Needs h5py and numpy."""
import json
import os

import cases
import histories
import numpy as np
from program import rounded

PERIODS = [float(f"{0.02 * 100 ** (i / 59):.4g}") for i in range(60)]  # 0.02 to 2 s
SHORT_PERIODS = [float(f"{0.002 * 1000 ** (i / 59):.4g}") for i in range(60)]  # 0.002 to 2 s
FUNDAMENTAL = {"table_5": (1 / 3.50, 1 / 6.55), "table_8": (1 / 2.10, 1 / 3.69)}  # [s] left, right
STEPS = (1e-3, 5e-4, 1e-4)


def watching(nodes, periods=PERIODS):
    listed = "[" + ", ".join(f'"{node}"' for node in nodes) + "]"
    return {"output.floor_spectra": f"{{ nodes = {listed}, periods = {periods}, damping = 0.05 }}"}


def spectra(folder, summary):
    return {node: {"psv": histories.short(psv), "psa": histories.short(psa)}
            for node, (psv, psa) in histories.floor_spectra(folder)[1].items()}


def of_schemes(program, record):
    """Table 5, El Centro 0.45 g: e and the scheme; Table 8, El Centro 0.30 g: the scheme and the slabs."""
    jobs = {}
    frame, story = cases.TABLE_5[3], cases.TABLE_8[1]
    base = {**cases.row_settings(cases.PlaneFrame, frame, record.file), **watching(cases.PlaneFrame.floors.values())}
    for e in (0.2, 0.6, 0.9):
        settings = {**base, **cases.EXACT_SCHEME, "contact.restitution": e}
        jobs["table_5", f"converged, e = {e:g}"] = (cases.PlaneFrame.scene, settings, spectra)
    jobs["table_5", "paper"] = (cases.PlaneFrame.scene, {**base, **cases.PAPER_SCHEME}, spectra)
    jobs["table_5", "no contact"] = (cases.PlaneFrame.scene, {**base, **cases.EXACT_SCHEME, "contact.gap": "40 cm"}, spectra)
    base = {**cases.row_settings(cases.TwoStory, story, record.file), **watching(cases.TwoStory.floors.values())}
    for name, settings in (("paper", cases.PAPER_SCHEME), ("converged", cases.EXACT_SCHEME),
                           ("converged, rigid slabs", {**cases.EXACT_SCHEME, **cases.RIGID_SLABS})):
        jobs["table_8", name] = (cases.TwoStory.scene, {**base, **settings}, spectra)
    curves = {"periods": PERIODS, "step_periods": SHORT_PERIODS, "table_5": {}, "table_8": {}}
    for (table, name), found in program.run_all(jobs).items():
        curves[table][name] = found
    return effects(curves), curves


def effects(curves):
    """Largest differences of PSA from the converged one at e = 0.6 (of flexible slabs): below the fundamental period, from it on, and
    from 1.5 times it on."""
    found = {}
    compared = {cases.PlaneFrame: ("converged, e = 0.6", ("converged, e = 0.2", "converged, e = 0.9", "paper", "no contact")),
                cases.TwoStory: ("converged", ("paper", "converged, rigid slabs"))}
    for system, (reference, others) in compared.items():
        table = system.name
        for name in others:
            for (side, node), fundamental in zip(system.floors.items(), FUNDAMENTAL[table]):
                spectrum, base = curves[table][name][node]["psa"], curves[table][reference][node]["psa"]
                parts = {"below": (0, 1), "above": (1, 1e9), "above 1.5": (1.5, 1e9)}  # times the fundamental period
                for label, (shortest, longest) in parts.items():
                    chosen = [(a, b) for a, b, period in zip(spectrum, base, PERIODS) if shortest <= period / fundamental < longest]
                    found.setdefault(table, {}).setdefault(name, {}).setdefault(side, {})[label] = largest_difference(*zip(*chosen))
    return found


def largest_difference(spectrum, reference):
    return rounded(float(np.max(np.abs(np.array(spectrum) / np.array(reference) - 1))), 3)


def of_steps(program, record):
    """One motion, found exactly and kept every 1, 0.5 and 0.1 ms: its floor spectra by jumps of velocity, and by dv/h."""
    node = cases.PlaneFrame.floors["left"]
    base = {**cases.row_settings(cases.PlaneFrame, cases.TABLE_5[3], record.file), **watching([node], SHORT_PERIODS),
            **histories.kept([node])}

    def read(folder, summary):
        times, acceleration = histories.accelerations(folder, node)
        file = os.path.join(folder, "acceleration.csv")
        np.savetxt(file, np.column_stack([times, acceleration]), delimiter=",", header="time [s], a [m/s2]", comments="", fmt="%.10g")
        out = os.path.join(folder, "spectrum")
        program.call("spectrum", file, "--at", ",".join(f"{period:g}" for period in SHORT_PERIODS), "-o", out)
        with open(os.path.join(out, "spectrum.json")) as text:
            psa = json.load(text)["spectra"][0]["psa"]
        return {"jumps": spectra(folder, summary)[node]["psa"], "difference": histories.short(psa),
                "peak": rounded(float(np.abs(acceleration).max()), 4)}

    runs = program.run_all({dt: (cases.PlaneFrame.scene, {**base, **cases.EXACT_SCHEME, "analysis.dt": dt}, read) for dt in STEPS})
    finest = runs[STEPS[-1]]
    numbers = {"steps": list(STEPS), "peak": [runs[dt]["peak"] for dt in STEPS]}
    for label, shortest, longest in (("below 0.02 s", 0, 0.02), ("0.02 to 0.05 s", 0.02, 0.05), ("above 0.05 s", 0.05, 1e9)):
        chosen = [i for i, period in enumerate(SHORT_PERIODS) if shortest <= period < longest]
        reference = [finest["jumps"][i] for i in chosen]
        numbers[label] = {way: [largest_difference([runs[dt][way][i] for i in chosen], reference) for dt in STEPS]
                          for way in ("jumps", "difference")}
    return numbers, {f"{dt:g}": {way: runs[dt][way] for way in ("jumps", "difference")} for dt in STEPS}
