// The camera: turns about a point, moves, comes nearer; or the scene's own, as recorded.
import { add, axesOf, clamp, length, scaled, sub, unit } from './math.js';

export class Camera {
  constructor() {
    this.eye = [8, 5, 12];
    this.target = [0, 1, 0];
    this.fov = 45;
    this.orthographic = false;
    this.width = this.height = 1;
  }
  set(view) {
    this.eye = [...view.eye];
    this.target = [...view.target];
    this.fov = view.fov;
    this.orthographic = view.orthographic;
  }
  get distance() { return length(sub(this.eye, this.target)); }
  // Half the view's height at 1 m. Upright screens are as wide as pictures of 4 by 3 would be.
  get slope() { return Math.tan(this.fov * Math.PI / 360) * Math.max(1, 1.2 * this.height / this.width); }
  axes() {
    const back = unit(sub(this.eye, this.target));
    return axesOf(back, Math.abs(back[1]) > 0.999 ? [0, 0, -1] : [0, 1, 0]);
  }
  orbit(right, up) {
    let back = sub(this.eye, this.target);
    const distance = length(back);
    const high = clamp(Math.asin(clamp(back[1] / distance, -1, 1)) + up, -1.55, 1.55);
    const around = Math.atan2(back[0], back[2]) + right;
    back = [Math.sin(around) * Math.cos(high), Math.sin(high), Math.cos(around) * Math.cos(high)];
    this.eye = add(this.target, scaled(back, distance));
  }
  // By fractions of the view's height.
  pan(right, up) {
    const axes = this.axes(), size = 2 * this.slope * this.distance;
    this.move(add(scaled(axes.right, right * size), scaled(axes.up, up * size)));
  }
  move(by) {
    this.eye = add(this.eye, by);
    this.target = add(this.target, by);
  }
  zoom(factor, limit = 1e5) {
    const distance = clamp(this.distance * factor, 1e-3, limit);
    this.eye = add(this.target, scaled(unit(sub(this.eye, this.target)), distance));
  }

  // What shaders need: matrix from the eye to clip space, rays of pixels, sides of the view.
  frame() {
    const { right, up, back } = this.axes(), distance = this.distance, aspect = this.width / this.height;
    const rise = this.orthographic ? this.slope * distance : this.slope, near = Math.max(1e-3, 0.004 * distance);
    const m = new Float32Array(16);
    for (let k = 0; k < 3; ++k) {
      m[4 * k] = right[k] / (rise * aspect);
      m[4 * k + 1] = up[k] / rise;
      if (this.orthographic) {
        m[4 * k + 2] = -back[k] / (100 * distance);
      } else {
        m[4 * k + 2] = m[4 * k + 3] = -back[k];
      }
    }
    if (this.orthographic) {
      m[14] = -0.01;
      m[15] = 1;
    } else {
      m[14] = -2 * near;
    }
    const stepX = scaled(right, 2 * rise * aspect / this.width), stepY = scaled(up, 2 * rise / this.height);
    const corner = sub(sub(this.orthographic ? [0, 0, 0] : scaled(back, -1), scaled(right, rise * aspect)), scaled(up, rise));
    const cosX = 1 / Math.hypot(1, rise * aspect), cosY = 1 / Math.hypot(1, rise);
    const sides = this.orthographic
      ? [[right, rise * aspect], [scaled(right, -1), rise * aspect], [up, rise], [scaled(up, -1), rise]]
      : [[right, 0], [scaled(right, -1), 0]].map(([n]) => [add(scaled(n, cosX), scaled(back, -rise * aspect * cosX)), 0])
        .concat([up, scaled(up, -1)].map((n) => [add(scaled(n, cosY), scaled(back, -rise * cosY)), 0]));
    return { matrix: m, right, up, back, near, corner, stepX, stepY, sides, rise, pixel: 2 * rise / this.height, distance };
  }
  // Where a point of the world is, in pixels from the upper left; null: behind the eye.
  pixelOf(point) {
    const { matrix: m } = this.frame(), [x, y, z] = sub(point, this.eye);
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) return null;
    return [((m[0] * x + m[4] * y + m[8] * z) / w * 0.5 + 0.5) * this.width, (0.5 - (m[1] * x + m[5] * y + m[9] * z) / w * 0.5) * this.height];
  }
}


