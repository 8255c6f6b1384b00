"use strict";
// What a run was, as lanes over time. R holds columns: one entry for each event, span, arrow or task.
const R = JSON.parse(document.getElementById("run").textContent);
const $ = (id) => document.getElementById(id);
const N = R.times.length - 1; // the last entry is the end of the run
const MOST = 500; // arrows of one kind that are drawn at once
const GUTTER = innerWidth < 700 ? 120 : 230, PAD = 16, HEAD = 34;
const STATES = ["run", "wait", "sleep", "recover", "cleanup", "interrupt"];
const ARROWS = ["start", "signal", "abort", "interrupt", "failure", "join"];
const MARKS = { // kind: [colour, shape, rank]
  "failure": ["bad", "cross", 9], "deadlock": ["bad", "cross", 9], "failure-passed": ["bad", "diamond", 8],
  "run-stopped": ["bad", "bar", 8], "recovery": ["recover", "turn", 7], "failure-taken": ["recover", "turn", 7],
  "interrupt": ["interrupt", "bolt", 6], "abort": ["abort", "stop", 6], "period-missed": ["recover", "dot", 5],
  "goal": ["goal", "flag", 4], "checkpoint": ["signal", "box", 3], "signal": ["signal", "wedge", 3],
  "deactivated": ["abort", "dot", 3], "action": ["signal", "dot", 1],
  "goal-changed": ["goal", "dot", 3], "fact": ["fact", "ring", 2], "lock": ["goal", "ring", 2], "resource": ["goal", "ring", 2],
};
const ENDS = { succeeded: ["good", "tick"], failed: ["bad", "cross"], aborted: ["abort", "stop"] };
const LEGEND = [
  ["span", "run", "works"], ["span", "wait", "waits"], ["span", "sleep", "sleeps"], ["span", "recover", "recovers"],
  ["span", "cleanup", "cleans up"], ["span", "interrupt", "is interrupted"], ["arrow", "signal", "signal wakes"],
  ["arrow", "failure", "failure passed on"], ["arrow", "interrupt", "interrupts"], ["arrow", "abort", "aborts"],
  ["arrow", "start", "starts"], ["arrow", "join", "end awaited"], ["mark", "failure", "failure"],
  ["mark", "recovery", "recovery"], ["mark", "signal", "signal"], ["mark", "checkpoint", "checkpoint"],
  ["mark", "failure-passed", "failure of another"], ["mark", "period-missed", "period missed"], ["mark", "run-stopped", "run stopped"],
  ["mark", "goal", "goal"], ["mark", "goal-changed", "goal of the agent"], ["mark", "fact", "fact"], ["mark", "action", "action"], ["mark", "deactivated", "deactivated"], ["mark", "lock", "property lock"], ["mark", "resource", "resource"], ["end", "succeeded", "succeeded"], ["end", "aborted", "aborted"],
];
const state = { scale: "balanced", from: 0, to: 1, hover: null, chosen: null, off: new Set(), shut: new Set(), find: "", row: 26 };
const head = $("head"), lanes = $("lanes"), scroll = $("scroll"), tip = $("tip"), more = $("more");
let X, rows, rowOf, ink = {}, width = 0, height = 0, asked = false;

// --- what is where --------------------------------------------------------------------

const bySpan = R.tasks.map(() => []), byMark = R.tasks.map(() => []), byTask = R.tasks.map(() => []), byEvent = new Map();
R.spans.forEach((span) => bySpan[span[0]].push(span));
for (let i = 0; i < N; i++) {
  const task = R.subject[i];
  if (task < 0) continue;
  byTask[task].push(i);
  if (MARKS[R.kinds[R.kind[i]]]) byMark[task].push(i);
}
for (const arrow of R.arrows) {
  for (const i of [arrow[2], arrow[4]]) {
    if (!byEvent.has(i)) byEvent.set(i, []);
    byEvent.get(i).push(arrow);
  }
}

function layOut() { // X: where each event stands, from 0 to 1
  X = new Float64Array(N + 1);
  const gap = (i) => Math.max(0, R.times[i] - R.times[i - 1]);
  let share = { balanced: 0.55, time: 1, order: 0 }[state.scale], total = 0;
  const stretch = state.scale === "balanced" ? (d) => Math.pow(d, 0.7) : (d) => d;
  for (let i = 1; i <= N; i++) total += stretch(gap(i));
  if (!total) share = 0;
  for (let i = 1; i <= N; i++) X[i] = X[i - 1] + (total ? share * stretch(gap(i)) / total : 0) + (1 - share) / N;
  const last = X[N] || 1;
  for (let i = 0; i <= N; i++) X[i] /= last;
}

