// Connects the parts: changes by the user are sent to the program, and its messages are shown.
import { byId, clamp, make, say, short } from "./dom.js";
import { angles, at_distance, distance, on_axis } from "./eye.js";
import { choices, Store, wish } from "./state.js";
import { Connection } from "./connection.js";
import { Pacing } from "./pacing.js";
import { Picture, lanes_of, quality_words, show_ssim, wiped } from "./picture.js";
import { watch_hands } from "./hands.js";
import { Controls } from "./controls.js";
import { Drawings } from "./drawings.js";
import { Problems, show_figures } from "./figures.js";
import { Files } from "./files.js";
import { Path } from "./path.js";

const stats = { latency_ms: [], final_ms: [], ssim: null, quality: null, last_ids: {}, sent: 0, hello: false, socket: "connecting" };
const times = [];         // of frames drawn within the last second
let most_pixels = 3840 * 2160, resolved = null, resolving = false, over = null, hands = null, wanted_size = null;

const store = new Store((moving, time) => {
  show_state();
  path.note();
  pacing.wish(moving, time);
});
const pacing = new Pacing(say_wish, at_rest);
const picture = new Picture(drawn);
const connection = new Connection({ state: connection_state, message, frame });
const ask = (what, more) => connection.ask(what, more);
const drawings = new Drawings(ask, () => JSON.stringify([store.now.display, store.now.set, store.now.shown, store.now.eye]));
const controls = new Controls(store, () => settled());
const problems = new Problems((list) => controls.mark(list));
const files = new Files(store, ask);
const path = new Path(store, () => settled());

function settled() {
  pacing.settle();
  store.step();
}

function say_wish(id, moving) {
  if (!stats.hello) return false;
  const size = picture.arrange(store.now, most_pixels);
  wanted_size = size;
  if (!connection.send({ ...wish(store.now, size), id, moving })) return false;
  store.said(id);
  ++stats.sent;
  return true;
}

function at_rest() {
  if (!hands.held() && path.replaying === null && !controls.held()) store.step();
  store.keep();
  drawings.refresh(false);
  probe();
  buttons();
}

function probe() {
  drawings.hush(store.now.layout !== "one");
  if (store.now.layout === "one" && stats.hello) {
    const at = over && picture.place(...over);
    drawings.probe(at || [0.5, 0.5], !!at);
  }
}

function connection_state(name, text) {
  stats.socket = name;
  if (name !== "open") stats.hello = false;
  const place = byId("connection");
  place.dataset.state = name;
  say(place, text);
}

function message(m) {
  if (m.type === "hello") {
    if (m.most_pixels > 0) most_pixels = m.most_pixels;
    stats.hello = true;
    store.started(m);
    files.greeted(m);
    show_state();
    pacing.again();
    files.look();  // a question, so not before the first "show"
  } else if (m.type === "resolved") {
    resolved = m;
    problems.right(m.id);
    store.right(m.id);
    if (!resolving) requestAnimationFrame(show_resolved);  // several may come within one
    resolving = true;
  } else if (m.type === "problems") {
    pacing.answer(m.id);
    problems.told(m);
    store.wrong(m.id);
  } else if (m.type === "progress") {
    show_progress(m);
  } else if (m.type === "error") {
    problems.note(String(m.what));
  }
}

function show_resolved() {
  resolving = false;
  controls.resolved(resolved.controls, store.now.set);
  controls.mark(problems.list);
  show_figures(resolved);
  describe();
}

function frame(header, blob) {
  if (header.lane === "file") return files.exr_came(blob);
  if (header.lane === lanes_of(store.now)[0]) pacing.answer(header.id);
  picture.frame(header, blob);
}

function drawn(header) {
  const now = performance.now();
  stats.last_ids[header.lane] = header.id;
  if (Number.isFinite(header.ssim)) stats.ssim = header.ssim;
  if (store.now.compare === "none") stats.ssim = null;
  show_ssim(stats.ssim, header.quality === "final");
  problems.right(header.id);
  store.right(header.id);
  byId("progress").hidden = true;
  if (header.lane !== lanes_of(store.now)[0]) return;
  stats.quality = header.quality;
  const known = pacing.drawn(header.id);
  if (known?.moving && !known.seen) stats.latency_ms = [...stats.latency_ms.slice(-499), now - known.event];
  if (known && header.quality === "final") stats.final_ms = [...stats.final_ms.slice(-99), now - known.at];
  if (known) known.seen = true;
  times.push(now);
  while (times[0] < now - 1000) times.shift();
  const lag = known ? `, ${Math.round(now - known.event)} ms after the input` : "";
  say(byId("frame-says"), `${header.width} x ${header.height} ${quality_words[header.quality] || ""}` +
    (header.quality === "coarse" ? `, ${times.length} a second${lag}` : `, ${Math.round(header.render_ms + header.encode_ms)} ms`));
  if (header.quality === "final" && header.id === pacing.id) drawings.refresh(true);
}

function show_progress(m) {
  const place = byId("progress");
  place.hidden = !(m.share < 1) || m.id < pacing.id;
  place.firstElementChild.value = clamp(Number(m.share) || 0, 0, 1);
  say(place.lastElementChild, String(m.what));
}

