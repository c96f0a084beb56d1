// The display's parameters: a row each with slider, field, unit, and its errors.
import { byId, clamp, make, say, short } from "./dom.js";

// The parameters changed most often; the rest is folded, by table.
const main = [
  /^array\.gap_mm$/, /^array\.pitch_mm$/, /^lens\.(sphere_radius_mm|focal_length_mm|index|aperture_radius_mm)$/,
  /^lens\.surface\.\d+\.(curvature_per_mm|index|semi_aperture_mm)$/, /^array\.aperture$/, /^diffuser(\.(angle_deg|distance_mm))?$/,
  /^content\.depth_mm$/, /^array\.(offset_mm|rotation_deg)$/,
];
const is_main = (key) => main.some((pattern) => pattern.test(key));
const table_names = { panel: "Panel", lens: "Lens", array: "Lens array", diffuser: "Diffuser", camera: "Camera", content: "Model", render: "Rendering", errors: "Assembly errors" };
const table_name = (table) =>
  table_names[table] || table.replace(/^lens\.surface\.(\d+)$/, (_, k) => `Lens surface ${Number(k) + 1}`) || "General";

// Prefix of the label of a row that is shown outside its table.
const prefix = (table) => ({ lens: "lens ", diffuser: "diffuser ", content: "model " })[table] || table.replace(/^lens\.surface\.(\d+)$|.*/, (_, k) => k ? `surface ${Number(k) + 1} ` : "");

const value_text = (value) => (value === null ? "" : typeof value === "number" ? short(value, 8) : String(value));
/// A value in the form of --set. Infinity is "infinite" in messages and inf in TOML.
const toml = (text) => (/^\s*infinite\s*$/i.test(text) ? "inf" : text.trim());

