// The pictures of the view: one canvas for each lane, updated as frames come.
import { byId, make, say } from "./dom.js";

const rank = { coarse: 0, fine: 1, final: 2 };
const lane_names = { left: "left eye", right: "right eye", photograph: "photograph", difference: "difference" };

/// The lanes that are shown, from left to right.
export function lanes_of(state) {
  const eyes = { one: ["one"], pair: ["left", "right"], crossed: ["right", "left"] }[state.layout];
  return [...eyes, ...({ none: [], beside: ["photograph"], wipe: ["photograph"], difference: ["difference"] }[state.compare])];
}

/// Whether the wipe is in use: with one eye it lays the photograph over the picture; with two the photograph is beside them.
export const wiped = (state) => state.compare === "wipe" && state.layout === "one";

export class Picture {
  /// drawn(header) is called when a frame is on its canvas.
  constructor(drawn) {
    this.drawn = drawn;
    this.stage = byId("stage");
    this.tiles = new Map();  // by lane
    this.counts = { coarse: 0, fine: 0, final: 0, dropped: 0, malformed: 0 };
  }
  /// Sets the tiles' sizes for the state; returns the size of one picture in pixels.
  arrange(state, most_pixels) {
    const names = lanes_of(state), over = wiped(state), ratio = window.devicePixelRatio || 1;
    if (names.join() !== this.names || over !== this.over) this.rebuild(names, over);
    const fit = state.size === "fit", count = over ? 1 : names.length;
    this.stage.toggleAttribute("data-compare", state.compare !== "none" && !over);
    this.stage.toggleAttribute("data-fixed", !fit);
    this.stage.dataset.tiles = count;
    const { column, size } = fit ? this.fitting(count, state.layout === "one", ratio, most_pixels)
                                 : { column: false, size: state.size.split("x").map(Number) };
    this.stage.toggleAttribute("data-column", column);
    for (const tile of this.tiles.values()) {
      tile.canvas.style.width = `${size[0] / ratio}px`;  // one pixel of the picture for each of the screen
      tile.canvas.style.height = `${size[1] / ratio}px`;
    }
    this.wipe(state.wipe);
    return size;
  }
  /// A size of 16:9, the largest of which `count` fit in a row, or in a column where that is allowed.
  fitting(count, may_stack, ratio, most_pixels) {
    const inside = (columns, rows) => {
      const w = ((this.stage.clientWidth - 4 * (columns - 1)) * ratio) / columns, h = ((this.stage.clientHeight - 4 * (rows - 1)) * ratio) / rows;
      return Math.min(w, (h * 16) / 9);
    };
    const row = inside(count, 1), stack = may_stack ? inside(1, count) : 0;
    const width = Math.min(Math.max(row, stack), Math.sqrt((most_pixels * 16) / 9), 4096);
    const even = (x) => Math.max(16, 2 * Math.floor(x / 2));
    return { column: stack > row, size: [even(width), even((width * 9) / 16)] };
  }
  rebuild(names, over) {
    this.names = names.join();
    this.over = over;
    const old = this.tiles;
    this.tiles = new Map();
    let first = null;
    const shown = names.map((lane) => {
      const tile = old.get(lane) || { lane, canvas: make("canvas", { width: 16, height: 9, "data-lane": lane }), id: 0, rank: -1 };
      this.tiles.set(lane, tile);
      const name = make("span", { textContent: lane_names[lane] || "" , hidden: names.length === 1 });
      if (over && first) {
        tile.canvas.classList.add("wiped");
        name.classList.add("right");
        first.append(tile.canvas, name);
        return null;
      }
      tile.canvas.classList.remove("wiped");
      tile.canvas.style.clipPath = "";
      if (lane === "one") name.textContent = "view";
      return first = make("div", { className: "tile" }, tile.canvas, name);
    });
    this.stage.replaceChildren(...shown.filter(Boolean));
  }
  wipe(share) {
    if (this.over) this.tiles.get("photograph").canvas.style.clipPath = `inset(0 0 0 ${100 * share}%)`;
  }
  /// Draws a frame unless a newer or a better one has been drawn; while one is decoded only the newest waits.
  async frame(header, blob) {
    const tile = this.tiles.get(header.lane);
    if (!tile) return;
    if (tile.decoding) {
      if (tile.waiting) ++this.counts.dropped;
      tile.waiting = [header, blob];
      return;
    }
    tile.decoding = true;
    try {
      const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" });
      this.draw(tile, header, bitmap);
      bitmap.close();
    } catch (error) {
      ++this.counts.malformed;
      console.warn("a frame could not be decoded:", error);
    }
    tile.decoding = false;
    const next = tile.waiting;
    tile.waiting = null;
    if (next) await this.frame(...next);
  }
  draw(tile, header, bitmap) {
    const quality = rank[header.quality] ?? -1;
    if (header.id < tile.id || (header.id === tile.id && quality <= tile.rank)) return void ++this.counts.dropped;
    tile.id = header.id;
    tile.rank = quality;
    // The bitmap becomes the canvas's content without a copy; a coarse one is stretched by the browser.
    const { width, height } = bitmap;
    if (tile.canvas.width !== width || tile.canvas.height !== height) Object.assign(tile.canvas, { width, height });
    tile.context ??= tile.canvas.getContext("bitmaprenderer", { alpha: false });
    tile.context.transferFromImageBitmap(bitmap);
    ++this.counts[header.quality];
    this.drawn(header);
  }
  /// The point of one eye's picture, 0 to 1 each, at a point of the window; null outside.
  place(x, y) {
    const canvas = this.tiles.get("one")?.canvas;
    if (!canvas) return null;
    const box = canvas.getBoundingClientRect();
    const at = [(x - box.left) / box.width, (y - box.top) / box.height];
    return at.every((share) => share >= 0 && share <= 1) ? at : null;
  }
  describe(text) {
    if (this.stage.getAttribute("aria-label") !== text) this.stage.setAttribute("aria-label", text);
  }
}

export const quality_words = { coarse: "coarse", fine: "fine", final: "sharp" };

/// Shows the SSIM in a live region, which a screen reader reads only for pictures at rest.
export function show_ssim(ssim, at_rest) {
  const place = byId("ssim");
  place.setAttribute("aria-live", at_rest ? "polite" : "off");
  say(place, Number.isFinite(ssim) ? `SSIM of the content ${ssim.toFixed(4)}` : "");
}
