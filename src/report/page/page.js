// Puts the page together from the data of the run.

const run = JSON.parse(document.getElementById("run").textContent), {summary} = run;
const report = window.nsframeReport = {errors: [], charts: [], view: null};
window.addEventListener("error", event => report.errors.push(event.message));
const main = document.getElementById("main"), contents = document.getElementById("contents");
const clock = new Clock(Math.max(summary.end_time, 1e-9));
const colours = summary.structures.map((name, k) => palette[k % palette.length]);

function section(id, title, ...content) {
  contents.append(element("a", {href: "#" + id, text: title}));
  main.append(element("section", {}, element("h2", {id, text: title}), ...content));
}

function table(head, rows, options = {}) {
  const body = element("tbody");
  for (const {cells, jump} of rows) {
    const kind = (cell, k) => (head[k].text ? "text" : "") + (cell.bad ? " bad" : "");
    const row = element("tr", {}, ...cells.map((cell, k) => element("td", {text: cell, class: kind(cell, k)})));
    if (jump !== undefined) {
      row.className = "jump";
      row.tabIndex = 0;
      row.title = "Show this moment";
      const go = () => clock.point(jump);
      row.addEventListener("click", go);
      row.addEventListener("keydown", event => { if (event.key === "Enter") go(); });
    }
    body.append(row);
  }
  const titles = head.map(({label, text}) => element("th", {text: label, class: text ? "text" : "", scope: "col"}));
  const made = element("table", {}, element("thead", {}, element("tr", {}, ...titles)), body);
  return element("div", {class: options.scroll === false ? "" : "scroll"}, made);
}

function head() {
  document.getElementById("title").textContent = summary.title || "A run of nsframe";
  const {steps} = summary, course = steps ? ["Scheme " + summary.scheme, "dt = " + figure(1e3 * summary.dt) + " ms", steps + " steps",
    figure(summary.end_time) + " s"] : ["Static stages"];
  const parts = [...course, summary.dofs + (summary.dofs === 1 ? " DOF" : " DOFs"), summary.elements + " elements", summary.fibers ? summary.fibers + " fibers" : ""];
  document.getElementById("subtitle").textContent = parts.filter(text => text).join(" · ");
  const warnings = [...summary.warnings];
  if (!summary.completed) warnings.unshift("This run did not complete: " + (summary.stop_reason || "stopped") + ".");
  const items = warnings.map(text => element("li", {text}));
  if (items.length) main.append(element("ul", {class: "warnings", "aria-label": "Warnings"}, ...items));
  const figures = element("div", {class: "figures"}), line = (kind, text) => element("div", {class: "figure-" + kind, text});
  const card = (label, value, more) => figures.append(
    element("div", {class: "card"}, line("value", value), line("label", label), more ? line("label", more) : ""));
  if (summary.pairs.length) {
    const strongest = run.poundings.reduce((best, p) => !best || p.impulse > best.impulse ? p : best, null);
    const counted = (count, word) => count === 1 ? word : word + "s";
    card(counted(summary.poundings_total, "pounding"), String(summary.poundings_total),
      summary.impacts_total + " " + counted(summary.impacts_total, "impact"));
    if (strongest) card("largest impulse of a pounding", figure(strongest.impulse) + " N s", "at " + figure(strongest.t, 4) + " s");
  }
  const peak = run.peaks.displacement, drift = run.peaks.drift;
  if (peak) card("largest horizontal displacement", figure(1e3 * peak.value) + " mm", peak.node + ", along " + peak.direction);
  const story = drift && `${drift.structure}, story ${drift.story}, along ${drift.direction}`;
  if (drift) card("largest story drift", figure(100 * drift.value) + " %", story);
  if (run.peaks.twist) card("largest twist", figure(1e3 * run.peaks.twist.value) + " mrad", run.peaks.twist.node);
  const {worst_relative_balance_error: error} = summary.energy;
  if (summary.steps) card("largest energy error", figure(100 * error, 2) + " %", "of the largest energy");
  if (figures.children.length) main.append(figures);
}

function view() {
  const poundings = run.poundings.map(p => ({...p, pair: summary.pairs.indexOf(p.pair)}));
  report.view = new View(run.view, colours, clock, poundings);
  if (run.view.note) report.view.host.append(element("p", {class: "note", text: run.view.note}));
  const cells = run.poundings.map(p => ({jump: p.t, cells: [p.t.toFixed(3), p.pair, figure(p.approach_velocity), figure(p.impulse),
    figure(1e3 * p.duration, 2), Math.abs(p.effective_restitution) < 1e-6 ? "0" : figure(p.effective_restitution, 2), String(p.impacts)]}));
  const left = report.view.host;
  if (!summary.pairs.length) { section("shape", "Deformed shape", left); return; }
  const hidden = summary.poundings_total - run.poundings.length;
  const note = "Impacts of one pair closer than 20 ms, or in sustained contact, are one pounding. "
    + (hidden > 0 ? `The strongest ${run.poundings.length} of ${summary.poundings_total} are listed. ` : "")
    + (cells.length ? "Choose one to see its moment." : "");
  const columns = [{label: "t, s"}, {label: "pair", text: true}, {label: "approach, m/s"}, {label: "impulse, N\u00a0s"}, {label: "lasts, ms"},
    {label: "e, effective"}, {label: "impacts"}];
  const card = element("div", {class: "card"}, element("h3", {text: "Poundings"}),
    cells.length ? table(columns, cells) : element("p", {text: "None."}), element("p", {class: "note", text: note}));
  section("shape", "Deformed shape and poundings", element("div", {class: "grid wide-left"}, left, card));
}