function describe() {
  const { eye } = store.now, { across_deg, up_deg } = angles(eye), name = resolved?.name || "the display";
  const side = (deg, plus, minus) => `${Math.abs(deg).toFixed(1)}° ${deg < 0 ? minus : plus}`;
  const text = `${side(across_deg, "right", "left")}, ${side(up_deg, "up", "down")}, ${short(distance(eye), 5)} mm away`;
  say(byId("eye-says"), `Eye ${eye.map((x) => short(x, 6)).join(", ")} mm: ${text}`);
  picture.describe(`Simulated view of ${name} from ${text}`);
}

function show_state() {
  const s = store.now;
  for (const name of Object.keys(choices)) byId(name).value = s[name];
  byId("eye-distance").value = short(s.eye_distance_mm);
  byId("eye-distance-label").hidden = s.layout === "one";
  byId("wipe-label").hidden = !wiped(s);
  byId("wipe").value = s.wipe;
  for (const [k, input] of eye_inputs.entries()) if (document.activeElement !== input) input.value = short(k < 3 ? s.eye[k] : distance(s.eye), 7);
  if (files.hello) files.show();
  if (s.compare === "none") show_ssim(stats.ssim = null, false);
  describe();
  drawings.age();
}

function buttons() {
  byId("undo").disabled = !store.past.length;
  byId("redo").disabled = !store.future.length;
  byId("reset-all").disabled = !Object.keys(store.now.set).length;
}

// Input by the user
for (const name of Object.keys(choices)) byId(name).onchange = (event) => store.change({ [name]: event.target.value });
byId("eye-distance").onchange = (event) => {
  const mm = Number(event.target.value);
  store.change(event.target.value.trim() && mm >= 0 && mm <= 1000 ? { eye_distance_mm: mm } : {});
};
byId("wipe").oninput = (event) => {  // needs no new picture
  store.now = { ...store.now, wipe: Number(event.target.value) };
  picture.wipe(store.now.wipe);
};
byId("wipe").onchange = () => at_rest();
byId("home").onclick = () => store.change({ eye: on_axis(store.now.eye) });
const travel = (how) => () => {
  store[how]();
  if (resolved) controls.resolved(resolved.controls, store.now.set);
  buttons();
};
byId("undo").onclick = travel("undo");
byId("redo").onclick = travel("redo");
byId("reset-all").onclick = () => {
  store.change({ set: {} });
  if (resolved) controls.resolved(resolved.controls, {});
};
window.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.altKey) return;
  const typing = event.target.matches?.("input[type=text], input[type=search], textarea") && event.target.value !== event.target.shown;
  if (typing) return;  // the field has its own undo
  event.preventDefault();
  byId(event.shiftKey ? "redo" : "undo").click();
});

const eye_inputs = ["x, right, mm", "y, up, mm", "z, from the panel, mm", "distance, mm"].map((name, k) => {
  const input = make("input", { type: "text", inputMode: "decimal", autocomplete: "off" });
  input.onchange = () => {
    const mm = Number(input.value), { eye } = store.now;
    if (!input.value.trim() || !(Math.abs(mm) <= 1e6) || (k === 3 && mm <= 0)) return show_state();
    store.change({ eye: k < 3 ? eye.map((x, i) => (i === k ? mm : x)) : at_distance(eye, mm / (distance(eye) || 1)) });
  };
  byId("eye-inputs").append(make("label", { textContent: name + " " }, input));
  return input;
});

hands = watch_hands(byId("stage"), store, {
  released: (time) => {
    pacing.event = time;
    settled();
    buttons();
  },
  hover: (x, y) => {
    over = x === null ? null : [x, y];
    if (over && picture.place(x, y)) probe();
  },
});
new ResizeObserver(() => {
  if (stats.hello && String(picture.arrange(store.now, most_pixels)) !== String(wanted_size)) pacing.wish(true, performance.now());
}).observe(byId("stage"));

const dark = matchMedia("(prefers-color-scheme: dark)"), theme = byId("theme");
const colour = () => { document.documentElement.dataset.theme = theme.value || (dark.matches ? "dark" : "light"); };
try {
  theme.value = localStorage.getItem("lfdsim-theme") || "";
} catch {
  // storage is not available: use the system's setting
}
theme.onchange = () => {
  try {
    localStorage.setItem("lfdsim-theme", theme.value);
  } catch {
    // for this visit only, then
  }
  colour();
};
dark.onchange = colour;
colour();
show_state();
buttons();

/// Gives tests the state that is wanted, and what was shown.
window.lfdsim = {
  state: () => structuredClone(store.now),
  controls: () => Object.fromEntries((resolved?.controls ?? []).map((c) => [c.key, c.value])),
  stats: () => structuredClone({
    ...stats, last_ids: Object.fromEntries(lanes_of(store.now).map((lane) => [lane, stats.last_ids[lane] ?? 0])), frames: picture.counts, id: pacing.id, answered: pacing.answered, problems: problems.list, notes: problems.notes, connects: connection.connects,
    malformed: connection.malformed, theory: resolved?.theory ?? null, command: resolved?.command ?? null, poses: path.poses.length,
  }),
};
