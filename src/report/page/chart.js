"use strict";
// Line charts on canvases. Charts over time share a window and a cursor; drag to zoom, double-click for the whole.

// Okabe and Ito (2008): told apart by the colour-blind.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b07d00", "#56b4e9", "#000000", "#7a7a7a"];

function tinted(colour, part) {  // towards white
  const parts = [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));
  return "rgb(" + parts.map(value => Math.round(value + (255 - value) * part)).join(",") + ")";
}

function niceTicks(low, high, count) {
  const rough = (high - low) / Math.max(1, count), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(factor => factor * power >= rough * 0.999);
  const ticks = [], first = Math.ceil(low / step - 1e-9);
  for (let k = first; k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  if (ticks.length < 3 && count < 30) return niceTicks(low, high, 1.5 * count);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const text = value => Math.abs(value) < 1e-9 * step ? "0" : Math.abs(value) >= 1e6 ? value.toExponential(1)
    : decimals > 6 ? value.toExponential(1) : value.toFixed(decimals);
  return {ticks, text};
}

// Three significant digits, as a reader would write them.
function figure(value, digits = 3) {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e6) return value.toExponential(digits - 1).replace("e+", "e").replaceAll("-", "−");
  const text = size >= 10 ** digits ? value.toFixed(0) : value.toPrecision(digits);
  return text.replace("-", "−");
}

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") made.textContent = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value);
  }
  for (const child of children) made.append(child);
  return made;
}

// A canvas in device pixels whose context draws in CSS pixels; null where it isn't shown.
function prepared(canvas) {
  const width = canvas.clientWidth, height = canvas.clientHeight, ratio = window.devicePixelRatio || 1;
  if (!width || !height) return null;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height};
}

// The time that charts and drawing share.
class Clock {
  constructor(duration) {
    Object.assign(this, {duration, window: [0, duration], cursor: null, watchers: []});
  }
  tell() { for (const watcher of this.watchers) watcher(); }
  zoom(from, to) {
    this.window = to - from > 1e-4 * this.duration ? [Math.max(0, from), Math.min(this.duration, to)] : [0, this.duration];
    this.tell();
  }
  point(time) {
    this.cursor = time === null ? null : Math.min(this.duration, Math.max(0, time));
    this.tell();
  }
}

function nearestIndex(x, value) {
  let low = 0, high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] < value) low = middle; else high = middle;
  }
  return Math.abs(x[low] - value) <= Math.abs(x[high] - value) ? low : high;
}

// spec: title, unit, factor (SI to unit), series [{name, colour, width, x, y}], xLabel, log (x axis), stems, clock, marks [s], zero
class Chart {
  constructor(spec) {
    this.spec = spec;
    this.shown = spec.series.map(() => true);
    this.canvas = element("canvas", {role: "img", "aria-label": spec.title});
    this.values = spec.series.map(() => element("span", {class: "value"}));
    const legend = element("div", {class: "legend"});
    spec.series.forEach((series, k) => {
      const swatch = element("span", {class: "swatch", style: "border-color:" + series.colour});
      const button = element("button", {type: "button", "aria-pressed": "true"}, swatch, series.name, this.values[k]);
      button.addEventListener("click", () => {
        this.shown[k] = !this.shown[k];
        button.setAttribute("aria-pressed", this.shown[k]);
        this.draw();
      });
      legend.append(button);
    });
    this.host = element("figure", {class: "card chart"}, element("figcaption", {text: spec.title}), legend, this.canvas);
    if (spec.note) this.host.append(element("p", {class: "note", text: spec.note}));
    this.listen();
    if (spec.clock) spec.clock.watchers.push(() => this.request());
    new ResizeObserver(() => this.request()).observe(this.canvas);
  }

