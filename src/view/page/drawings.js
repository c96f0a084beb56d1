// The program's drawings and plots, and on the side view the rays through the point under the pointer.
import { byId, clamp, say } from "./dom.js";

const questions = {
  display: { what: "side", name: "display" }, lens: { what: "side", name: "lens" },
  fov: { what: "plot", name: "fov" }, spot: { what: "plot", name: "spot" },
};
const probe_pause_ms = 50;
const point_at_it = "Point at the picture to read which lens is there and which panel pixel it shows.";
const svg_space = "http://www.w3.org/2000/svg";

const least_text = 11;  // pixels on the screen
const phone_px = 480;   // in less room plots are drawn narrower

/// A drawing for the page, without anything that could run or fetch something; null if the text is not a drawing.
export function clean_svg(text) {
  const parsed = new DOMParser().parseFromString(String(text).replace(/\sstyle="[^"]*"/g, ""), "image/svg+xml");
  const root = parsed.documentElement;
  if (root.namespaceURI !== svg_space || root.localName !== "svg" || parsed.querySelector("parsererror")) return null;
  const kept = new Set(["svg", "g", "path", "line", "polyline", "polygon", "rect", "circle", "ellipse", "text", "tspan", "title", "desc", "defs", "clipPath"]);
  for (const element of [...root.querySelectorAll("*")]) if (!kept.has(element.localName) || element.namespaceURI !== svg_space) element.remove();
  for (const element of [root, ...root.querySelectorAll("*")])
    for (const { name, value } of [...element.attributes])
      if (/^on|href|^style$/i.test(name) || /url\((?!\s*["']?#)/i.test(value)) element.removeAttribute(name);
  return document.adoptNode(root);
}

export class Drawings {
  /// ask(what, more): that of the connection; optical(): a text of everything that a drawing depends on.
  constructor(ask, optical) {
    Object.assign(this, { ask, optical, open: null, drawn: "", frame: null, fan: [], probing: false, probed: -Infinity });
    this.place = byId("drawing");
    this.buttons = [...document.querySelectorAll("[data-drawing]")];
    new ResizeObserver(() => this.fit()).observe(this.place);
    for (const button of this.buttons) button.onclick = () => this.choose(this.open === button.dataset.drawing ? null : button.dataset.drawing);
  }
  choose(name) {
    this.open = name;
    this.drawn = "";
    this.frame = null;
    for (const button of this.buttons) button.setAttribute("aria-pressed", String(button.dataset.drawing === name));
    this.place.hidden = !name;
    this.place.replaceChildren();
    say(byId("drawing-says"), "");
    this.refresh();
  }
  /// Marks a drawing that is of an older state.
  age() {
    this.place.classList.toggle("old", this.drawn !== "" && this.drawn !== this.optical());
  }
  /// Refreshes the drawing; to be called at rest; with `sharp` when the sharp picture has come, since plots take long.
  async refresh(sharp = true) {
    this.age();
    const name = this.open, of = this.optical(), question = questions[name];
    if (!name || this.drawn === of || this.asking === name + of || (question.what === "plot" && !sharp)) return;
    this.asking = name + of;
    if (question.what === "plot") say(byId("drawing-says"), "measuring ...");
    try {
      const room = this.place.clientWidth, width = question.what === "plot" && room < phone_px ? { width: clamp(room, 300, phone_px) } : {};
      const answer = await this.ask(question.what, { name: question.name, ...width });
      if (this.open === name && this.asking === name + of) this.show(answer, of);
    } catch (error) {
      if (this.open === name) say(byId("drawing-says"), error.message);
    }
    if (this.asking === name + of) this.asking = null;
  }
  show(answer, of) {
    const problems = (answer.problems || []).map((p) => p.what).join("; "), svg = answer.svg ? clean_svg(answer.svg) : null;
    say(byId("drawing-says"), problems || (svg ? "" : "there is no drawing"));
    if (!svg) return;
    this.place.replaceChildren(svg);
    this.fit();
    this.frame = answer.frame || null;
    this.drawn = of;
    this.age();
    this.draw_fan();
  }
  /// Fits the drawing to its room, but not to text too small to read: then it can be scrolled.
  fit() {
    const svg = this.place.querySelector("svg"), [, , width, height] = (svg?.getAttribute("viewBox") ?? "").split(" ").map(Number);
    if (!(width > 0 && height > 0)) return;
    const smallest = Math.min(...[svg, ...svg.querySelectorAll("[font-size]")].map((e) => Number(e.getAttribute("font-size")) || Infinity));
    const most = parseFloat(getComputedStyle(this.place).maxHeight) || Infinity;
    const scale = Math.max(least_text / smallest, Math.min(this.place.clientWidth / width, most / height, 1.25));
    svg.setAttribute("width", (scale * width).toFixed(1));
    svg.setAttribute("height", (scale * height).toFixed(1));
  }
  /// Asks what a point shows; only for the newest point, at most 20 times a second.
  /// `pointed`: the user points at it.
  async probe(at, pointed) {
    this.wanted = at;
    this.pointed = pointed;
    if (this.probing || !at) return;
    this.probing = true;
    while (this.wanted) {
      const pause = this.probed + probe_pause_ms - performance.now();
      if (pause > 0) await new Promise((done) => setTimeout(done, pause));
      const place = this.wanted;
      this.wanted = null;
      this.probed = performance.now();
      if (!place) break;
      try {
        const answer = await this.ask("probe", { at: place });
        if (this.silent) continue;
        this.fan = Array.isArray(answer.fan) ? answer.fan : [];
        say(byId("probe-says"), (this.pointed && answer.says) || point_at_it);
        this.draw_fan();
      } catch {
        // The connection is lost, which is shown elsewhere. A newer point may wait.
      }
    }
    this.probing = false;
  }
  /// Silences the probe: with two eyes a point is not a single line of sight.
  hush(silent) {
    this.silent = silent;
    if (!silent) return;
    this.fan = [];
    say(byId("probe-says"), "");
    this.draw_fan();
  }
  draw_fan() {
    const svg = this.place.querySelector("svg"), f = this.frame;
    svg?.querySelectorAll(".fan").forEach((line) => line.remove());
    if (!svg || !f) return;
    const [left, top, width, height] = f.box;
    // From the eye, which the drawing of lenses does not reach.
    const begun = (line) => line.map(([y, z], k) => {
      const [next_y, next_z] = line[k + 1] ?? [y, z];
      return z <= f.z_high ? [y, z] : [next_z < f.z_high ? y + ((next_y - y) * (z - f.z_high)) / (z - next_z) : y, f.z_high];
    });
    for (const line of this.fan.map(begun)) {
      const drawn = document.createElementNS(svg_space, "polyline");
      drawn.setAttribute("class", "fan");
      drawn.setAttribute("points", line.map(([y, z]) =>
        [left + (width * (z - f.z_low)) / (f.z_high - f.z_low), top + (height * (f.y_high - y)) / (f.y_high - f.y_low)].map((x) => x.toFixed(2)).join()).join(" "));
      svg.append(drawn);
    }
  }
}
