// Motion of the eye: on a sphere about the panel's centre, in a plane along the panel, nearer and farther. mm and degrees.
import { clamp } from "./dom.js";

const degree = Math.PI / 180;
const steepest = 85 * degree;  // from the panel's normal
const nearest_mm = 1, furthest_mm = 1e6;

export const distance = (eye) => Math.hypot(...eye);

/// The eye's direction from the panel's centre: angles to the right and up.
export function angles(eye) {
  return { across_deg: Math.atan2(eye[0], eye[2]) / degree, up_deg: Math.asin(clamp(eye[1] / (distance(eye) || 1), -1, 1)) / degree };
}

const rounded = (eye) => eye.map((x) => Math.round(x * 1e4) / 1e4 + 0);

/// Limited to the steepest angle from the normal, at the same distance.
function bounded(eye) {
  const r = clamp(distance(eye), nearest_mm, furthest_mm), from = Math.hypot(eye[0], eye[1]);
  const angle = Math.min(Math.atan2(from, eye[2]), steepest);
  const aside = from > 0 ? (r * Math.sin(angle)) / from : 0;
  return rounded([eye[0] * aside, eye[1] * aside, r * Math.cos(angle)]);
}

/// Turned about the panel's centre; `from` is the eye's position before.
export function on_sphere(from, across_deg, up_deg) {
  const { across_deg: across, up_deg: up } = angles(from);
  const a = clamp(across + across_deg, -85, 85) * degree, u = clamp(up + up_deg, -85, 85) * degree, r = distance(from);
  return bounded([r * Math.sin(a) * Math.cos(u), r * Math.sin(u), r * Math.cos(a) * Math.cos(u)]);
}

/// Moved parallel to the panel, by the length of a degree at the panel's normal.
export function in_plane(from, across_deg, up_deg) {
  const mm = Math.abs(from[2]) * degree, reach = Math.abs(from[2]) * Math.tan(steepest);
  const x = from[0] + across_deg * mm, y = from[1] + up_deg * mm, aside = Math.hypot(x, y);
  const share = aside > reach ? reach / aside : 1;
  return rounded([x * share, y * share, from[2]]);
}

export const at_distance = (from, times) => bounded(from.map((x) => x * clamp(distance(from) * times, nearest_mm, furthest_mm) / (distance(from) || 1)));
export const on_axis = (from) => rounded([0, 0, clamp(distance(from), nearest_mm, furthest_mm)]);
