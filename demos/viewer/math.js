// Vectors as arrays, quaternions x, y, z, w, and matrices of 16 numbers, column by column.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
export const unit = (a) => scaled(a, 1 / (length(a) || 1));
export const mixed = (a, b, t) => a.map((x, i) => x + (b[i] - x) * t);
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

export function rotated(q, v) {
  const u = scaled(cross(q, v), 2);
  return add(add(v, scaled(u, q[3])), cross(q, u));
}

// Axes of a view along -back: right, up, back.
export function axesOf(back, up = [0, 1, 0]) {
  let right = cross(up, back);
  if (dot(right, right) < 1e-8) right = cross(Math.abs(back[1]) < 0.9 ? [0, 1, 0] : [0, 0, -1], back);
  right = unit(right);
  return { right, up: cross(back, right), back };
}
