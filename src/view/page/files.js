// Files: what the panel shows, descriptions, the command line, TOML and EXR.
import { byId, download, make, say } from "./dom.js";

const told = (answer) => (answer.problems || []).map((p) => p.what).join("; ");
const files_say = (text) => say(byId("files-say"), text);

export class Files {
  constructor(store, ask) {
    Object.assign(this, { store, ask, hello: null, files: { displays: [], models: [], pictures: [] }, eyes: {} });
    const shown = byId("shown"), display = byId("display");
    shown.onchange = () => {
      const [kind, ...name] = shown.value.split(":");
      store.change({ shown: { kind, name: name.join(":"), hold: store.now.shown.hold } });
    };
    // Parameters of one display do not apply to another, nor does where the eye stands, nor a picture of its panel.
    display.onchange = () => {
      const { eye, shown: panel } = store.now, own = display.value ? this.eyes[display.value] : this.hello?.eye_mm;
      const keeps = panel.kind !== "panel_image";
      store.change({ display: display.value, set: {}, eye: own ?? eye, shown: keeps ? panel : { ...panel, kind: "start", name: "" } });
    };
    for (const list of [shown, display]) list.onpointerdown = list.onfocus = () => this.look();
    byId("hold").onchange = (event) => store.change({ shown: { ...store.now.shown, hold: event.target.checked } });
    byId("copy").onclick = () => this.copy();
    byId("toml").onclick = () => this.toml();
    byId("save").onclick = () => this.save();
    byId("exr").onclick = () => this.exr();
  }
  greeted(hello) {
    this.hello = hello;
    this.fill();
  }
  /// Files may change: they are listed again when the list is about to open.
  async look() {
    try {
      const answer = await this.ask("files");
      for (const kind of Object.keys(this.files)) this.files[kind] = (Array.isArray(answer[kind]) ? answer[kind] : []).map(String);
      this.eyes = answer.eyes_mm ?? {};
      this.fill();
    } catch {
      // without a connection the lists stay as they are
    }
  }
  fill() {
    const { hello, files } = this, option = (value, textContent) => make("option", { value, textContent });
    const group = (label, kind, names) =>
      names.length ? [make("optgroup", { label }, ...names.map((name) => option(`${kind}:${name}`, name)))] : [];
    const parts = {
      display: [option("", `as started: ${hello.display}`), ...files.displays.map((name) => option(name, name))],
      shown: [option("start:", `as started: ${hello.shown?.name || hello.shown?.kind}`), ...group("Models", "model", ["built-in:spheres", ...files.models]),
        ...group("Patterns", "pattern", hello.patterns || []), ...group("Panel images", "panel_image", files.pictures)],
    };
    for (const [id, options] of Object.entries(parts)) {
      const list = byId(id), key = JSON.stringify([hello, files]);
      if (list.filled === key) continue;  // not under an open list
      list.filled = key;
      list.replaceChildren(...options);
    }
    this.show();
  }
  /// The state's choices in the lists; one that is not listed is added.
  show() {
    const { display, shown } = this.store.now;
    for (const [id, value] of [["display", display], ["shown", `${shown.kind}:${shown.kind === "start" ? "" : shown.name}`]]) {
      const list = byId(id);
      if (![...list.options].some((o) => o.value === value)) list.append(make("option", { value, textContent: value }));
      list.value = value;
    }
    byId("hold").checked = shown.hold;
  }
  async copy() {
    const place = byId("command");
    try {
      await navigator.clipboard.writeText(place.value);
      files_say("The command is in the clipboard.");
    } catch {
      place.focus();
      place.select();
      files_say("The browser does not allow copying: the command is selected, Ctrl-C copies it.");
    }
  }
  async ask_and_say(what, more, then) {
    try {
      const answer = await this.ask(what, more);
      files_say(told(answer) || then(answer) || "");
    } catch (error) {
      files_say(error.message);
    }
  }
  toml() {
    return this.ask_and_say("toml", {}, (answer) => download("display.toml", [answer.text], "application/toml"));
  }
  save() {
    return this.ask_and_say("save", { name: byId("save-name").value.trim(), overwrite: byId("overwrite").checked },
      (answer) => `Saved as ${answer.name}.`);
  }
  /// The picture itself comes as a frame; an answer contains only problems.
  async exr() {
    files_say("Making the picture ...");
    this.exr_wanted = true;
    try {
      const problem = told(await this.ask("exr"));
      if (problem) files_say(problem);
    } catch (error) {
      if (this.exr_wanted) files_say(error.message);
    }
  }
  /// Saves the frame of the lane "file".
  exr_came(blob) {
    if (!this.exr_wanted) return;
    this.exr_wanted = false;
    download("view.exr", [blob], "image/x-exr");
    files_say("view.exr is downloaded.");
  }
}