function listRows() { // the tasks that are shown, in tree order
  const words = state.find.toLowerCase(), keep = new Set();
  if (words) R.tasks.forEach((task, t) => { if (task.name.toLowerCase().includes(words)) for (let a = t; a >= 0; a = R.tasks[a].parent) keep.add(a); });
  rows = []; rowOf = new Map();
  const hidden = new Set();
  R.tasks.forEach((task, t) => {
    if (hidden.has(task.parent) || (task.parent >= 0 && state.shut.has(task.parent))) { hidden.add(t); return; }
    if (words && !keep.has(t)) return;
    rowOf.set(t, rows.length); rows.push(t);
  });
  const room = scroll.clientHeight - 8;
  state.row = Math.max(19, Math.min(44, Math.floor(room / Math.max(rows.length, 1))));
  $("tall").style.height = Math.max(rows.length * state.row + 8, scroll.clientHeight) + "px";
}

const plot = () => width - GUTTER - 2 * PAD;
const toX = (x) => GUTTER + PAD + (x - state.from) / (state.to - state.from) * plot();
const toUnit = (px) => state.from + (px - GUTTER - PAD) / plot() * (state.to - state.from);
const xOf = (i) => toX(X[i]);
const yOf = (row) => row * state.row + 4 - scroll.scrollTop + state.row / 2;
const lowest = (list, test) => { let a = 0, b = list.length; while (a < b) { const m = (a + b) >> 1; if (test(list[m])) b = m; else a = m + 1; } return a; };
const seconds = (t) => t.toFixed(t < 1 && R.fine ? 6 : 3);
function timeAt(px) {
  const u = Math.min(1, Math.max(0, toUnit(px))), i = Math.max(1, lowest(X, (x) => x >= u));
  const a = X[i - 1], b = X[i] ?? a;
  return R.times[i - 1] + (b > a ? (u - a) / (b - a) : 0) * ((R.times[i] ?? R.times[i - 1]) - R.times[i - 1]);
}

// --- drawing ----------------------------------------------------------------------------

function size(canvas, w, h) {
  const ratio = devicePixelRatio || 1;
  canvas.width = w * ratio; canvas.height = h * ratio; canvas.style.height = h + "px";
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  return pen;
}
function readInk() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["back", "panel", "ink", "dim", "faint", "line", "stripe", "hover", "focus", "run", "wait", "wait-ink", "wait-edge",
    "sleep", "sleep-ink", "sleep-edge", "recover", "cleanup", "interrupt", "good", "bad", "abort", "open", "signal", "start", "join", "goal", "fact"])
    ink[name] = style.getPropertyValue("--" + name).trim();
}
const ask = () => { if (!asked) { asked = true; requestAnimationFrame(draw); } };

function draw() {
  asked = false;
  width = scroll.clientWidth; height = scroll.clientHeight;
  const pen = size(lanes, width, height), first = Math.max(0, Math.floor(scroll.scrollTop / state.row) - 1);
  const last = Math.min(rows.length, first + Math.ceil(height / state.row) + 2);
  drawHead(pen);
  for (let r = first; r < last; r++) drawBack(pen, r);
  pen.save(); pen.beginPath(); pen.rect(GUTTER, 0, width - GUTTER, height); pen.clip();
  for (let r = first; r < last; r++) drawLane(pen, rows[r], yOf(r));
  drawArrows(pen, first, last);
  for (let r = first; r < last; r++) drawMarks(pen, rows[r], yOf(r));
  if (state.hover) { pen.fillStyle = ink.faint; pen.fillRect(state.hover.px, 0, 1, height); }
  pen.restore();
  pen.fillStyle = ink.line; pen.fillRect(GUTTER, 0, 1, height);
  const a = timeAt(GUTTER + PAD), b = timeAt(width - PAD);
  $("span").textContent = state.from > 0 || state.to < 1 ? `${seconds(a)} – ${seconds(b)} s` : "";
}

