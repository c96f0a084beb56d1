// The state of everything that the page wants to see, its history, and its storage over a reload: the address's fragment.
import { clamp, finite } from "./dom.js";

export const choices = {
  layout: ["one", "pair", "crossed"],
  compare: ["none", "beside", "wipe", "difference"],
  size: ["fit", "1280x720", "1920x1080", "3840x2160"],
  surface: ["sphere", "plane"],
};
const kinds = ["start", "model", "panel_image", "pattern"];

export const fresh = () => ({
  started: "",  // the description that the program was started with: with another one the state is not used
  display: "", set: {}, shown: { kind: "start", name: "", hold: false }, eye: [0, 0, 2000], eye_distance_mm: 65,
  layout: "one", compare: "none", size: "fit", surface: "sphere", wipe: 0.5,
});

const text = (x, most) => typeof x === "string" && x.length <= most;

/// A state from an address, which anybody may have written; null if it is not valid.
function checked(x) {
  const s = fresh();
  if (!x || typeof x !== "object") return null;
  if (!text(x.started, 1000) || !text(x.display, 1000) || !x.shown || !kinds.includes(x.shown.kind) || !text(x.shown.name, 1000)) return null;
  if (!Array.isArray(x.eye) || x.eye.length !== 3 || !finite(...x.eye, x.eye_distance_mm, x.wipe)) return null;
  const set = x.set && typeof x.set === "object" ? Object.entries(x.set) : [];
  if (set.length > 100 || !set.every(([key, value]) => text(key, 200) && text(value, 1000))) return null;
  for (const [name, allowed] of Object.entries(choices)) {
    if (!allowed.includes(x[name])) return null;
    s[name] = x[name];
  }
  return {
    ...s, started: x.started, display: x.display, set: Object.fromEntries(set), eye: x.eye, wipe: clamp(x.wipe, 0, 1),
    eye_distance_mm: clamp(x.eye_distance_mm, 0, 1000), shown: { kind: x.shown.kind, name: x.shown.name, hold: x.shown.hold === true },
  };
}

function kept() {
  try {
    return checked(JSON.parse(decodeURIComponent(location.hash.slice(1))));
  } catch {
    return null;
  }
}

/// `changed(moving, time)` is called after each change; time is that of the event that caused it.
export class Store {
  constructor(changed) {
    this.changed = changed;
    this.now = kept() || fresh();
    this.past = [];
    this.future = [];
    this.known = this.now;  // as of the last step
    this.sent = new Map();  // id: what was wanted
    this.good = { id: 0, wanted: null };  // the newest that the program has reported as valid
    this.bad_id = 0;  // the newest that it has reported as not valid
    this.last_key = null;
  }
  change(parts, moving = false, time = performance.now()) {
    this.last_key = null;
    this.now = { ...this.now, set: this.possible(), ...parts };
    this.changed(moving, time);
  }
  /// Parameters by key; null: as described.
  set_all(values, moving = false, time = performance.now()) {
    const key = Object.keys(values)[0], set = { ...(key === this.last_key ? this.now.set : this.possible()) };
    for (const [name, value] of Object.entries(values))
      if (value === null) delete set[name];
      else set[name] = value;
    this.change({ set }, moving, time);
    this.last_key = key;
  }
  set(key, value, moving = false, time = performance.now()) {
    this.set_all({ [key]: value }, moving, time);
  }
  /// An invalid value stays until something else is changed, then returns to its last valid one: else nothing would be shown.
  possible() {
    const { wanted } = this.good;
    return this.bad_id > this.good.id && wanted?.display === this.now.display ? wanted.set : this.now.set;
  }
  said(id) {
    this.sent.set(id, this.now);
    this.sent.delete(id - 100);
  }
  right(id) {
    if (id > this.good.id && this.sent.has(id)) this.good = { id, wanted: this.sent.get(id) };
  }
  wrong(id) {
    this.bad_id = Math.max(this.bad_id, id);
  }
  /// Ends a step for undo, if anything differs.
  step() {
    if (JSON.stringify(this.now) === JSON.stringify(this.known)) return;
    this.past = [...this.past.slice(-199), this.known];
    this.future = [];
    this.known = this.now;
  }
  keep() {
    // Relative, so that the token in the address stays.
    history.replaceState(null, "", "#" + encodeURIComponent(JSON.stringify(this.now)));
  }
  /// Takes the program's message about what it was started with.
  started(hello) {
    if (this.now.started === hello.display) return;
    this.now = this.known = { ...fresh(), started: hello.display, eye: hello.eye_mm };
    this.past = [];
    this.future = [];
  }
  undo() {
    this.step();
    if (this.past.length) this.go(this.past, this.future);
  }
  redo() {
    this.step();
    if (this.future.length) this.go(this.future, this.past);
  }
  go(from, to) {
    to.push(this.now);
    this.now = this.known = from.pop();
    this.changed(false, performance.now());
  }
}

/// The message "show", without its id and whether more is about to come.
export function wish(state, size) {
  const off = Object.keys(state.set).filter((key) => state.set[key] === "none");
  const set = Object.entries(state.set).filter(([key]) => !off.some((table) => key.startsWith(table + ".")));  // its table is removed
  return {
    type: "show", display: state.display, set: set.map(([key, value]) => `${key}=${value}`), shown: state.shown, eye_mm: state.eye, size,
    layout: state.layout, eye_distance_mm: state.eye_distance_mm,
    beside: { none: "none", beside: "photograph", wipe: "photograph", difference: "difference" }[state.compare],
  };
}
