// --- pointing and asking -------------------------------------------------------------------

function find(px, py) { // what is at a point: a task, and an event or a span of it
  const r = Math.floor((py + scroll.scrollTop - 4) / state.row), t = rows[r];
  if (t === undefined) return { px };
  const found = { px, task: t };
  if (px < GUTTER) return found;
  let best = 8;
  const near = (i) => { const far = Math.abs(xOf(i) - px); if (far < best) { best = far; found.event = i; } };
  const u = toUnit(px - 8), list = byMark[t];
  for (let k = lowest(list, (i) => X[i] >= u); k < list.length && xOf(list[k]) <= px + 8; k++) near(list[k]);
  if (R.tasks[t].ended < N) near(R.tasks[t].ended);
  if (found.event === undefined) {
    const x = toUnit(px), spans = bySpan[t], k = lowest(spans, (s) => X[s[3]] >= x);
    if (spans[k] && X[spans[k][2]] <= x) found.span = spans[k];
  }
  return found;
}
const line = (kind, text) => { const p = document.createElement("p"); p.className = kind; p.textContent = text; return p; };

function showTip(found, px, py) {
  const task = R.tasks[found.task];
  tip.hidden = found.task === undefined || px < GUTTER || (found.event === undefined && !found.span);
  if (tip.hidden) return;
  tip.replaceChildren();
  if (found.event !== undefined) {
    tip.append(line("when", `${seconds(R.times[found.event])} s`), line("", `${task.name} ${R.strings[R.text[found.event]]}`));
    if (R.place[found.event] >= 0) tip.append(line("place", R.strings[R.place[found.event]]));
  } else {
    const [, kind, a, b, cause] = found.span, long = R.times[b] - R.times[a];
    tip.append(line("when", `${seconds(R.times[a])} – ${seconds(R.times[b])} s  (${seconds(long)} s)`));
    tip.append(line("", `${task.name} ${cause >= 0 ? R.strings[R.text[cause]] : LEGEND[kind][2]}`));
    if (cause >= 0 && R.place[cause] >= 0) tip.append(line("place", R.strings[R.place[cause]]));
  }
  tip.style.left = Math.min(px + 14, width - tip.offsetWidth - 8) + "px";
  tip.style.top = Math.min(py + HEAD + 18, height + HEAD - tip.offsetHeight - 6) + "px";
}

function choose(found) {
  state.chosen = found && found.task !== undefined ? found : null;
  more.hidden = !state.chosen; more.replaceChildren();
  if (state.chosen) {
    const task = R.tasks[found.task], facts = document.createElement("dl"), list = document.createElement("ol"), close = document.createElement("button");
    close.className = "close"; close.textContent = "✕"; close.title = "close (Esc)"; close.onclick = () => choose(null);
    const title = document.createElement("h2"); title.textContent = task.name;
    const fact = (name, value) => { if (value !== null && value !== "" && value !== undefined) { const a = document.createElement("dt"), b = document.createElement("dd"); a.textContent = name; b.textContent = value; facts.append(a, b); } };
    fact("status", task.status); fact("failure", task.failure); fact("why", task.why); fact("at", task.place); fact("role", task.role);
    fact("parent", task.parent >= 0 ? R.tasks[task.parent].name : null);
    fact("from – to", `${seconds(R.times[task.started])} – ${seconds(R.times[Math.min(task.ended, N)])} s`);
    const events = byTask[found.task], at = found.event ?? (found.span ? found.span[4] : undefined);
    const middle = at === undefined ? 0 : Math.max(0, events.indexOf(at)), start = Math.max(0, middle - 250);
    events.slice(start, start + 500).forEach((i) => {
      const item = document.createElement("li"), button = document.createElement("button");
      button.append(line("when", seconds(R.times[i])), line("", R.strings[R.text[i]]));
      button.title = R.place[i] >= 0 ? R.strings[R.place[i]] : ""; button.onclick = () => choose({ task: found.task, event: i });
      if (i === at) button.setAttribute("aria-current", "true");
      item.append(button); list.append(item);
    });
    more.append(close, title, facts, list);
    list.querySelector("[aria-current]")?.scrollIntoView({ block: "center" });
    reveal(found);
  }
  listRows(); ask();
}

function reveal(found) { // let the chosen event be in sight
  const i = found.event;
  if (i !== undefined && (X[i] < state.from || X[i] > state.to)) { const half = (state.to - state.from) / 2; look(X[i] - half, X[i] + half); }
  const row = rowOf.get(found.task), y = row * state.row;
  if (row !== undefined && (y < scroll.scrollTop || y + state.row > scroll.scrollTop + scroll.clientHeight)) scroll.scrollTop = y - scroll.clientHeight / 2;
}
function look(from, to) {
  const wide = Math.min(1, Math.max(to - from, 4 / Math.max(N, 4) / 50));
  state.from = Math.min(Math.max(0, from), 1 - wide); state.to = state.from + wide; ask();
}
function zoom(factor, px = GUTTER + PAD + plot() / 2) {
  const u = toUnit(px); look(u - (u - state.from) * factor, u + (state.to - u) * factor);
}
function step(way) { // to the next event of the chosen task, or the first of all
  const task = state.chosen ? state.chosen.task : rows[0], events = byTask[task] || [], at = state.chosen?.event;
  const k = at === undefined ? (way > 0 ? 0 : events.length - 1) : events.indexOf(at) + way;
  if (events[k] !== undefined) choose({ task, event: events[k] });
}
function stepTask(way) {
  const row = (state.chosen ? rowOf.get(state.chosen.task) : -1) + way;
  if (rows[row] !== undefined) choose({ task: rows[row] });
}

