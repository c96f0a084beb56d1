// Pointer, wheel and keys on the picture: they move the eye.
import { at_distance, in_plane, on_axis, on_sphere } from "./eye.js";

const sweep_deg = 60;  // a drag over the width of the stage

/// store: state.js; released(): after a drag; hover(x, y), hover(null): when the pointer rests on the picture or leaves it.
export function watch_hands(stage, store, { released, hover }) {
  const pointers = new Map();  // by id: where they are now
  let from = null;             // where the drag began: pointer, eye, and the fingers' distance

  const turn = (eye, across, up, other) => ((store.now.surface === "plane") !== other ? in_plane : on_sphere)(eye, across, up);
  const middle = () => {
    const all = [...pointers.values()];
    return [all.reduce((sum, p) => sum + p[0], 0) / all.length, all.reduce((sum, p) => sum + p[1], 0) / all.length];
  };
  const apart = () => {
    const [a, b] = pointers.values();
    return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
  };
  const begin = () => { from = pointers.size ? { at: middle(), apart: apart(), eye: store.now.eye } : null; };

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target === stage && over_scrollbar(event)) return;
    stage.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    stage.classList.add("moving");
    begin();
  });
  stage.addEventListener("pointermove", (event) => {
    if (!pointers.has(event.pointerId)) return hover(event.clientX, event.clientY);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const [x, y] = middle(), per_px = sweep_deg / stage.clientWidth;
    let eye = turn(from.eye, (x - from.at[0]) * per_px, (from.at[1] - y) * per_px, event.shiftKey);
    if (from.apart > 0 && apart() > 0) eye = at_distance(eye, from.apart / apart());
    if (String(eye) !== String(store.now.eye)) store.change({ eye }, true, event.timeStamp);
  });
  const end = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    begin();
    if (pointers.size) return;
    stage.classList.remove("moving");
    released(event.timeStamp);
  };
  stage.addEventListener("pointerup", end);
  stage.addEventListener("pointercancel", end);
  stage.addEventListener("pointerleave", () => hover(null));

  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 33 : event.deltaMode === 2 ? 400 : 1;
    store.change({ eye: at_distance(store.now.eye, Math.exp(0.001 * lines * event.deltaY)) }, true, event.timeStamp);
  }, { passive: false });

  stage.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = event.shiftKey ? 5 : 1, { eye } = store.now;
    const moved = {
      ArrowLeft: () => turn(eye, -step, 0, false), ArrowRight: () => turn(eye, step, 0, false),
      ArrowUp: () => turn(eye, 0, step, false), ArrowDown: () => turn(eye, 0, -step, false),
      "+": () => at_distance(eye, 1 / 1.05), "=": () => at_distance(eye, 1 / 1.05), "-": () => at_distance(eye, 1.05),
      Home: () => on_axis(eye),
    }[event.key];
    if (!moved) return;
    event.preventDefault();
    store.change({ eye: moved() }, true, event.timeStamp);
  });
  return { held: () => pointers.size > 0 };

  function over_scrollbar(event) {
    const box = stage.getBoundingClientRect();
    return event.clientX - box.left >= stage.clientWidth || event.clientY - box.top >= stage.clientHeight;
  }
}