function drawHead(lanesPen) {
  const pen = size(head, width, HEAD - 1);
  pen.font = "12px system-ui, sans-serif"; pen.fillStyle = ink.dim; pen.textBaseline = "middle";
  pen.fillText(`${R.tasks.length} task${R.tasks.length === 1 ? "" : "s"}`, 16, HEAD / 2);
  const put = (px, label) => {
    pen.fillStyle = ink.line; pen.fillRect(px, HEAD - 9, 1, 9);
    lanesPen.fillStyle = ink.line; lanesPen.globalAlpha = 0.7; lanesPen.fillRect(px, 0, 1, height); lanesPen.globalAlpha = 1;
    pen.fillStyle = ink.dim; pen.fillText(label, px + 4, HEAD / 2);
  };
  const right = width - 52;
  if (state.scale === "time") {
    const a = timeAt(GUTTER + PAD), b = timeAt(width - PAD), raw = (b - a) / Math.max(2, plot() / 110);
    if (raw > 0) {
      const power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw);
      const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
      for (let k = Math.ceil(a / step - 1e-9); k * step <= b + step / 1e6; k++) {
        const px = toX(k * step / (R.times[N] || 1));
        if (px < right) put(px, (k * step).toFixed(Math.min(places, 9)) + " s");
      }
    }
  } else {
    let free = GUTTER;
    for (let i = Math.max(0, lowest(X, (x) => x >= state.from - 1e-12)); i <= N && X[i] <= state.to + 1e-12; i++) {
      if (i && R.times[i] === R.times[i - 1]) continue;
      const px = xOf(i);
      if (px < free) { const next = lowest(X, (x) => toX(x) >= free); if (next > i + 1) i = next - 1; continue; }
      if (px > right) break;
      put(px, seconds(R.times[i]) + " s"); free = px + 78;
    }
  }
  if (state.hover && state.hover.px > GUTTER) {
    const label = seconds(timeAt(state.hover.px)) + " s", w = pen.measureText(label).width + 12, px = Math.min(state.hover.px, width - w);
    pen.fillStyle = ink.ink; pen.beginPath(); pen.roundRect(px, 7, w, 20, 5); pen.fill();
    pen.fillStyle = ink.panel; pen.fillText(label, px + 6, HEAD / 2);
  }
}

function drawBack(pen, r) {
  const t = rows[r], task = R.tasks[t], y = yOf(r), h = state.row;
  const lit = (state.hover && state.hover.task === t) || (state.chosen && state.chosen.task === t);
  if (lit || r % 2) { pen.fillStyle = lit ? ink.hover : ink.stripe; pen.fillRect(0, y - h / 2, width, h); }
  const small = h < 24, indent = 14 + Math.min(task.depth, 8) * (small ? 10 : 13);
  if (task.depth) { // the branch from its parent
    pen.strokeStyle = ink["wait-edge"]; pen.lineWidth = 1; pen.beginPath();
    const up = rowOf.get(task.parent), x = indent - 7;
    if (up !== undefined) { pen.moveTo(x + 0.5, yOf(up) + 7); pen.lineTo(x + 0.5, Math.round(y) + 0.5); pen.lineTo(indent, Math.round(y) + 0.5); pen.stroke(); }
  }
  const [colour, shape] = ENDS[task.status] || ["open", "dot"];
  glyph(pen, shape, indent + 8, y, small ? 4.5 : 5.5, ink[colour]);
  pen.font = `${task.depth ? "" : "600 "}${small ? 11.5 : 13}px ui-monospace, "DejaVu Sans Mono", monospace`;
  pen.textBaseline = "middle"; pen.fillStyle = task.status === "failed" ? ink.bad : ink.ink;
  const room = GUTTER - indent - (task.children ? 44 : 28);
  pen.fillText(fitted(pen, task.name, room), indent + 20, y + 0.5);
  if (task.children) { pen.fillStyle = ink.faint; pen.font = "10px system-ui"; pen.fillText(state.shut.has(t) ? "▸" + task.children : "▾", GUTTER - 24, y); }
}

function fitted(pen, text, room) {
  if (room < 14) return "";
  if (pen.measureText(text).width <= room) return text;
  let keep = Math.floor(text.length * room / pen.measureText(text).width);
  while (keep > 0 && pen.measureText(text.slice(0, keep) + "…").width > room) keep--;
  return keep > 0 ? text.slice(0, keep) + "…" : "";
}

