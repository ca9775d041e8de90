"use strict";
/* The model in 3-D: tubes, supports, arrows.  Numbers come from the page's data, in SI. */
const DATA = JSON.parse(document.getElementById("data").textContent);

(function () {
  const scene = DATA.scene, stage = document.getElementById("scene");
  if (!scene) { stage.parentNode.parentNode.hidden = true; return; }
  const floats = (text) => {
    const raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
    return new Float32Array(bytes.buffer);
  };
  const at = floats(scene.at), tangent = floats(scene.tangent), radius = floats(scene.radius);
  const nodes = floats(scene.nodes), first = scene.first, n = radius.length;
  const up = scene.up, unit = scene.units, n_node = scene.labels.length;
  const SIDES = n > 12000 ? 6 : n > 4000 ? 8 : 14;
  const KIND = { anchor: "#1b2430", displacement: "#6b7686", rest: "#2f4b7c", "hold-down": "#c05a00",
    guide: "#b8860b", "limit stop": "#7a3ea1", spring: "#5a7d1a", hanger: "#0b7a75",
    snubber: "#8b4513" };
  const PIXELS = 2;  /* of the canvas, for one of the page; plotly draws its letters in these */
  const STATE = { open: "#9aa1ab", engaged: "#2f6db5", stick: "#2a8f55", slip: "#e07b00",
    free: "#b9a3d0", locked: "#6a3d9a", none: "#44546a" };
  const FIELDS = { move: ["displacement", "movement"], axial: ["axial force", "force"],
    shear: ["shear force", "force"], bending: ["bending moment", "moment"],
    torsion: ["torsion", "moment"], stress: ["von Mises stress", "stress"] };
  const SEQUENTIAL = [[0, "#2c5f9e"], [0.25, "#4fa3c7"], [0.5, "#9ed28b"], [0.75, "#f3c03f"],
    [1, "#c8321f"]];
  const DIVERGING = [[0, "#2b5ea8"], [0.25, "#8db3dc"], [0.5, "#e4e4e4"], [0.75, "#e8a07c"],
    [1, "#b3261e"]];
  const escape = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");
  const digits = (x) => (Math.abs(x) < 5e-13 ? "0" : Number(x.toPrecision(5)).toString());

  /* vectors */
  const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0]];
  const norm = (a) => Math.hypot(a[0], a[1], a[2]);
  const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
  const aside = (a) => {
    const b = [0, 0, 0], m = a.map(Math.abs);
    b[m.indexOf(Math.min(...m))] = 1;
    const c = cross(a, b);
    return scaled(c, 1 / norm(c));
  };
  const place = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];

  let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < n_node; i++) for (let k = 0; k < 3; k++) {
    low[k] = Math.min(low[k], nodes[3 * i + k]); high[k] = Math.max(high[k], nodes[3 * i + k]);
  }
  const size = Math.max(norm(add(high, low, -1)), 1e-6);
  const thick = radius.slice().sort()[Math.floor(n / 2)] || size / 300;
  const thin = size / 900;  /* radius below which a pipe would not be seen */

  const cases = scene.cases.map((c) => {
    const found = { ...c, move: floats(c.move), u: floats(c.u), load: floats(c.load) };
    for (const key of ["axial", "shear", "bending", "torsion", "stress"]) found[key] = floats(c[key]);
    return found;
  });
  const value = (c, key, i) => key === "move"
    ? Math.hypot(c.move[3 * i], c.move[3 * i + 1], c.move[3 * i + 2]) : c[key][i];

  /* the picture ends where the window does */
  stage.style.setProperty("--above", Math.ceil(stage.getBoundingClientRect().top +
    window.scrollY) + 14 + "px");

  /* one mesh of all pipes */
  const rings = [], faces = { i: [], j: [], k: [] };
  for (let e = 0; e + 1 < first.length; e++) {
    let side = null;
    for (let p = first[e]; p < first[e + 1]; p++) {
      const t = place(tangent, p);
      side = side === null ? aside(t) : add(side, t, -dot(side, t));
      const length = norm(side);
      side = length > 1e-6 ? scaled(side, 1 / length) : aside(t);
      const other = cross(t, side);
      const r = Math.max(radius[p], radius[p] > 0 ? thin : 0.4 * thin);
      for (let a = 0; a < SIDES; a++) {
        const w = 2 * Math.PI * a / SIDES, c = r * Math.cos(w), s = r * Math.sin(w);
        rings.push(side[0] * c + other[0] * s, side[1] * c + other[1] * s,
          side[2] * c + other[2] * s);
        if (p > first[e]) {
          const b = (a + 1) % SIDES, now = p * SIDES, back = now - SIDES;
          faces.i.push(back + a, back + b); faces.j.push(back + b, now + b);
          faces.k.push(now + a, now + a);
        }
      }
    }
  }
  const total = n * SIDES;

  function tubes(c, key, s) {
    const x = new Float32Array(total), y = new Float32Array(total), z = new Float32Array(total);
    const plain = key === "state" || !c, colour = plain ? null : new Float32Array(total);
    const q = plain ? null : unit[FIELDS[key][1]];
    let top = 0, bottom = 0;
    for (let p = 0; p < n; p++) {
      const d = c ? [s * c.move[3 * p], s * c.move[3 * p + 1], s * c.move[3 * p + 2]] : [0, 0, 0];
      let v = plain ? 0 : value(c, key, p) * q.factor;
      if (!Number.isFinite(v)) v = 0;
      top = Math.max(top, v); bottom = Math.min(bottom, v);
      for (let a = 0; a < SIDES; a++) {
        const i = p * SIDES + a;
        x[i] = at[3 * p] + d[0] + rings[3 * i];
        y[i] = at[3 * p + 1] + d[1] + rings[3 * i + 1];
        z[i] = at[3 * p + 2] + d[2] + rings[3 * i + 2];
        if (colour) colour[i] = v;
      }
    }
    const mesh = { type: "mesh3d", x, y, z, ...faces, hoverinfo: "text", flatshading: false,
      lighting: { ambient: 0.82, diffuse: 0.4, specular: 0.08, roughness: 0.6, fresnel: 0.05 },
      lightposition: { x: 1e5 * (up[0] + 0.6), y: 1e5 * (up[1] + 0.4), z: 1e5 * (up[2] + 0.8) } };
    if (plain) return { ...mesh, intensity: new Float32Array(total), cmin: 0, cmax: 1,
      colorscale: [[0, "#c3cbd6"], [1, "#c3cbd6"]], showscale: false };
    const signed = bottom < -1e-9 * top - 1e-300, most = Math.max(top, -bottom) || 1;
    return { ...mesh, intensity: colour, cmin: signed ? -most : 0, cmax: most,
      colorscale: signed ? DIVERGING : SEQUENTIAL, showscale: true,
      colorbar: { title: { text: FIELDS[key][0] + " [" + q.unit + "]", side: "right",
        font: { size: 12 } }, thickness: 12, len: 0.72, x: 1, xpad: 4, outlinewidth: 0,
        tickfont: { size: 11 }, nticks: 7 } };
  }

  /* small solids of supports in one mesh */
  /* supports, arrows and movements stay small against spans where there are many of these */
  const spans = scene.spans.slice().sort((a, b) => a - b);
  const bay = spans.length ? spans[Math.floor(spans.length / 2)] || size : size;
  const glyph = Math.max(Math.min(2.2 * thick, size / 25), Math.min(size / 75, 0.25 * bay));
  const reach = Math.min(0.1 * size, 2.5 * bay);
  /* `say` is what pointing at the next solids shows */
  const solids = () => ({ x: [], y: [], z: [], i: [], j: [], k: [], facecolor: [], text: [],
    say: "" });
  const put = (m, p) => { m.x.push(p[0]); m.y.push(p[1]); m.z.push(p[2]); m.text.push(m.say); };
  function cone(m, tip, axis, length, wide, colour) {
    const side = aside(axis), other = cross(axis, side), base = m.x.length, sides = 10;
    put(m, tip);
    const foot = add(tip, axis, -length);
    put(m, foot);
    for (let a = 0; a < sides; a++) {
      const w = 2 * Math.PI * a / sides;
      put(m, add(add(foot, side, wide * Math.cos(w)), other, wide * Math.sin(w)));
    }
    for (let a = 0; a < sides; a++) {
      const p = base + 2 + a, q = base + 2 + (a + 1) % sides;
      m.i.push(base, base + 1); m.j.push(p, q); m.k.push(q, p);
      m.facecolor.push(colour, colour);
    }
  }
  function box(m, centre, axes, half, colour) {
    const base = m.x.length;
    for (const a of [-1, 1]) for (const b of [-1, 1]) for (const c of [-1, 1]) {
      put(m, add(add(add(centre, axes[0], a * half[0]), axes[1], b * half[1]), axes[2],
        c * half[2]));
    }
    for (const [i, j, k] of [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]) {
      m.i.push(base + i); m.j.push(base + j); m.k.push(base + k); m.facecolor.push(colour);
    }
  }
  function stroke(line, points, colour) {
    for (const p of [...points, [null, null, null]]) {
      line.x.push(p[0]); line.y.push(p[1]); line.z.push(p[2]); line.color.push(colour);
    }
  }
  function coil(line, from, axis, length, wide, colour) {
    const side = aside(axis), steps = 9, points = [from];
    for (let a = 1; a < steps; a++) {
      const foot = add(from, axis, length * a / steps);
      points.push(add(foot, side, a % 2 ? wide : -wide));
    }
    stroke(line, [...points, add(from, axis, length)], colour);
  }
  function kind(card, hold) {
    if (card.kind in KIND && card.kind !== "spring") return card.kind;
    if (hold.spring) return "spring";
    if (hold.word === "GUIDE") return "guide";
    const normal = hold.normals[0], upward = Math.sign(dot(normal, up));
    if (hold.word === "LIMIT") return "limit stop";
    if (Math.abs(dot(normal, up)) > 0.85)
      return hold.sides.includes(-upward) ? "rest" : "hold-down";
    return Math.abs(dot(normal, card.axis)) > 0.85 ? "limit stop" : "guide";
  }
  const found_kinds = new Set(scene.cards.flatMap((card) => card.holds.length
    ? card.holds.map((hold) => kind(card, hold)) : card.kind in KIND ? [card.kind] : []));
  const frame = (axis) => { const s = aside(axis); return [axis, s, cross(axis, s)]; };

  function support(m, line, card, where, coloured) {
    let colour = coloured(card.kind);
    const r = Math.max(card.radius, thin), g = glyph;
    if (card.kind === "anchor" || card.kind === "displacement") {
      const axes = norm(card.axis) > 0.5 ? frame(card.axis) : frame([1, 0, 0]);
      box(m, where, axes, [0.35 * g, r + 0.6 * g, r + 0.6 * g], colour);
      return;
    }
    if (card.kind === "hanger") {
      const top = add(where, up, r);
      coil(line, top, up, 2.6 * g, 0.4 * g, colour);
      box(m, add(top, up, 2.7 * g), frame(up), [0.12 * g, 0.8 * g, 0.8 * g], colour);
      return;
    }
    for (const hold of card.holds) for (const normal of hold.normals) {
      colour = coloured(kind(card, hold));
      if (card.kind === "snubber") {
        const axes = frame(normal);
        const end = add(where, normal, r + 2.4 * g);
        stroke(line, [where, end], colour);
        box(m, add(where, normal, r + 1.4 * g), axes, [0.7 * g, 0.3 * g, 0.3 * g], colour);
        box(m, end, axes, [0.12 * g, 0.6 * g, 0.6 * g], colour);
        continue;
      }
      const sides = hold.normals.length > 1 ? [-1, 1] : hold.sides;
      const lengthwise = Math.abs(dot(normal, card.axis)) > 0.85;
      const off = lengthwise ? add(where, up, -r - 0.35 * g) : where;
      for (const s of sides) {
        const out = scaled(normal, s);
        if (hold.spring) coil(line, add(where, out, r), out, 1.8 * g, 0.35 * g, colour);
        else if (lengthwise)
          cone(m, add(off, out, 0.1 * g), scaled(out, -1), 0.9 * g, 0.3 * g, colour);
        else cone(m, add(where, out, r), scaled(out, -1), g, 0.5 * g, colour);
      }
    }
  }

  function furniture(c, s, options) {
    const m = solids(), line = { x: [], y: [], z: [], color: [] }, traces = [];
    const arrows = solids(), shaft = { x: [], y: [], z: [] };
    let most = 0;
    if (c) for (let i = 0; i < scene.cards.length; i++)
      most = Math.max(most, Math.hypot(c.load[6 * i], c.load[6 * i + 1], c.load[6 * i + 2]));
    scene.cards.forEach((card, i) => {
      const u = c ? place2(c.u, card.node, s) : [0, 0, 0];
      const where = add(place(nodes, card.node), u);
      const state = c && c.state[i] >= 0 ? scene.states[c.state[i]] : "none";
      const coloured = (kind) => options.colour === "state" ? STATE[state] : KIND[kind];
      m.say = arrows.say = "<b>" + escape(card.name) + "</b>" + (c ? "<br>" + (state === "none"
        ? "" : state + "<br>") + load(c, i) : "");
      if (options.supports) support(m, line, card, where, coloured);
      if (!c || !options.arrows || most === 0) return;
      const f = [c.load[6 * i], c.load[6 * i + 1], c.load[6 * i + 2]], amount = norm(f);
      if (amount < 1e-3 * most) return;
      const axis = scaled(f, 1 / amount), length = reach * (0.15 + 0.85 * amount / most);
      const start = add(where, axis, card.radius), tip = add(start, axis, length);
      const head = Math.min(0.4 * length, 0.18 * reach);
      const neck = add(tip, axis, -head);
      shaft.x.push(start[0], neck[0], null); shaft.y.push(start[1], neck[1], null);
      shaft.z.push(start[2], neck[2], null);
      cone(arrows, tip, axis, head, 0.35 * head, "#c2185b");
    });
    const solid = { type: "mesh3d", hoverinfo: "text", flatshading: true,
      lighting: { ambient: 0.88, diffuse: 0.3, specular: 0.02 } };
    if (m.i.length) traces.push({ ...solid, ...m });
    if (line.x.length) traces.push({ type: "scatter3d", mode: "lines",
      x: line.x, y: line.y, z: line.z, hoverinfo: "skip", showlegend: false,
      line: { color: line.color, width: 3 } });
    if (arrows.i.length) traces.push({ ...solid, ...arrows }, { type: "scatter3d", mode: "lines",
      ...shaft, hoverinfo: "skip", showlegend: false, line: { color: "#c2185b", width: 4 } });
    return traces;
  }
  /* many nodes: their marks take the pipe's colours */
  const MANY = n_node > 500 || bay < size / 60, held = new Map();
  scene.cards.forEach((card, k) => held.set(card.node, [...(held.get(card.node) || []), k]));
  const place2 = (u, i, s) => [s * u[6 * i], s * u[6 * i + 1], s * u[6 * i + 2]];
  function load(c, i) {
    return "load on the restraint<br>F " + three(c.load, 6 * i, unit.force) + "<br>M " +
      three(c.load, 6 * i + 3, unit.moment);
  }

  const three = (list, i, q) => [0, 1, 2].map((k) => digits(list[i + k] * q.factor)).join("  ") +
    " " + q.unit;
  /* what pointing at a node shows: movements, and its supports with their loads */
  function told(c) {
    return scene.labels.map((label, i) => {
      const head = "<b>node " + escape(label) + "</b>";
      if (!c) return head;
      const own = (held.get(i) || []).map((k) => "<br>" + escape(scene.cards[k].name) + ": " +
        load(c, k));
      return head + "<br>moves " + three(c.u, 6 * i, unit.movement) + "<br>turns " +
        three(c.u, 6 * i + 3, unit.rotation) + own.join("");
    });
  }
  /* what pointing at a pipe shows: the node where one is near, else the element there */
  function spoken(c, told) {
    const text = new Array(total), force = unit.force, moment = unit.moment;
    for (let e = 0; e + 1 < first.length; e++) {
      const head = "<b>" + escape(scene.type[e] + " " + scene.element[e]) + "</b>";
      for (let p = first[e]; p < first[e + 1]; p++) {
        let said = p === first[e] ? told[scene.ends[e][0]] : p + 1 === first[e + 1]
          ? told[scene.ends[e][1]] : head;
        if (said === head && c) {
          said += "<br>moves " + three(c.move, 3 * p, unit.movement);
          if (Number.isFinite(c.stress[p])) said += "<br>axial " + digits(c.axial[p] *
            force.factor) + " " + force.unit + ", bending " + digits(c.bending[p] *
            moment.factor) + " " + moment.unit + "<br>von Mises " + digits(c.stress[p] *
            unit.stress.factor) + " " + unit.stress.unit;
        }
        text.fill(said, p * SIDES, (p + 1) * SIDES);
      }
    }
    return text;
  }

  function points(c, s, labelled, pipe, text) {
    const x = [], y = [], z = [];
    for (let i = 0; i < n_node; i++) {
      const u = c ? place2(c.u, i, s) : [0, 0, 0];
      x.push(nodes[3 * i] + u[0]); y.push(nodes[3 * i + 1] + u[1]); z.push(nodes[3 * i + 2] + u[2]);
    }
    const found = [{ type: "scatter3d", mode: "markers", x, y, z, text, hoverinfo: "text",
      showlegend: false, marker: MANY
        ? { size: 1.6, color: scene.node_point.map((p) => pipe.intensity[p * SIDES]),
          cmin: pipe.cmin, cmax: pipe.cmax, colorscale: pipe.colorscale, showscale: false }
        : { size: 2.5, color: "#1b2430" } }];
    if (labelled) {
      const lift = 0.6 * glyph + thick;
      found.push({ type: "scatter3d", mode: "text", x: x.map((v) => v + lift * up[0]),
        y: y.map((v) => v + lift * up[1]), z: z.map((v) => v + lift * up[2]),
        text: scene.labels.map(escape), hoverinfo: "skip", showlegend: false,
        textfont: { size: 12 * PIXELS, color: "#1b2430" } });
    }
    return found;
  }

  function ghost() {
    const x = [], y = [], z = [];
    for (let e = 0; e + 1 < first.length; e++) {
      for (let p = first[e]; p < first[e + 1]; p++) {
        x.push(at[3 * p]); y.push(at[3 * p + 1]); z.push(at[3 * p + 2]);
      }
      x.push(null); y.push(null); z.push(null);
    }
    return { type: "scatter3d", mode: "lines", x, y, z, hoverinfo: "skip", showlegend: false,
      line: { color: "#8b96a5", width: 2 } };
  }
  function triad() {
    const length = 0.07 * size, corner = standing(length);
    const found = { x: [], y: [], z: [], text: [] }, color = [];
    ["X", "Y", "Z"].forEach((name, k) => {
      const tip = [...corner];
      tip[k] += length;
      for (const [p, word] of [[corner, ""], [tip, name], [[null, null, null], ""]]) {
        found.x.push(p[0]); found.y.push(p[1]); found.z.push(p[2]); found.text.push(word);
        color.push(["#b3261e", "#2a8f55", "#2f6db5"][k]);
      }
    });
    return { type: "scatter3d", mode: "lines+text", ...found, hoverinfo: "skip",
      showlegend: false, line: { color, width: 4 }, textfont: { size: 12 * PIXELS, color: "#1b2430" } };
  }

  /* controls */
  const get = (id) => document.getElementById(id);
  cases.forEach((c, i) => get("case").add(new Option(c.name + " = " + c.text, i)));
  const wanted = cases.findIndex((c) => c.name.toUpperCase().startsWith("OPE"));
  get("case").value = String(Math.max(wanted, 0));
  function nice(x) {
    if (!(x > 0)) return 1;
    const power = 10 ** Math.floor(Math.log10(x));
    return [5, 2, 1].map((f) => f * power).find((f) => f <= x * 1.0000001);
  }
  function magnified(c) {
    let most = 0;
    for (let p = 0; p < n; p++) most = Math.max(most, value(c, "move", p));
    const slider = Number(get("scale").value);
    if (slider === 0 || most === 0) return 0;
    return nice(Math.min(0.04 * size, 0.6 * bay) / most * 10 ** ((slider - 50) / 60));
  }
  /* seen from above and aside, the longer horizontal side across */
  const high_axis = up[1] > 0.5 ? 1 : 2, level = [0, 3 - high_axis];
  const lengths = add(high, low, -1), across = lengths[level[0]] >= lengths[level[1]] ? 0 : 1;
  const eye = [0, 0, 0];
  eye[high_axis] = 0.85;
  eye[level[across]] = high_axis === 2 && across === 0 ? -0.75 : 0.75;
  eye[level[1 - across]] = high_axis === 2 && across === 0 ? -1.35 : 1.35;
  const room = 0.3 * size, ranges = low.map((v, k) => [v - room, high[k] + room]);
  const { fit, middle, right, rise } = fitted(), ratio = ranges.map((r) => fit * (r[1] - r[0]) / size);
  /* plotly shows a cube of 1 so that it takes 1/2.15 of the height; the model shall fill 3/4, and
     its outline as it is seen, not its box, stands in the middle */
  function fitted() {
    const toward = scaled(eye, 1 / norm(eye)), side = cross(up, toward);
    const right = scaled(side, 1 / norm(side)), rise = cross(toward, right);
    const centre = scaled(add(low, high), 0.5);
    const extent = (d) => {
      let a = Infinity, b = -Infinity;
      for (let i = 0; i < n_node; i++) {
        const v = dot(add(place(nodes, i), centre, -1), d);
        a = Math.min(a, v); b = Math.max(b, v);
      }
      return { size: b - a + 0.16 * size + 2 * thick, middle: 0.5 * (a + b) };
    };
    const across = extent(right), along = extent(rise);
    const { clientWidth: w, clientHeight: h } = stage;
    return { fit: 2.15 * size * Math.min(0.76 * (w / h) / across.size, 0.84 / along.size),
      middle: add(scaled(right, across.middle), rise, along.middle), right, rise };
  }
  /* the corner of the model's box that the axes stand at: the first at which all three are seen */
  function standing(length) {
    const corners = [0, 4, 2, 1, 6, 5, 3, 7].map((bits) => low.map((v, k) =>
      bits & (1 << k) ? high[k] + 0.02 * size : v - 0.02 * size));
    const seen = (v) => {
      const d = add(add(v, scaled(add(low, high), 0.5), -1), middle, -1), one = fit / size / 1.075;
      return Math.abs(dot(d, right)) * one < 0.9 * stage.clientWidth / stage.clientHeight &&
        Math.abs(dot(d, rise)) * one < 0.9;
    };
    return corners.find((v) => seen(v) && [0, 1, 2].every((k) =>
      seen(v.map((x, i) => x + (i === k ? length : 0))))) || corners[0];
  }
  /* what lies nearer than the eye is cut off, also where the wheel has made all of it larger; the
     distance changes nothing else, as the projection is parallel, but how fast the mouse moves it */
  const DISTANCE = 20 * Math.max(norm(ratio), 1);
  const axis = (k) => ({ visible: false, showspikes: false, range: ranges[k], autorange: false });
  function camera() {
    const xyz = (v) => ({ x: v[0], y: v[1], z: v[2] }), center = scaled(middle, fit / size);
    return { up: xyz(up), projection: { type: "orthographic" },
      eye: xyz(add(center, eye, DISTANCE / norm(eye))), center: xyz(center) };
  }
  const layout = { margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: false, uirevision: "kept",
    paper_bgcolor: "#fff", hoverlabel: { bgcolor: "#fff", bordercolor: "#44546a", align: "left",
      font: { color: "#1b2430", size: 12 } },
    scene: { aspectmode: "manual", aspectratio: { x: ratio[0], y: ratio[1], z: ratio[2] },
      xaxis: axis(0), yaxis: axis(1), zaxis: axis(2), dragmode: "orbit", camera: camera() } };

  function legend(key) {
    const host = get("legend");
    host.textContent = "";
    const put = (colour, text) => {
      const row = document.createElement("div"), mark = document.createElement("i");
      mark.style.background = colour;
      row.append(mark, text);
      host.append(row);
    };
    const c = cases[Number(get("case").value)];
    if (key === "state" && c) for (const state of new Set(c.state))
      put(state < 0 ? STATE.none : STATE[scene.states[state]],
        state < 0 ? "no state (combination)" : scene.states[state]);
    else for (const kind in KIND) if (get("supports").checked && found_kinds.has(kind))
      put(KIND[kind], kind === "displacement" ? "imposed displacement" : kind);
    if (get("arrows").checked) put("#c2185b", "load on the restraint");
  }
  function draw() {
    const c = cases[Number(get("case").value)], key = get("colour").value;
    const s = c ? magnified(c) : 0;
    get("factor").textContent = c ? "\u00d7 " + digits(s) : "";
    const options = { colour: key, supports: get("supports").checked,
      arrows: get("arrows").checked };
    const pipe = tubes(c, key, s), text = told(c);
    pipe.text = spoken(c, text);
    const traces = [pipe, ...furniture(c, s, options),
      ...points(c, s, get("names").checked, pipe, text), triad()];
    if (get("ghost").checked && s > 0) traces.push(ghost());
    legend(key);
    const colour = get("colour");
    get("caption").textContent = c ? c.name + " = " + c.text + ": " +
      colour.options[colour.selectedIndex].text + "; movements \u00d7 " + digits(s) : "";
    const config = { displaylogo: false, responsive: true, displayModeBar: false,
      scrollZoom: true, plotGlPixelRatio: PIXELS };
    return Plotly.react(stage, traces, layout, config).then(() => {
      const plot = stage._fullLayout.scene._scene;
      if (plot && plot.camera) plot.camera.translateSpeed = 2 / DISTANCE;
      stage.dataset.drawn = c ? c.name + " " + key : "model";
    });
  }
  for (const id of ["case", "colour", "ghost", "supports", "arrows", "names"])
    get(id).addEventListener("change", draw);
  get("scale").addEventListener("input", draw);
  get("controls").addEventListener("submit", (event) => event.preventDefault());
  get("home").addEventListener("click", () => {
    Plotly.relayout(stage, { "scene.camera": camera() });
  });
  /* a canvas of WebGL prints empty: a plain one takes its pixels and place, as wide as the paper */
  const paper = document.createElement("canvas"), WIDE = 1258, HIGH = 600, LOW = 300;
  /* a short account of the file fits on the first sheet with a lower picture, a long one has it to itself */
  const tall = () => {
    const left = HIGH - (document.querySelector(".origin")?.scrollHeight ?? 0);
    return left < LOW ? HIGH : left;
  };
  window.addEventListener("beforeprint", () => {
    const plot = stage._fullLayout?.scene?._scene?.glplot;
    if (!plot) return;
    const { clientWidth: w, clientHeight: h } = stage;
    const sizes = { wide: w + "px", high: h + "px", fit: Math.min(WIDE / w, tall() / h) };
    for (const name in sizes) stage.style.setProperty("--" + name, sizes[name]);
    plot.redraw();  /* its pixels last until this task ends */
    paper.width = plot.canvas.width;
    paper.height = plot.canvas.height;
    paper.getContext("2d").drawImage(plot.canvas, 0, 0);
    paper.style.cssText = "position: absolute; left: 0; top: 0; width: 100%; height: 100%";
    plot.canvas.after(paper);
    plot.canvas.style.visibility = "hidden";
  });
  window.addEventListener("afterprint", () => {
    if (!paper.parentNode) return;
    paper.previousSibling.style.visibility = "";
    paper.remove();
  });
  draw();
})();
