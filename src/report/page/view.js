// The deformed shape in 3D: painter's algorithm on a canvas. Members bend with the cubic shape functions of their end rotations.

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const mix = (a, b, s) => a.map((value, k) => value + s * (b[k] - value));

function decoded(text) {  // base64 of little-endian 16-bit integers
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Int16Array(bytes.buffer);
}

class View {
  // data: as drawing.cpp writes it; colours of the structures; poundings with t, pair (index) and impulse
  constructor(data, colours, clock, poundings) {
    Object.assign(this, {data, colours, clock, poundings});
    this.frames = data.times.length ? decoded(data.frames) : null;
    this.slot = new Map(data.recorded.map((node, k) => [node, k]));
    this.camera = {azimuth: -1.12, elevation: 0.3, zoom: 1};
    this.ghost = true;
    this.speed = 1;
    this.scale = data.scale;
    this.extent();
    this.canvas = element("canvas", {role: "img", "aria-label": "Deformed shape in 3D; drag to rotate"});
    this.host = element("figure", {class: "card view"}, this.canvas);
    this.listen();
    this.host.append(this.controls());
    clock.watchers.push(() => { if (clock.cursor !== null && !this.told) this.show(clock.cursor); });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  // How far gaps drawn as wide as displacements are large move a structure, and a wall in front of it.
  offset(structure, across = [0, 0, 0]) {
    return this.data.offsets[structure].map((value, k) => (this.scale - 1) * (value + across[k]));
  }

  extent() {
    const place = (p, offset) => p.map((x, k) => x + offset[k]);
    const points = this.data.position.map((p, node) => place(p, this.offset(this.data.structure[node])));
    for (const wall of this.data.walls) for (const p of wall.corners) points.push(place(p, this.offset(wall.structure, wall.across)));
    const low = [...points[0]], high = [...points[0]], n = 6 * this.data.recorded.length;
    for (const node of this.data.points) {  // nothing but a node: where it goes counts
      const k = this.slot.get(node);
      for (let i = 0; k !== undefined && i < this.data.times.length; ++i) {
        const motion = d => this.data.unit[0] * this.data.scale * this.frames[i * n + 6 * k + d];
        points.push(points[node].map((x, d) => x + motion(d)));
      }
    }
    for (const p of points) for (let k = 0; k < 3; ++k) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
    this.low = low;
    this.high = high;
    this.centre = mix(low, high, 0.5);
    this.radius = 0.5 * Math.hypot(...high.map((value, k) => value - low[k])) || 1;
  }

  // Displacements and rotations (6 a recorded node) at a time.
  at(time) {
    const {times, unit} = this.data, n = 6 * this.data.recorded.length, out = new Float64Array(n);
    if (!this.frames) return out;
    let i = nearestIndex(times, time);
    if (times[i] > time && i > 0) --i;
    const j = Math.min(i + 1, times.length - 1), s = j > i ? Math.min(1, Math.max(0, (time - times[i]) / (times[j] - times[i]))) : 0;
    for (let k = 0; k < n; ++k) out[k] = unit[k % 6 < 3 ? 0 : 1] * ((1 - s) * this.frames[i * n + k] + s * this.frames[j * n + k]);
    return out;
  }

  // [displacement, rotation] of a node, scaled; null where it has no history.
  moved(motion, node, scale) {
    const k = this.slot.get(node);
    if (!this.frames) return [[0, 0, 0], [0, 0, 0]];
    if (k === undefined) return null;
    const part = first => [0, 1, 2].map(d => scale * motion[6 * k + first + d]);
    return [part(0), part(3)];
  }

  curve(member, motion, scale, pieces) {
    const [i, j] = member.nodes, first = this.moved(motion, i, scale), last = this.moved(motion, j, scale), [a, b] = member.ends;
    if (!first || !last) return null;
    const along = b.map((value, k) => value - a[k]), length = Math.hypot(...along), t = along.map(value => value / length);
    const position = this.data.position;
    const carried = (end, node, [u, r]) => cross(r, end.map((value, k) => value - position[node][k])).map((value, k) => value + u[k]);
    const u = carried(a, i, first), v = carried(b, j, last);
    if (!member.curved || pieces === 1) return [a.map((x, k) => x + u[k]), b.map((x, k) => x + v[k])];
    const p = cross(first[1], t), q = cross(last[1], t), points = [];
    for (let m = 0; m <= pieces; ++m) {
      const s = m / pieces, n1 = 1 - 3 * s * s + 2 * s ** 3, n2 = s - 2 * s * s + s ** 3, n3 = 1 - n1, n4 = s ** 3 - s * s;
      const axial = (1 - s - n1) * dot(u, t) + (s - n3) * dot(v, t);
      points.push(a.map((x, k) => x + s * along[k] + n1 * u[k] + n3 * v[k] + length * (n2 * p[k] + n4 * q[k]) + axial * t[k]));
    }
    return points;
  }

  project(p) {
    const d = p.map((value, k) => value - this.centre[k]), depth = dot(d, this.forward), far = 4.5 * this.radius;
    const f = this.pixels * far / (far - depth);
    return [this.middle[0] + f * dot(d, this.right), this.middle[1] - f * dot(d, this.up), depth];
  }

  aim(width, height) {
    const {azimuth: a, elevation: e, zoom} = this.camera;
    this.forward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    this.right = [-Math.sin(a), Math.cos(a), 0];
    this.up = cross(this.forward, this.right);
    this.middle = [width / 2, height / 2];
    this.pixels = 1;
    let wide = 0.3 * this.radius, high = wide;  // of the box around the model, seen from here
    for (let corner = 0; corner < 8; ++corner) {
      const p = this.project([0, 1, 2].map(k => corner >> k & 1 ? this.high[k] : this.low[k]));
      wide = Math.max(wide, Math.abs(p[0] - width / 2));
      high = Math.max(high, Math.abs(p[1] - height / 2));
    }
    this.pixels = zoom * 0.9 * Math.min(width / 2 / wide, height / 2 / high);
  }

  draw() {
    const ready = prepared(this.canvas);
    if (!ready) return;
    const {context: c, width, height} = ready;
    this.aim(width, height);
    const motion = this.at(this.time), pieces = this.data.members.length > 1500 ? 3 : 8, shapes = [];
    if (this.ghost && this.frames) this.collect(shapes, motion, 0, 1, true);
    this.collect(shapes, motion, this.scale, pieces, false);
    shapes.sort((a, b) => a.depth === b.depth ? 0 : a.depth - b.depth);
    this.ground(c);
    for (const shape of shapes) {
      c.beginPath();
      shape.points.forEach((p, k) => k ? c.lineTo(p[0], p[1]) : c.moveTo(p[0], p[1]));
      if (shape.fill) { c.closePath(); c.fillStyle = shape.fill; c.fill(); }
      if (shape.dot) { c.arc(shape.points[0][0], shape.points[0][1], shape.dot, 0, 7); c.fillStyle = shape.stroke; c.fill(); continue; }
      c.strokeStyle = shape.stroke;
      c.lineWidth = shape.width;
      c.lineCap = "round";
      c.stroke();
    }
    this.flashes(c, motion);
    this.axes(c, height);
    this.drawn = true;
  }

  collect(shapes, motion, scale, pieces, ghost) {
    const {data} = this, add = (points, style, offset) => {
      const seen = points.map(p => this.project(p.map((x, k) => x + offset[k])));
      shapes.push({points: seen, depth: ghost ? -Infinity : seen.reduce((sum, p) => sum + p[2], 0) / seen.length, ...style});
    };
    for (const member of data.members) {
      const points = this.curve(member, motion, scale, pieces) || (ghost ? member.ends : null);
      if (!points) continue;
      const colour = this.colours[data.structure[member.nodes[0]] % this.colours.length];
      const style = ghost ? {stroke: "#ccd2d8", width: 1} : member.curved ? {stroke: colour, width: 2.4}
        : {stroke: tinted(colour, 0.5), width: 1.2};
      const offset = this.offset(data.structure[member.nodes[0]]);
      if (ghost || points.length === 2) add(points, style, offset);
      else for (let k = 1; k < points.length; ++k) add([points[k - 1], points[k]], style, offset);
    }
    if (ghost) return;
    const place = node => { const u = this.moved(motion, node, scale); return data.position[node].map((x, k) => x + (u ? u[0][k] : 0)); };
    for (const slab of data.slabs) {
      const colour = this.colours[data.structure[slab[0]] % this.colours.length];
      const rgb = [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16)).join(",");
      add(slab.map(place), {fill: "rgba(" + rgb + ",0.16)", stroke: "rgba(" + rgb + ",0.5)", width: 1},
        this.offset(data.structure[slab[0]]));
    }
    for (const node of data.points) {
      add([place(node)], {dot: 6, stroke: this.colours[data.structure[node] % this.colours.length]}, this.offset(data.structure[node]));
    }
    for (const wall of data.walls) {
      add(wall.corners, {fill: "rgba(90, 98, 107, 0.22)", stroke: "#8a929b", width: 1}, this.offset(wall.structure, wall.across));
    }
  }