function drawLane(pen, t, y) {
  const spans = bySpan[t], h = Math.round(state.row * 0.58), top = Math.round(y - h / 2);
  let done = -1;
  pen.font = `${state.row < 24 ? 10 : 11.5}px system-ui, sans-serif`; pen.textBaseline = "middle";
  for (let k = lowest(spans, (s) => X[s[3]] >= state.from); k < spans.length; k++) {
    const [, kind, a, b, cause] = spans[k];
    if (X[a] > state.to) break;
    const left = Math.max(xOf(a), GUTTER - 9), right = Math.min(xOf(b), width + 9), wide = right - left;
    if (right < done + 0.7) continue;
    done = right;
    const name = STATES[kind], quiet = name === "wait" || name === "sleep";
    pen.fillStyle = ink[name];
    if (wide < 3) { pen.fillRect(left, top, Math.max(wide, 0.8), h); continue; }
    pen.beginPath(); pen.roundRect(left + 0.5, top + 0.5, Math.max(wide - 1, 1), h - 1, Math.min(4, wide / 2)); pen.fill();
    if (quiet) { pen.strokeStyle = ink[name + "-edge"]; pen.lineWidth = 1; pen.stroke(); }
    if (wide > 26 && cause >= 0 && state.row >= 19) {
      pen.fillStyle = quiet ? ink[name + "-ink"] : "#fff";
      const label = R.strings[R.text[cause]].replace(/^(waits for (the )?|sleeps |recovers from |is interrupted: )/, "");
      const shown = fitted(pen, label, wide - 14);
      if (shown === label || shown.length > 6) pen.fillText(shown, left + 8, y + 0.5);
    }
  }
  const task = R.tasks[t], end = ENDS[task.status];
  if (end && X[task.ended] >= state.from) glyph(pen, end[1], xOf(task.ended), y, state.row < 24 ? 5 : 6.5, ink[end[0]], true);
}

function drawMarks(pen, t, y) {
  const list = byMark[t], r = state.row < 24 ? 4 : 5.5, taken = new Map();
  for (let k = lowest(list, (i) => X[i] >= state.from); k < list.length && X[list[k]] <= state.to; k++) {
    const i = list[k], [colour, shape, rank] = MARKS[R.kinds[R.kind[i]]], cell = Math.round(xOf(i) / 5), before = taken.get(cell);
    if (!before || before[1] < rank) taken.set(cell, [i, rank, colour, shape]);
  }
  for (const [i, , colour, shape] of taken.values()) glyph(pen, shape, xOf(i), y, r, ink[colour], true);
  const chosen = state.chosen;
  if (chosen && chosen.event !== undefined && R.subject[chosen.event] === t) {
    pen.strokeStyle = ink.focus; pen.lineWidth = 2; pen.beginPath(); pen.arc(xOf(chosen.event), y, r + 5, 0, 7); pen.stroke();
  }
}

function drawArrows(pen, first, last) {
  const seen = [], lit = new Set(), focus = state.hover?.event ?? state.chosen?.event;
  if (focus !== undefined) (byEvent.get(focus) || []).forEach((arrow) => lit.add(arrow));
  const cells = new Set(), number = ARROWS.map(() => 0);
  for (let k = lowest(R.arrows, (a) => X[a[4]] >= state.from); k < R.arrows.length; k++) {
    const arrow = R.arrows[k], [kind, source, a, target, b] = arrow;
    if (state.off.has(ARROWS[kind]) && !lit.has(arrow)) continue;
    const from = rowOf.get(source), to = rowOf.get(target);
    if (from === undefined || to === undefined || X[a] > state.to) continue;
    if (Math.max(from, to) < first || Math.min(from, to) >= last) continue;
    if (number[kind] > MOST && !lit.has(arrow)) continue;
    const cell = `${kind},${Math.round(xOf(a) / 4)},${Math.round(xOf(b) / 4)},${from},${to}`;
    if (cells.has(cell) && !lit.has(arrow)) continue;
    cells.add(cell); seen.push(arrow); number[kind]++;
  }
  const hidden = ARROWS.filter((_, kind) => number[kind] > MOST), faint = Math.min(1, Math.max(0.2, 50 / seen.length));
  $("hint").textContent = hidden.length ? `too many arrows (${hidden.map((name) => ({ signal: "signals", start: "starts", join: "ends" })[name] || name).join(", ")}): zoom in, or point at an event` : "";
  seen.filter((arrow) => lit.has(arrow) || number[arrow[0]] <= MOST).forEach((arrow) => drawArrow(pen, arrow, lit.has(arrow), lit.size && !lit.has(arrow) ? 0.25 * faint : faint));
}