let drag = null;
lanes.addEventListener("pointerdown", (e) => { drag = { x: e.offsetX, from: state.from, to: state.to, moved: false }; });
lanes.addEventListener("pointermove", (e) => {
  if (drag && e.buttons && drag.x > GUTTER && Math.abs(e.offsetX - drag.x) > 3) {
    drag.moved = true; lanes.setPointerCapture(e.pointerId); tip.hidden = true;
    const by = (drag.x - e.offsetX) / plot() * (drag.to - drag.from); look(drag.from + by, drag.to + by); return;
  }
  state.hover = find(e.offsetX, e.offsetY); showTip(state.hover, e.offsetX, e.offsetY); ask();
});
lanes.addEventListener("pointerup", (e) => {
  if (drag && !drag.moved) {
    const found = find(e.offsetX, e.offsetY), task = R.tasks[found.task];
    if (task && task.children && e.offsetX > GUTTER - 34 && e.offsetX < GUTTER) {
      if (!state.shut.delete(found.task)) state.shut.add(found.task);
      listRows(); ask();
    } else choose(found);
  }
  drag = null;
});
lanes.addEventListener("pointerleave", () => { state.hover = null; tip.hidden = true; ask(); });
scroll.addEventListener("wheel", (e) => {
  if (e.ctrlKey || e.metaKey) { e.preventDefault(); zoom(Math.exp(e.deltaY * 0.004), e.offsetX); }
  else if (e.shiftKey || Math.abs(e.deltaX) > Math.abs(e.deltaY)) { e.preventDefault(); const by = (e.deltaX || e.deltaY) / plot() * (state.to - state.from); look(state.from + by, state.to + by); }
}, { passive: false });
lanes.addEventListener("dblclick", (e) => zoom(0.4, e.offsetX));
scroll.addEventListener("scroll", ask);
addEventListener("keydown", (e) => {
  if (e.target.tagName === "INPUT" || e.ctrlKey || e.metaKey || e.altKey) return;
  const act = { "+": () => zoom(0.6), "=": () => zoom(0.6), "-": () => zoom(1.6), "0": () => look(0, 1), Escape: () => choose(null),
    ArrowRight: () => step(1), ArrowLeft: () => step(-1), ArrowDown: () => stepTask(1), ArrowUp: () => stepTask(-1) }[e.key];
  if (act) { e.preventDefault(); act(); }
});
$("in").onclick = () => zoom(0.6); $("out").onclick = () => zoom(1.6); $("fit").onclick = () => look(0, 1);
$("find").oninput = (e) => { state.find = e.target.value; listRows(); ask(); };

// --- what stands around -----------------------------------------------------------------------

function drawLegend() {
  const used = { span: new Set(R.spans.map((s) => STATES[s[1]])), arrow: new Set(R.arrows.map((a) => ARROWS[a[0]])), mark: new Set(R.kinds), end: new Set(R.tasks.map((t) => t.status)) };
  $("legend").replaceChildren(...LEGEND.filter(([sort, name]) => used[sort].has(name)).map(([sort, name, words]) => {
    const item = document.createElement(sort === "arrow" ? "label" : "span"), canvas = document.createElement("canvas");
    if (sort === "arrow") {
      const box = document.createElement("input"); box.type = "checkbox"; box.checked = !state.off.has(name); item.title = "show or hide";
      item.className = box.checked ? "" : "off";
      box.onchange = () => { if (box.checked) state.off.delete(name); else state.off.add(name); item.className = box.checked ? "" : "off"; ask(); };
      item.append(box);
    }
    item.append(canvas, words);
    const pen = size(canvas, 30, 16);
    if (sort === "span") { pen.fillStyle = ink[name]; pen.strokeStyle = ink[name + "-edge"] || ink[name]; pen.beginPath(); pen.roundRect(2.5, 3.5, 25, 9, 3); pen.fill(); pen.stroke(); }
    else if (sort === "mark") glyph(pen, MARKS[name][1], 15, 8, 5.5, ink[MARKS[name][0]]);
    else if (sort === "end") glyph(pen, ENDS[name][1], 15, 8, 6, ink[ENDS[name][0]]);
    else {
      pen.strokeStyle = pen.fillStyle = ink[name === "failure" ? "bad" : name]; pen.lineWidth = 1.5;
      pen.setLineDash(name === "abort" ? [4, 3] : name === "join" ? [2, 3] : []);
      pen.beginPath(); pen.moveTo(2, 8); pen.lineTo(22, 8); pen.stroke(); pen.beginPath(); pen.moveTo(28, 8); pen.lineTo(21, 4.5); pen.lineTo(21, 11.5); pen.fill();
    }
    return item;
  }));
}
function setScale(name) {
  const a = state.from, b = state.to, i = lowest(X || [0], (x) => x >= a), j = lowest(X || [0], (x) => x >= b);
  state.scale = name; layOut();
  document.querySelectorAll("[data-scale]").forEach((b) => b.setAttribute("aria-checked", String(b.dataset.scale === name)));
  if (a > 0 || b < 1) look(X[Math.min(i, N)], X[Math.min(j, N)]);
  ask();
}
function setTheme(name) { document.documentElement.dataset.theme = name; readInk(); drawLegend(); ask(); }
document.querySelectorAll("[data-scale]").forEach((b) => { b.setAttribute("role", "radio"); b.onclick = () => setScale(b.dataset.scale); });
$("theme").onclick = () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
const dark = matchMedia("(prefers-color-scheme: dark)");
dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
if (R.arrows.length > 400) ["start", "join"].forEach((name) => state.off.add(name));
layOut(); setTheme(dark.matches ? "dark" : "light"); setScale("balanced"); listRows(); draw();
new ResizeObserver(() => { listRows(); draw(); }).observe(scroll);
document.documentElement.dataset.ready = "yes";