  ground(c) {
    const pad = 0.06 * this.radius, [x, y] = [0, 1].map(k => [this.low[k] - pad, this.high[k] + pad]), z = this.low[2];
    const corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]].map(p => this.project([...p, z]));
    c.beginPath();
    corners.forEach((p, k) => k ? c.lineTo(p[0], p[1]) : c.moveTo(p[0], p[1]));
    c.closePath();
    c.fillStyle = "#eef1f4";
    c.fill();
  }

  // Rings where structures touched in the last tenth of a second.
  flashes(c, motion) {
    const shown = 0.1 * Math.max(1, this.speed), most = Math.max(...this.poundings.map(p => p.impulse), 1e-300);
    for (const {t, duration, pair, impulse} of this.poundings) {
      const age = this.time - t - duration, where = this.data.pairs[pair];
      if (this.time < t - 1e-9 || age > shown || !where) continue;
      const u = where.node >= 0 ? this.moved(motion, where.node, this.scale) : null;
      const offset = where.node >= 0 ? this.offset(this.data.structure[where.node]) : [0, 0, 0];
      const p = this.project(where.position.map((x, k) => x + offset[k] + (u ? u[0][k] : 0)));
      c.strokeStyle = "rgba(140, 29, 64, " + Math.min(1, 1 - 0.8 * Math.max(0, age) / shown) + ")";
      c.lineWidth = 3;
      c.beginPath();
      c.arc(p[0], p[1], 7 + 10 * Math.sqrt(impulse / most), 0, 7);
      c.stroke();
    }
  }

  axes(c, height) {
    c.font = "12.5px system-ui, 'DejaVu Sans', sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    [["x", 0], ["y", 1], ["z", 2]].forEach(([name, k]) => {
      const e = [0, 1, 2].map(d => d === k ? 1 : 0), x = 34 + 24 * dot(e, this.right), y = height - 34 - 24 * dot(e, this.up);
      c.strokeStyle = c.fillStyle = "#57606a";
      c.lineWidth = 1.2;
      c.beginPath();
      c.moveTo(34, height - 34);
      c.lineTo(x, y);
      c.stroke();
      c.fillText(name, 34 + 33 * dot(e, this.right), height - 34 - 33 * dot(e, this.up));
    });
  }

  listen() {
    const {canvas, camera} = this, held = new Map();
    const spread = () => { const [a, b] = [...held.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => held.delete(event.pointerId));
    canvas.addEventListener("pointermove", event => {
      const last = held.get(event.pointerId);
      if (!last) return;
      const before = held.size === 2 ? spread() : 0, now = {x: event.clientX, y: event.clientY};
      held.set(event.pointerId, now);
      if (held.size === 2) {
        camera.zoom = Math.min(20, Math.max(0.2, camera.zoom * spread() / Math.max(1, before)));
      } else {
        camera.azimuth -= 0.008 * (now.x - last.x);
        camera.elevation = Math.min(1.57, Math.max(-0.2, camera.elevation + 0.008 * (now.y - last.y)));
      }
      this.draw();
    });
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      camera.zoom = Math.min(20, Math.max(0.2, camera.zoom * Math.exp(-0.001 * event.deltaY)));
      this.draw();
    }, {passive: false});
  }

  controls() {
    const {data} = this, controls = element("div", {class: "controls"});
    if (this.frames) {
      const end = data.times[data.times.length - 1];
      this.play = element("button", {type: "button", class: "plain main", text: "Play", onclick: () => this.toggle()});
      this.slider = element("input", {type: "range", min: 0, max: end, step: end / 4000, value: 0, "aria-label": "Time",
        oninput: () => this.go(+this.slider.value)});
      this.clockText = element("output");
      const speed = element("select", {"aria-label": "Speed", onchange: () => { this.speed = +speed.value; }},
        ...[0.05, 0.1, 0.25, 0.5, 1, 2].map(s => element("option", {value: s, text: s + " ×"})));
      speed.value = "1";
      const scaleText = element("output", {text: "× " + figure(this.scale)});
      const scaleSlider = element("input", {type: "range", min: 0, max: 4, step: 0.02, "aria-label": "Scale of displacements"});
      scaleSlider.addEventListener("input", () => {
        this.scale = +(10 ** scaleSlider.value).toPrecision(2);
        this.extent();
        scaleText.textContent = "× " + figure(this.scale, 2);
        this.draw();
      });
      scaleSlider.value = Math.log10(this.scale);
      controls.append(this.play, element("label", {class: "time"}, "Time", this.slider, this.clockText),
        element("label", {}, "Speed", speed), element("label", {}, "Displacements", scaleSlider, scaleText));
    }
    const ghost = element("input", {type: "checkbox", onchange: () => { this.ghost = ghost.checked; this.draw(); }});
    ghost.checked = true;
    const look = (text, azimuth, elevation) => element("button", {type: "button", class: "plain", text,
      onclick: () => { Object.assign(this.camera, {azimuth, elevation, zoom: 1}); this.draw(); }});
    if (this.frames) controls.append(element("label", {}, ghost, "Undeformed"));
    controls.append(look("3D", -1.12, 0.3), look("Front", -Math.PI / 2, 0), look("Side", 0, 0), look("Top", -Math.PI / 2, Math.PI / 2));
    const strongest = this.poundings.reduce((best, p) => p.impulse > best.impulse ? p : best, {t: 0, impulse: 0});
    this.show(strongest.t, true);
    return controls;
  }

  show(time, silent) {
    this.time = time;
    if (this.slider) {
      this.slider.value = time;
      this.clockText.textContent = time.toFixed(3) + " s";
    }
    if (!silent) this.draw();
  }
  go(time) {
    this.show(time);
    this.told = true;
    this.clock.point(time);
    this.told = false;
  }
  toggle() {
    this.playing = !this.playing;
    this.play.textContent = this.playing ? "Pause" : "Play";
    const end = this.data.times[this.data.times.length - 1];
    if (!this.playing) return;
    if (this.time >= end) this.time = 0;
    let last = null;
    const step = now => {
      if (!this.playing) return;
      if (last !== null) this.go(Math.min(end, this.time + this.speed * Math.min(0.1, (now - last) / 1000)));
      last = now;
      if (this.time >= end) this.toggle(); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
