// A camera path: positions of the eye and their times. `lfdsim render --path` reads the same file.
import { byId, download, finite, say } from "./dom.js";

const most_poses = 15000;      // so that the file stays below 1 MiB, which `lfdsim render --path` reads
const most_read = 100000;
const path_says = (text) => say(byId("path-says"), text);

/// The poses in a file's text. Throws Error, which states the fault.
export function parse_path(text) {
  const path = JSON.parse(text), { frames_per_second: fps, poses } = path ?? {};
  if (path?.schema !== 1) throw new Error('"schema" must be 1');
  if (!(finite(fps) && fps > 0 && fps <= 1000)) throw new Error('"frames_per_second" must be above 0 and at most 1000');
  if (!Array.isArray(poses) || !poses.length || poses.length > most_read) throw new Error(`"poses" must be 1 to ${most_read} of them`);
  poses.forEach((pose, k) => {
    const at = pose?.position_mm, t = pose?.time_s;
    if (!Array.isArray(at) || at.length !== 3 || !finite(...at) || at.some((x) => Math.abs(x) > 1e6))
      throw new Error(`pose ${k}: "position_mm" must be three numbers of at most 1e6`);
    if (!finite(t) || (k ? t <= poses[k - 1].time_s : t !== 0)) throw new Error(`pose ${k}: "time_s" must start at 0 and rise`);
  });
  return poses.map(({ time_s, position_mm }) => ({ time_s, position_mm }));
}

/// The eye's position at that time: linear between poses.
export function position_at(poses, time_s) {
  const next = poses.findIndex((pose) => pose.time_s > time_s);
  if (next < 0) return poses.at(-1).position_mm;
  if (next === 0) return poses[0].position_mm;
  const a = poses[next - 1], b = poses[next], share = (time_s - a.time_s) / (b.time_s - a.time_s);
  return a.position_mm.map((x, k) => x + share * (b.position_mm[k] - x));
}

export class Path {
  /// moved(): called when a replay has ended.
  constructor(store, moved) {
    Object.assign(this, { store, moved, poses: [], recording: null, replaying: null });
    byId("record").onclick = () => (this.recording === null ? this.record() : this.stop());
    byId("replay").onclick = () => (this.replaying === null ? this.replay() : this.stop());
    byId("path-save").onclick = () => this.save();
    byId("path-load").onchange = (event) => this.load(event.target.files[0]);
    this.buttons();
  }
  buttons() {
    const recording = this.recording !== null, replaying = this.replaying !== null, none = !this.poses.length;
    byId("record").setAttribute("aria-pressed", String(recording));
    byId("record").disabled = replaying;
    say(byId("record"), recording ? "Stop" : "Record");
    byId("replay").disabled = recording || none;
    say(byId("replay"), replaying ? "Stop" : "Replay");
    byId("path-save").disabled = recording || none;
    byId("path-load").disabled = recording || replaying;
  }
  record() {
    this.recording = performance.now();
    this.poses = [{ time_s: 0, position_mm: this.store.now.eye }];
    path_says("Recording: move the eye.");
    this.buttons();
  }
  /// Records the eye's position; to be called when it may have moved.
  note() {
    if (this.recording === null) return;
    const time_s = Math.round(performance.now() - this.recording) / 1000, last = this.poses.at(-1), { eye } = this.store.now;
    if (String(eye) === String(last.position_mm) || time_s <= last.time_s) return;
    // Between poses the eye moves in a straight line: where it stood still, a pose is added at the end of that time.
    if (time_s - last.time_s > 0.1) this.poses.push({ time_s: Math.round(1000 * time_s - 20) / 1000, position_mm: last.position_mm });
    this.poses.push({ time_s, position_mm: eye });
    this.tell("Recording");
    if (this.poses.length >= most_poses) this.stop();
  }
  stop() {
    if (this.recording !== null) this.tell("Recorded");
    this.recording = null;
    if (this.replaying !== null) {
      this.replaying = null;
      this.tell("Path");
      this.moved();
    }
    this.buttons();
  }
  tell(what) {
    const poses = this.poses.length === 1 ? "1 pose" : `${this.poses.length} poses`;
    path_says(`${what}: ${poses}, ${this.poses.at(-1).time_s.toFixed(1)} s.`);
  }
  replay() {
    const start = this.replaying = performance.now();
    const go = () => {
      if (this.replaying !== start) return;
      const now = performance.now(), time_s = (now - start) / 1000;
      this.store.change({ eye: position_at(this.poses, time_s) }, true, now);
      if (time_s >= this.poses.at(-1).time_s) this.stop();
      else requestAnimationFrame(go);
    };
    path_says("Replay.");
    this.buttons();
    requestAnimationFrame(go);
  }
  save() {
    const poses = this.poses.map((pose) => "  " + JSON.stringify(pose)).join(",\n");
    download("path.json", [`{"schema": 1, "frames_per_second": 30, "poses": [\n${poses}\n]}\n`], "application/json");
  }
  async load(file) {
    byId("path-load").value = "";
    if (!file) return;
    try {
      if (file.size > 16 << 20) throw new Error("it is larger than 16 MiB");
      this.poses = parse_path(await file.text());
      this.tell(file.name);
    } catch (error) {
      path_says(`${file.name} is not a camera path: ${error.message}.`);
    }
    this.buttons();
  }
}