function seriesOf(chart) {
  return chart.series.map((series, k) => {
    const base = palette[(series.colour >= 0 ? series.colour : k) % palette.length];
    return {...series, colour: series.tint ? tinted(base, series.tint) : base, width: series.tint ? 1.1 : 1.5};
  });
}

function charts() {
  const marks = run.poundings.map(p => p.t);
  for (const group of run.groups) {
    const made = group.charts.map(chart => new Chart({...chart, xLabel: chart.x_label, series: seriesOf(chart),
      clock: chart.over_time ? clock : null, marks: chart.over_time && !chart.stems ? marks : []}));
    report.charts.push(...made);
    const grid = element("div", {class: "grid two"}, ...made.map(chart => chart.host));
    const timed = group.charts.some(chart => chart.over_time);
    const extra = group.note ? [element("p", {class: "note", text: group.note})] : [];
    section(group.id, group.title, ...extra, grid);
    if (timed && !report.timed) {
      report.timed = true;
      const whole = element("button", {type: "button", class: "plain", text: "Whole run", onclick: () => clock.zoom(0, 0)});
      const hint = "Drag the mouse across a chart to look closer; a click or tap sets the moment of the drawing. "
        + (marks.length ? "Triangles on the time axis: poundings." : "");
      grid.before(element("div", {class: "bar"}, whole, element("span", {class: "note", text: hint})));
    }
  }
}

function numerics() {
  const list = element("dl"), add = (name, value) => list.append(element("dt", {text: name}), element("dd", {text: value}));
  const {scheme_reason: reason, energy, timing} = summary;
  add("Scheme", summary.scheme + (reason && reason !== "asked for" ? " (" + reason + ")" : ""));
  if (summary.scheme === "moreau-jean") add("θ, γ", summary.theta + ", " + summary.gamma);
  add("Step", figure(1e3 * summary.dt) + " ms");
  add("Steps", String(summary.steps));
  add("Newton iterations", String(summary.newton_iterations));
  if (summary.evaluations) add("Evaluations of the elements", String(summary.evaluations));
  add("Steps halved", String(summary.halved_steps));
  if (summary.rejected_parts) add("Parts rejected by the error estimate", String(summary.rejected_parts));
  add("Energy error, largest of the run", figure(100 * energy.worst_relative_balance_error, 2) + " % of the largest energy");
  add("Energy dissipated by the scheme", figure(energy.numerical) + " J");
  if (summary.pairs.length) {
    add("Largest penetration", figure(1e3 * summary.max_penetration, 2) + " mm");
    add("Contact problem solved to", figure(summary.max_complementarity_error, 2));
  }
  add("Computing: setup, steps, output", [timing.setup, timing.step_loop, timing.output].map(s => figure(s, 2)).join(", ") + " s");
  const excess = 0.005, effective = m => Object.assign(new String(figure(100 * m.effective, 2)), {bad: m.added > excess});
  const rows = summary.numerical_damping.map(m => ({cells: [m.structure, m.mode, figure(m.frequency), figure(100 * m.asked, 2),
    effective(m), figure(100 * m.period_error, 2)]}));
  const cards = [element("div", {class: "card"}, element("h3", {text: "How it was computed"}), list)];
  if (rows.length) {
    const columns = [{label: "structure", text: true}, {label: "mode", text: true}, {label: "f, Hz"}, {label: "damping asked, %"},
      {label: "effective, %"}, {label: "period error, %"}];
    cards.push(element("div", {class: "card"}, element("h3", {text: "Modes under this scheme and step"}), table(columns, rows),
      element("p", {class: "note", text: "Bold: the scheme adds more than half a percent of critical damping."})));
  }
  section("numerics", "Numerics", element("div", {class: "grid two"}, ...cards));
}

function scene() {
  if (!run.scene) return;
  const title = element("summary", {text: "The complete scene, with every default that was used"});
  section("scene", "Scene", element("details", {class: "card"}, title, element("pre", {text: run.scene})));
}

head();
if (run.view) view();
charts();
if (run.notes.length) main.append(...run.notes.map(text => element("p", {class: "note", text})));
if (summary.steps) numerics();
scene();
document.getElementById("footer").textContent = "Made by nsframe " + summary.version
  + ". Units: SI, unless a label says another. Long histories are thinned; every peak is kept.";
// For tests: what was drawn, and whether anything is wider than the window.
window.addEventListener("load", () => {
  for (const chart of report.charts) chart.draw();
  if (report.view) report.view.draw();
  const body = document.body.dataset;
  body.errors = report.errors.join("; ");
  body.charts = report.charts.filter(chart => chart.box).length + "/" + report.charts.length;
  body.overflow = document.documentElement.scrollWidth > window.innerWidth ? document.documentElement.scrollWidth + " px" : "";
  body.view = report.view ? String(Boolean(report.view.drawn)) : "none";
  body.ready = "1";
});
