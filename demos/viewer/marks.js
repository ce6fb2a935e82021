// What is drawn over bodies: contacts, joints and velocities, as lines and dots from the eye.
import { add, dot, length, rotated, scaled, sub, unit } from './math.js';
import { FIXED } from './scene.js';

const PUSHING = [0.16, 1.0, 0.42, 1], VELOCITY = [0.95, 0.95, 1.0, 0.95], AXIS = [0.95, 0.95, 1.0];
// Colours of joint forces: none, about 10 times and about 100 times the lighter body's weight.
const LIGHT = [0.02, 0.78, 1.0], LADEN = [1.0, 0.80, 0.04], HEAVY = [1.0, 0.03, 0.05], DOUBLINGS = 7;
const mix = (x, y, t) => x.map((v, k) => v + (y[k] - v) * t);

export class Marks {
  // `view`: what has the scene, pose, camera and renderer.
  constructor(view) { this.view = view; }
  get radius() { return this.view.renderer.bodyRadius ?? []; }
  get pixel() { return this.view.renderer.view?.pixel ?? 1e-3; }
  get gravity() { return length(this.view.scene.head.gravity); }
  positionOf(place) { return Array.from(this.view.pose.position.subarray(3 * place, 3 * place + 3)); }
  fromEye(point) { return sub(point, this.view.camera.eye); }
  turnedOn(place, v) { return rotated(this.view.pose.orientation.subarray(4 * place, 4 * place + 4), v); }

  // `touching`: places a and b, points (m) and normals of `count` contacts; forceOf(i) in N.
  addContacts(lines, touching, forceOf) {
    const { scene, pose } = this.view, { bodies, head } = scene, { radius, pixel } = this;
    const substep = 1 / (head.rate * head.substeps), most = (this.gravity > 0 ? this.gravity : 4) * substep;
    for (let i = 0; i < touching.count; ++i) {
      const a = touching.a[i], b = touching.b[i];
      if (!pose.exists[a] || !pose.exists[b]) continue;
      const sizes = [a, b].filter((place) => bodies[place].mass > 0).map((place) => 0.5 * radius[place]);
      const size = Math.min(...sizes, 1e6), masses = [a, b].map((place) => bodies[place].mass).filter((mass) => mass > 0);
      const push = forceOf(i) * substep / Math.min(...masses);
      const half = size * Math.min(0.25 * Math.sqrt(push / most), 0.95);
      const point = this.fromEye(Array.from(touching.point.subarray(3 * i, 3 * i + 3)));
      const normal = Array.from(touching.normal.subarray(3 * i, 3 * i + 3)), way = scaled(normal, half);
      lines.add(sub(point, way), add(point, way), 1.1, 0.4 * size, PUSHING);
      lines.add(point, point, Math.max(1.3, Math.min(0.15 * size / (length(point) * pixel), 5)), 0.4 * size, PUSHING);
    }
  }

  // isBroken(i), forceOf(i) in N, of the scene's joints.
  addJoints(lines, isBroken, forceOf) {
    const { scene, pose, camera, renderer } = this.view, { radius } = this, ratio = renderer.canvas.height / 720;
    const pull = this.gravity > 0 ? this.gravity : 9.81;
    scene.joints.forEach((joint, i) => {
      if (isBroken(i)) return;
      const ends = [[joint.a, joint.anchorA], [joint.b, joint.anchorB]].map(([place, anchor]) => {
        if (place < 0) return { anchor: this.fromEye(anchor), middle: null, reach: 0, mass: 0 };
        const middle = this.fromEye(this.positionOf(place)), { plane, mass } = scene.bodies[place];
        return { anchor: add(middle, this.turnedOn(place, anchor)), middle: plane ? null : middle, gone: !pose.exists[place], reach: radius[place] ?? 0, mass };
      });
      if (ends.some((end) => end.gone)) return;
      const [a, b] = ends, masses = ends.map((end) => end.mass).filter((mass) => mass > 0);
      const reaches = ends.filter((end) => end.mass > 0).map((end) => end.reach), lift = reaches.length ? Math.min(...reaches) : 0;
      const strength = Math.max(0, Math.min(1, Math.log2(1 + forceOf(i) / Math.min(...masses) / pull) / DOUBLINGS));
      const color = [...(strength < 0.5 ? mix(LIGHT, LADEN, 2 * strength) : mix(LADEN, HEAVY, 2 * strength - 1)), 1];
      const pixel = camera.orthographic ? (renderer.view?.pixel ?? 0.01) : length(a.anchor) * this.pixel;
      const dotRadius = Math.max(1.2, Math.min(0.4 * lift / pixel, Math.max(2.2, 3.4 * ratio))), thin = Math.min(Math.max(0.8, 1.2 * ratio), 0.6 * dotRadius);
      for (const end of ends) if (end.middle) lines.add(end.middle, end.anchor, thin, end.reach, color);
      lines.add(a.anchor, b.anchor, thin, lift, color);
      if (joint.axis) {
        let x = rotated(joint.frame, [1, 0, 0]);
        if (joint.a >= 0) x = this.turnedOn(joint.a, x);
        const size = Math.max(3 * dotRadius * pixel, Math.min(0.5 * lift, 8 * dotRadius * pixel));
        lines.add(sub(a.anchor, scaled(x, size)), add(a.anchor, scaled(x, size)), thin, lift, [...AXIS, 1]);
      }
      lines.add(a.anchor, a.anchor, dotRadius, lift, color);
      lines.add(b.anchor, b.anchor, dotRadius, lift, color);
    });
  }

  addVelocities(lines) {
    const { pose, scene } = this.view, { radius } = this;
    for (let i = 0; i < pose.size; ++i) {
      if (!pose.exists[i] || scene.bodies[i].motion === FIXED) continue;
      const v = [pose.velocity[3 * i], pose.velocity[3 * i + 1], pose.velocity[3 * i + 2]];
      if (dot(v, v) < 1e-4) continue;
      const from = this.fromEye(this.positionOf(i)), to = add(from, scaled(v, 0.2)), along = unit(v), head = Math.min(0.3 * length(v) * 0.2, 0.3 * radius[i]);
      lines.add(from, to, 0.9, radius[i], VELOCITY);
      const side = unit([along[1] - along[2], along[2] - along[0], along[0] - along[1]]);
      for (const way of [1, -1]) lines.add(to, add(sub(to, scaled(along, head)), scaled(side, 0.5 * way * head)), 0.9, radius[i], VELOCITY);
    }
  }
}