function drawArrow(pen, [kind, source, a, target, b], lit, alpha) {
  const name = ARROWS[kind], x1 = xOf(a), y1 = yOf(rowOf.get(source)), x2 = xOf(b), y2 = yOf(rowOf.get(target));
  const down = Math.sign(y2 - y1) || 1, lip = state.row * 0.29, from = y1 + down * lip, to = y2 - down * (lip + 1), quiet = name === "start" || name === "join";
  pen.globalAlpha = lit ? 1 : quiet ? alpha * 0.75 : alpha;
  pen.strokeStyle = pen.fillStyle = ink[name === "failure" ? "bad" : name];
  pen.lineWidth = lit ? 2.2 : quiet ? 1 : 1.4;
  pen.setLineDash(name === "abort" ? [4, 3] : name === "join" ? [2, 3] : []);
  const bend = Math.min(Math.abs(to - from) * 0.5, 40) * down;
  pen.beginPath(); pen.moveTo(x1, from); pen.bezierCurveTo(x1, from + bend, x2, to - bend, x2, to - down * 4); pen.stroke();
  pen.setLineDash([]);
  pen.beginPath(); pen.moveTo(x2, to); pen.lineTo(x2 - 3.5, to - down * 6); pen.lineTo(x2 + 3.5, to - down * 6); pen.fill();
  pen.globalAlpha = 1;
}

function glyph(pen, shape, x, y, r, colour, halo) {
  pen.save(); pen.translate(x, y); pen.lineWidth = Math.max(1.4, r / 3.4); pen.lineCap = pen.lineJoin = "round";
  if (halo) { pen.fillStyle = ink.panel; pen.beginPath(); pen.arc(0, 0, r + 1.6, 0, 7); pen.fill(); }
  pen.fillStyle = pen.strokeStyle = colour;
  const disc = () => { pen.beginPath(); pen.arc(0, 0, r, 0, 7); pen.fill(); pen.strokeStyle = pen.fillStyle = ink.panel; };
  const path = (...points) => { pen.beginPath(); points.forEach(([a, b], i) => (i ? pen.lineTo(a * r, b * r) : pen.moveTo(a * r, b * r))); };
  if (shape === "tick") { disc(); path([-0.45, 0.02], [-0.1, 0.4], [0.48, -0.38]); pen.stroke(); }
  else if (shape === "cross") { disc(); path([-0.38, -0.38], [0.38, 0.38]); pen.stroke(); path([0.38, -0.38], [-0.38, 0.38]); pen.stroke(); }
  else if (shape === "stop") { disc(); path([-0.5, 0], [0.5, 0]); pen.stroke(); }
  else if (shape === "turn") { disc(); pen.beginPath(); pen.arc(0, 0, r * 0.48, -0.6, 4.2); pen.stroke(); path([0.05, -0.75], [0.62, -0.5], [0.2, -0.08]); pen.fill(); }
  else if (shape === "diamond") { path([0, -1], [1, 0], [0, 1], [-1, 0]); pen.fill(); }
  else if (shape === "bolt") { path([-0.9, -0.8], [0.9, -0.8], [0, 0.9]); pen.fill(); }
  else if (shape === "wedge") { path([-0.7, -0.85], [0.95, 0], [-0.7, 0.85]); pen.fill(); }
  else if (shape === "box") { pen.fillRect(-r * 0.7, -r * 0.7, r * 1.4, r * 1.4); }
  else if (shape === "flag") { path([-0.5, 1], [-0.5, -0.9], [0.9, -0.4], [-0.5, 0.1]); pen.stroke(); pen.fill(); }
  else if (shape === "ring") { pen.beginPath(); pen.arc(0, 0, r * 0.55, 0, 7); pen.stroke(); }
  else if (shape === "bar") { pen.fillRect(-1, -r * 2, 2, r * 4); }
  else { pen.beginPath(); pen.arc(0, 0, r * 0.62, 0, 7); pen.fill(); }
  pen.restore();
}