  request() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.draw(); });
  }

  listen() {
    const {clock} = this.spec, at = event => this.xOf(event.offsetX);
    this.canvas.addEventListener("pointermove", event => {
      if (!this.box) return;
      if (this.from !== undefined && clock) this.to = at(event);
      this.hover = at(event);
      this.request();
    });
    this.canvas.addEventListener("pointerleave", () => { this.hover = this.from = this.to = undefined; this.request(); });
    this.canvas.addEventListener("pointerdown", event => {
      if (event.pointerType === "mouse") this.from = at(event);
      this.hover = at(event);
      this.request();
    });
    this.canvas.addEventListener("pointerup", event => {
      if (!clock || !this.box) return;
      const wide = this.to !== undefined && Math.abs(this.placeX(this.to) - this.placeX(this.from)) > 6;
      if (wide) clock.zoom(Math.min(this.from, this.to), Math.max(this.from, this.to)); else clock.point(at(event));
      this.from = this.to = undefined;
    });
    this.canvas.addEventListener("dblclick", () => clock && clock.zoom(0, 0));
  }

  placeX(x) {
    const {left, right, from, to} = this.box, log = this.spec.log, f = log ? Math.log : value => value;
    return left + (right - left) * (f(x) - f(from)) / (f(to) - f(from));
  }
  xOf(pixel) {
    if (!this.box) return 0;
    const {left, right, from, to} = this.box, part = Math.min(1, Math.max(0, (pixel - left) / (right - left)));
    return this.spec.log ? from * (to / from) ** part : from + (to - from) * part;
  }

  range(from, to) {
    let low = Infinity, high = -Infinity;
    this.spec.series.forEach(({x, y}, k) => {
      if (!this.shown[k]) return;
      for (let i = 0; i < x.length; ++i) {
        if (x[i] < from || x[i] > to || y[i] === null) continue;
        if (y[i] < low) low = y[i];
        if (y[i] > high) high = y[i];
      }
    });
    if (!(low <= high)) [low, high] = [0, 1];
    if (this.spec.zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
    const factor = this.spec.factor || 1, pad = 0.06 * (high - low) || 0.06 * Math.abs(high) || 1;
    return [(low - (this.spec.zero && low === 0 ? 0 : pad)) * factor, (high + pad) * factor];
  }

  draw() {
    const ready = prepared(this.canvas);
    if (!ready) return;
    const {context: c, width, height} = ready, {spec} = this, factor = spec.factor || 1;
    const xs = spec.series.flatMap(series => series.x.length ? [series.x[0], series.x[series.x.length - 1]] : []);
    const [from, to] = spec.clock ? spec.clock.window : [Math.min(...xs), Math.max(...xs)];
    const [low, high] = this.range(from, to), small = width < 420;
    c.font = "12.5px system-ui, 'DejaVu Sans', sans-serif";
    const yTicks = niceTicks(low, high, small ? 4 : 5);
    const labelWidth = Math.max(...yTicks.ticks.map(value => c.measureText(yTicks.text(value)).width));
    const box = this.box = {left: Math.ceil(labelWidth) + 26, right: width - 10, top: 8, bottom: height - 38, from, to, low, high};
    const placeY = value => box.bottom - (box.bottom - box.top) * (value - low) / (high - low);
    this.axes(c, box, yTicks, placeY, small);
    c.save();
    c.beginPath();
    c.rect(box.left, box.top - 1, box.right - box.left, box.bottom - box.top + 2);
    c.clip();
    this.marks(c, box);
    spec.series.forEach((series, k) => {
      if (!this.shown[k]) return;
      c.strokeStyle = series.colour;
      c.lineWidth = series.width || 1.4;
      c.lineJoin = "round";
      c.beginPath();
      let pen = false;
      for (let i = 0; i < series.x.length; ++i) {
        if (series.y[i] === null) { pen = false; continue; }
        const x = this.placeX(series.x[i]), y = placeY(series.y[i] * factor);
        if (spec.stems) {
          c.moveTo(x, placeY(0));
          c.lineTo(x, y);
          c.moveTo(x + 2, y);
          c.arc(x, y, 2, 0, 7);
        } else if (pen) {
          c.lineTo(x, y);
        } else {
          c.moveTo(x, y);
        }
        pen = true;
      }
      c.stroke();
    });
    this.cursors(c, box, placeY);
    c.restore();
  }

  axes(c, box, yTicks, placeY, small) {
    c.lineWidth = 1;
    c.fillStyle = "#57606a";
    c.textBaseline = "middle";
    c.textAlign = "right";
    for (const value of yTicks.ticks) {
      const y = Math.round(placeY(value)) + 0.5;
      c.strokeStyle = Math.abs(value) < 1e-12 * (box.high - box.low) ? "#9aa3ad" : "#e6e9ed";
      c.beginPath();
      c.moveTo(box.left, y);
      c.lineTo(box.right, y);
      c.stroke();
      c.fillText(yTicks.text(value).replace("-", "−"), box.left - 5, y);
    }
    c.save();
    c.translate(9, (box.top + box.bottom) / 2);
    c.rotate(-Math.PI / 2);
    c.textAlign = "center";
    c.fillText(this.spec.unit, 0, 0);
    c.restore();
    c.textAlign = "center";
    c.textBaseline = "top";
    const ticks = this.spec.log ? this.logTicks(box) : niceTicks(box.from, box.to, small ? 4 : 8);
    let end = -Infinity;
    for (const value of ticks.ticks) {
      const x = Math.round(this.placeX(value)) + 0.5, half = c.measureText(ticks.text(value)).width / 2;
      c.strokeStyle = "#c3c9d0";
      c.beginPath();
      c.moveTo(x, box.bottom);
      c.lineTo(x, box.bottom + 4);
      c.stroke();
      if (x - half < end + 6 || x + half > box.right + 10) continue;
      c.fillText(ticks.text(value), x, box.bottom + 6);
      end = x + half;
    }
    c.fillText(this.spec.xLabel, (box.left + box.right) / 2, box.bottom + 22);
    c.strokeStyle = "#9aa3ad";
    c.strokeRect(box.left + 0.5, box.top + 0.5, box.right - box.left, box.bottom - box.top);
  }

  logTicks({from, to}) {
    const ticks = [];
    for (let power = Math.floor(Math.log10(from)); power <= Math.log10(to); ++power) {
      for (const factor of [1, 2, 5]) {
        const value = factor * 10 ** power;
        if (value >= from * 0.999 && value <= to * 1.001) ticks.push(value);
      }
    }
    return {ticks, text: value => String(+value.toPrecision(3))};
  }

  // Poundings: triangles on the time axis.
  marks(c, box) {
    for (const time of this.spec.marks || []) {
      if (time < box.from || time > box.to) continue;
      const x = this.placeX(time);
      c.fillStyle = "rgba(140, 29, 64, 0.3)";
      c.fillRect(x - 0.25, box.top, 0.5, box.bottom - box.top);
      c.fillStyle = "#8c1d40";
      c.beginPath();
      c.moveTo(x, box.bottom - 8);
      c.lineTo(x - 4, box.bottom);
      c.lineTo(x + 4, box.bottom);
      c.fill();
    }
  }

  cursors(c, box, placeY) {
    const {spec} = this, time = this.hover !== undefined ? this.hover : spec.clock ? spec.clock.cursor : null;
    if (this.to !== undefined) {
      c.fillStyle = "rgba(0, 114, 178, 0.15)";
      const [first, last] = [this.from, this.to].map(value => this.placeX(value)).sort((a, b) => a - b);
      c.fillRect(first, box.top, last - first, box.bottom - box.top);
    }
    if (spec.clock && spec.clock.cursor !== null) {
      c.fillStyle = "#1b1f24";
      c.fillRect(this.placeX(spec.clock.cursor) - 0.5, box.top, 1, box.bottom - box.top);
    }
    spec.series.forEach((series, k) => {
      if (time === null || !series.x.length || spec.stems) { this.values[k].textContent = ""; return; }
      const i = nearestIndex(series.x, time);
      this.values[k].textContent = series.y[i] === null ? "" : figure(series.y[i] * (spec.factor || 1));
      if (!this.shown[k] || series.y[i] === null || this.hover === undefined) return;
      c.fillStyle = series.colour;
      c.beginPath();
      c.arc(this.placeX(series.x[i]), placeY(series.y[i] * (spec.factor || 1)), 3, 0, 7);
      c.fill();
    });
  }
}