class Control {
  /// `follower(key)`: the control of another key.
  constructor(data, store, settle, follower) {
    Object.assign(this, { key: data.key, store, settle, follower, data, held: false });
    const id = "c-" + data.key.replaceAll(".", "-");
    this.error = make("div", { className: "error", id: id + "-error", hidden: true });
    this.note = make("div", { className: "note", hidden: true });
    this.before = {};  // values of the parameters that it limits, from the start of the drag
    this.back = make("button", { className: "back", textContent: "↺", title: "As described", "aria-label": `${data.label}: as described` });
    this.back.onclick = () => {
      const limited = Object.keys(this.data.limits || {}).filter((key) => this.follower(key)?.note.textContent);
      this.store.set_all({ [this.key]: null, ...Object.fromEntries(limited.map((key) => [key, null])) });
      for (const key of limited) this.follower(key).tell("");
    };
    this.fields = make("span", { className: "fields" });
    const many = data.form === "pair" ? 2 : 1;
    this.inputs = Array.from({ length: many }, (_, k) => this.field(k, many));
    this.fields.append(...this.inputs);
    this.inputs[0].id = id;
    if (data.key === "errors.seed") this.fields.prepend(this.draw_again());
    this.row = make("div", { className: "control" },
      make("label", { textContent: (is_main(data.key) && data.key !== data.table ? prefix(data.table) : "") + data.label, title: `${data.key}: ${data.doc || ""}`, "for": id }), this.fields,
      make("span", { className: "unit", textContent: data.unit === "degrees" ? "°" : data.unit || "" }), this.back);
    this.sliders = ["word", "list"].includes(data.form) ? [] : this.inputs.map((_, k) => this.slider(k, many));
    if (this.sliders.length) this.row.append(make("span", { className: "sliders" }, ...this.sliders));
    this.row.append(this.error, this.note);
    this.words = `${data.key} ${data.label} ${table_name(data.table)} ${data.doc || ""}`.toLowerCase();
  }
  named(k, many) {
    const side = many === 2 ? [", horizontal", ", vertical"][k] : "";
    return `${table_name(this.data.table)}: ${this.data.label}${side}${this.data.unit ? ", " + this.data.unit : ""}`;
  }
  field(k, many) {
    const { data } = this;
    if (data.form === "word") {
      const input = make("select", { "aria-label": this.named(k, many) }, ...data.words.map((word) => make("option", { textContent: word })));
      if (data.value === null) input.prepend(make("option", { value: "", textContent: "none" }));
      input.onchange = () => this.store.set(this.key, input.value || null);
      return input;
    }
    const input = make("input", { type: "text", inputMode: "decimal", autocomplete: "off", "aria-label": this.named(k, many), spellcheck: false });
    input.shown = "";
    input.onchange = () => {
      this.typed();
      this.before = {};
    };
    input.onblur = () => { this.before = {}; };
    input.onkeydown = (event) => {
      const steps = { ArrowUp: 1, ArrowDown: -1 }[event.key], step = this.at("step", k);
      if (!steps || !Number.isFinite(Number(input.value)) || !(step > 0)) return;
      event.preventDefault();
      input.value = short(Number(input.value) + steps * step * (event.shiftKey ? 10 : 1), 10);
      this.typed(true, event.timeStamp);
    };
    return input;
  }
  slider(k, many) {
    const input = make("input", { type: "range", "aria-label": this.named(k, many) + " (slider)" });
    input.oninput = (event) => {
      this.held = true;
      this.inputs[k].value = short(input.value, 8);
      this.typed(true, event.timeStamp);
    };
    input.onchange = () => {
      this.held = false;
      this.before = {};
      this.settle();
    };
    return input;
  }
  /// Another array of the same kind: the next seed.
  draw_again() {
    const again = make("button", { id: "draw-again", textContent: "draw again", title: "The errors of another array with the same standard deviations" });
    again.onclick = () => this.store.set(this.key, String((BigInt(this.data.value) + 1n) % 2n ** 63n));
    return again;
  }
  at(name, k) {
    const x = this.data[name];
    return Array.isArray(x) ? x[k] : x;
  }
  typed(moving = false, time = performance.now()) {
    for (const input of this.inputs) input.shown = input.value;
    const texts = this.inputs.map((input) => toml(input.value));
    if (this.data.form === "list") return this.store.set(this.key, `[${texts[0]}]`, moving, time);
    if (texts.every((text) => text === ""))  // back to the description's value, or none where that is possible
      return this.store.set(this.key, this.data.absent && !(this.key in this.store.now.set) ? "none" : null, moving, time);
    texts.forEach((text, k) => {
      if (text === "") texts[k] = this.at("suggested", k) ?? texts.find((other) => other !== "");
    });
    this.store.set_all({ [this.key]: this.text_of(texts), ...this.lowered(Number(texts[0])) }, moving, time);
    this.tell("");
  }
  /// Parameters that it limits go down with it, and during the same drag up again to their old values.
  lowered(value) {
    const set = {};
    for (const [key, share] of Object.entries(this.data.limits || {})) {
      const other = this.follower(key), most = share * value;
      if (!other || !(most > 0)) continue;
      const was = this.before[key] ??= { said: this.store.now.set[key] ?? null, value: Number(other.data.value) };
      const follows = was.value > most;
      set[key] = follows ? String(most) : was.said;
      other.tell(follows ? `follows the ${this.data.label}` : "");
    }
    return set;
  }
  tell(note) {
    this.note.hidden = !note;
    say(this.note, note);
  }
  text_of(values) {
    return this.data.form === "pair" ? `[${values.join(", ")}]` : String(values[0]);
  }
  /// Shows the program's data; a slider that is being dragged keeps its ends.
  update(data, set) {
    this.data = data;
    const said = set[this.key];
    this.row.classList.toggle("changed", said !== undefined);
    if (said === undefined) this.tell("");
    // A value set by the user is shown as typed, valid or not.
    const inside = said?.replace(/^\[|\]$/g, ""), typed = data.form === "pair" ? inside?.split(/\s*,\s*/) : [inside];
    const is = data.form === "list" ? [data.value?.map((x) => short(x, 8)).join(", ") ?? ""] : [data.value].flat().map(value_text);
    const values = this.inputs.map((_, k) => (said === "none" && data.form !== "word" ? "" : typed?.[k] ?? is[k] ?? ""));
    this.inputs.forEach((input, k) => {
      const edited = document.activeElement === input && input.value !== input.shown;
      if (!this.held && !edited) input.value = input.shown = values[k];
      if (data.form !== "word") Object.assign(input, { placeholder: "none", title: data.absent ? `without it: ${data.absent}` : "" });
    });
    if (!this.held)
      this.sliders.forEach((slider, k) => this.place_slider(slider, k, Number(values[k] === "" ? this.at("suggested", k) ?? NaN : values[k])));
  }
  place_slider(slider, k, value) {
    const low = this.at("low", k), high = this.at("high", k), step = this.at("step", k);
    slider.disabled = !(Number.isFinite(low) && Number.isFinite(high) && high > low);
    if (slider.disabled) return;
    // "any": values need not be multiples of the step. Arrow keys in the field use the step.
    const whole = Number.isInteger(low) && Number.isInteger(high) && Number.isInteger(step) && step > 0;
    Object.assign(slider, { min: low, max: high, step: whole ? 1 : "any" });
    if (Number.isFinite(value)) slider.value = clamp(value, low, high);
  }
  mark(problem) {
    this.row.classList.toggle("invalid", !!problem);
    this.error.hidden = !problem;
    say(this.error, problem || "");
    for (const input of this.inputs) {
      input.setAttribute("aria-invalid", String(!!problem));
      if (problem) input.setAttribute("aria-describedby", this.error.id);
      else input.removeAttribute("aria-describedby");
    }
  }
}

