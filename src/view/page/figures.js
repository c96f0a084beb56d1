// Results for the display: theory, lengths, warnings, the command; and problems.
import { byId, make, say, short } from "./dom.js";

const unit_text = { degrees: "°" };

function list(place, figures) {
  const all = JSON.stringify(figures);
  if (all === place.told) return;
  place.told = all;
  place.replaceChildren(...figures.flatMap((f) => {
    const unit = unit_text[f.unit] ?? (f.unit ? "\u202f" + f.unit : "");
    const one = (value) => (value === null ? "none" : typeof value === "number" ? short(value, 5) + unit : String(value));
    const value = [f.value].flat().map(one).join(f.interval ? " to " : " × ");
    return [make("dt", { textContent: f.label, title: `${f.name}: ${f.doc || ""}` }), make("dd", { textContent: value.replace(/^-/, "\u2212") })];
  }));
}

export function show_figures(resolved) {
  say(byId("display-name"), resolved.name || "");
  document.title = `${resolved.name || "display"} – lfdsim view`;
  list(byId("theory"), resolved.theory || []);
  list(byId("geometry"), resolved.geometry || []);
  const warnings = byId("warnings"), texts = (resolved.warnings || []).map(String);
  if (texts.join("\n") !== warnings.told) warnings.replaceChildren(...texts.map((textContent) => make("li", { textContent })));
  warnings.told = texts.join("\n");
  byId("command").value = resolved.command || "";
}

/// The problems, shown until something newer is valid.
export class Problems {
  constructor(mark) {
    Object.assign(this, { mark, id: 0, list: [], notes: [] });
  }
  told(message) {
    clearTimeout(this.timer);
    const same = new Map((message.id === this.id ? this.list : []).map((p) => [p.key + p.what, p]));
    for (const p of message.problems || []) same.set(p.key + p.what, { key: String(p.key ?? ""), what: String(p.what) });
    this.id = message.id;
    this.list = [...same.values()];
    this.show();
  }
  /// Clears the problems of an id; to be called for a frame or valid display with that id. It does so a moment later, so that a
  /// lasting problem stays on the page.
  right(id) {
    if (id <= this.id || !this.list.length) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.list = [];
      this.show();
    }, 150);
  }
  /// A message that is not about the display: shown for a while.
  note(text) {
    this.notes = [...this.notes.filter((t) => t !== text), text].slice(-3);
    this.show();
    setTimeout(() => {
      this.notes = this.notes.filter((t) => t !== text);
      this.show();
    }, 8000);
  }
  show() {
    this.mark(this.list);
    const texts = [...this.list.map((p) => (p.key ? `${p.key}: ${p.what}` : p.what)), ...this.notes], place = byId("problems");
    if (texts.join("\n") === place.told) return;
    place.told = texts.join("\n");
    place.replaceChildren(...texts.map((textContent) => make("p", { textContent })));
  }
}