export class Controls {
  constructor(store, settle) {
    Object.assign(this, { store, settle, all: new Map(), shape: "" });
    this.place = byId("controls");
    byId("filter").oninput = () => this.filter();
  }
  /// Whether a slider is being dragged.
  held() {
    return [...this.all.values()].some((c) => c.held);
  }
  /// `controls` of the message "resolved".
  resolved(controls, set) {
    const all = JSON.stringify([controls, set]);
    if (all === this.shown) return;  // only the eye has moved
    this.shown = all;
    this.told = controls;
    controls = this.with_switch(controls);
    const shape = JSON.stringify(controls.map((c) => [c.key, c.form, c.words, c.form === "word" && c.value === null]));
    if (shape !== this.shape) this.rebuild(controls, shape);
    for (const data of controls) this.all.get(data.key).update(data, set);
  }
  /// The diffuser as a whole can be removed or added.
  with_switch(controls) {
    const own = controls.filter((c) => c.table === "diffuser");
    if (!own.length) return controls;
    const away = own.every((c) => c.value === null), all = controls.filter((c) => c.table !== "diffuser");
    all.push({ key: "diffuser", table: "diffuser", label: "diffuser", form: "word", words: ["there", "none"], value: away ? "none" : "there", doc: "With or without a diffuser." });
    return away ? all : [...all, ...own];
  }
  switch_diffuser(away, controls) {
    const { diffuser, ...set } = this.store.now.set;  // its keys stay, for when it comes back
    if (away) set.diffuser = "none";
    else if (diffuser === undefined)  // the description has none: use the one that the program suggests
      for (const c of controls) if (c.table === "diffuser" && c.form !== "word" && c.suggested != null) set[c.key] = JSON.stringify(c.suggested);
    this.store.change({ set });
  }
  rebuild(controls, shape) {
    this.shape = shape;
    const focused = document.activeElement?.id, open = new Set([...this.place.querySelectorAll("details[open]")].map((d) => d.dataset.table));
    this.all = new Map(controls.map((data) => [data.key, new Control(data, this.store, this.settle, (key) => this.all.get(key))]));
    const diffuser = this.all.get("diffuser");
    if (diffuser) diffuser.inputs[0].onchange = (event) => this.switch_diffuser(event.target.value === "none", this.told);
    const first = make("div", {}), tables = new Map();
    const rank = (c) => main.findIndex((pattern) => pattern.test(c.key));
    for (const c of [...this.all.values()].sort((a, b) => rank(a) - rank(b))) {
      if (rank(c) >= 0) {
        first.append(c.row);
        continue;
      }
      if (!tables.has(c.data.table)) tables.set(c.data.table, []);
      tables.get(c.data.table).push(c.row);
    }
    this.place.replaceChildren(first, ...[...tables].map(([table, rows]) => make("details", { "data-table": table, open: open.has(table) },
      make("summary", { textContent: table_name(table) }), ...rows)));
    if (focused) byId(focused)?.focus();
    this.filter();
  }
  filter() {
    const words = byId("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const c of this.all.values()) c.row.hidden = !words.every((word) => c.words.includes(word));
    for (const table of this.place.querySelectorAll("details")) {
      table.hidden = !table.querySelector(".control:not([hidden])");
      if (words.length && !table.hidden) table.open = true;
    }
  }
  /// Marks problems at their rows; those of keys without a row are left to the caller.
  mark(problems) {
    if (problems.length) this.shown = null;  // so that the next message updates the fields
    for (const c of this.all.values()) c.mark(problems.filter((p) => p.key === c.key).map((p) => p.what).join(" "));
  }
}
