// Bodies between two moments, in metres: where they are, how fast, and in what colour.
import { FIXED } from './scene.js';
import { length } from './math.js';

export class Pose {
  constructor() { this.size = -1; }
  room(count) {
    if (this.size === count) return;
    this.size = count;
    this.exists = new Uint8Array(count);
    this.asleep = new Uint8Array(count);
    this.position = new Float64Array(3 * count);
    this.velocity = new Float32Array(3 * count);
    this.orientation = new Float64Array(4 * count);
    this.color = new Uint32Array(count);
    this.shown = 0;
    this.fixed = null;
  }

  // `part` from 0 (before) to 1 (now), which are `seconds` apart. A body that appears or goes between two frames does so at the later.
  set(before, now, part, head, seconds) {
    const count = now.count, units = head.units, p = units.position, v = units.velocity;
    this.room(count);
    const { exists, asleep, position, velocity, orientation } = this;
    const from = part >= 1 ? now : before, still = before === now;
    this.shown = 0;
    const t = part, t2 = t * t, t3 = t2 * t;
    const h0 = 2 * t3 - 3 * t2 + 1, h1 = 3 * t2 - 2 * t3, s0 = (t3 - 2 * t2 + t) * seconds, s1 = (t3 - t2) * seconds;
    for (let i = 0; i < count; ++i) {
      exists[i] = i < from.count ? from.exists[i] : 0;
      if (!exists[i]) continue;
      ++this.shown;
      asleep[i] = from.asleep[i];
      const a = 3 * i, q = 4 * i;
      const goesOn = !still && before.exists[i] && now.exists[i];
      if (part >= 1 || !goesOn) {
        const lag = part >= 1 ? 0 : t * seconds;  // one that ends before the next frame flies on
        for (let k = 0; k < 3; ++k) {
          velocity[a + k] = from.velocity[a + k] * v;
          position[a + k] = from.position[a + k] * p + velocity[a + k] * lag;
        }
        for (let k = 0; k < 4; ++k) orientation[q + k] = from.orientation[q + k];
        continue;
      }
      let fits = true;
      for (let k = 0; k < 3; ++k) {
        const v0 = before.velocity[a + k] * v, v1 = now.velocity[a + k] * v, way = (now.position[a + k] - before.position[a + k]) * p;
        const smooth = 0.5 * (v0 + v1) * seconds;
        fits = fits && Math.abs(way - smooth) <= 4 * p + 0.2 * Math.abs(way);
        velocity[a + k] = v0 + (v1 - v0) * t;
      }
      for (let k = 0; k < 3; ++k) {
        const p0 = before.position[a + k] * p, p1 = now.position[a + k] * p;
        // On a cubic where velocities agree with the way, else straight: in between there was an impact.
        position[a + k] = fits ? h0 * p0 + s0 * before.velocity[a + k] * v + h1 * p1 + s1 * now.velocity[a + k] * v : p0 + (p1 - p0) * t;
      }
      this.turn(before.orientation, now.orientation, q, t);
    }
  }

  turn(a, b, q, t) {
    const { orientation } = this;
    let x = b[q], y = b[q + 1], z = b[q + 2], w = b[q + 3];
    let near = a[q] * x + a[q + 1] * y + a[q + 2] * z + a[q + 3] * w;
    if (near > 0.9999999) {
      orientation[q] = x;
      orientation[q + 1] = y;
      orientation[q + 2] = z;
      orientation[q + 3] = w;
      return;
    }
    if (near < 0) {
      near = -near;
      x = -x;
      y = -y;
      z = -z;
      w = -w;
    }
    let f = 1 - t, g = t;
    if (near < 0.995) {
      const angle = Math.acos(near), sine = Math.sin(angle);
      f = Math.sin((1 - t) * angle) / sine;
      g = Math.sin(t * angle) / sine;
    }
    x = f * a[q] + g * x;
    y = f * a[q + 1] + g * y;
    z = f * a[q + 2] + g * z;
    w = f * a[q + 3] + g * w;
    const size = Math.sqrt(x * x + y * y + z * z + w * w) || 1;
    orientation[q] = x / size;
    orientation[q + 1] = y / size;
    orientation[q + 2] = z / size;
    orientation[q + 3] = w / size;
  }

  // `near`: the one of both moments whose forces are shown.
  paint(palette, scene, before, now, near, seconds, levelToForce, substepSeconds) {
    const { bodies } = scene, { color, exists, velocity, position } = this, { by } = palette;
    if (this.fixed?.palette !== palette.version || this.fixed.bodies !== bodies.length)
      this.fixed = { palette: palette.version, bodies: bodies.length, colors: bodies.map((body) => palette.fixedColor(body)) };
    const { colors } = this.fixed;
    for (let i = 0; i < this.size; ++i) {
      if (!exists[i]) continue;
      if (palette.dull && this.asleep[i] && bodies[i].motion !== FIXED) {
        color[i] = palette.asleep;
        continue;
      }
      const own = colors[i];
      if (own !== null) {
        color[i] = own;
        continue;
      }
      if (by === 'sleep') {
        color[i] = this.asleep[i] ? palette.asleep : palette.awake;
        continue;
      }
      let value;
      if (by === 'height') {
        value = position[3 * i + 1];
      } else if (by === 'contact-impulse') {
        value = levelToForce(near.force[i]) * substepSeconds;
      } else if (by === 'spin' || by === 'angular-momentum' || by === 'kinetic-energy') {
        value = this.turning(by, i, bodies[i], before, now, seconds);
      } else {
        const x = velocity[3 * i], y = velocity[3 * i + 1], z = velocity[3 * i + 2], speed = Math.sqrt(x * x + y * y + z * z);
        value = by === 'momentum' ? speed * bodies[i].mass : speed;
      }
      color[i] = palette.at(value);
    }
  }

  // What depends on the spin, which is that between the two moments.
  turning(by, i, body, before, now, seconds) {
    const spin = spinOf(before, now, i, seconds);
    if (by === 'spin') return length(spin);
    const moment = spin.map((w, k) => w * body.inertia[k]);
    if (by === 'angular-momentum') return length(moment);
    const v = [0, 1, 2].map((k) => this.velocity[3 * i + k]);
    return 0.5 * (body.mass * (v[0] ** 2 + v[1] ** 2 + v[2] ** 2) + moment[0] * spin[0] + moment[1] * spin[1] + moment[2] * spin[2]);
  }
}

// The spin in the body's frame, rad/s, from one moment to the next.
export function spinOf(before, now, i, seconds) {
  const q = 4 * i, a = before.orientation, b = now.orientation;
  if (before === now || !(before.exists[i] && now.exists[i])) return [0, 0, 0];
  let x = a[q + 3] * b[q] - a[q] * b[q + 3] - a[q + 1] * b[q + 2] + a[q + 2] * b[q + 1];
  let y = a[q + 3] * b[q + 1] - a[q + 1] * b[q + 3] - a[q + 2] * b[q] + a[q] * b[q + 2];
  let z = a[q + 3] * b[q + 2] - a[q + 2] * b[q + 3] - a[q] * b[q + 1] + a[q + 1] * b[q];
  const w = a[q + 3] * b[q + 3] + a[q] * b[q] + a[q + 1] * b[q + 1] + a[q + 2] * b[q + 2];
  const sine = Math.sqrt(x * x + y * y + z * z);
  if (sine < 1e-9) return [0, 0, 0];
  const rate = 2 * Math.atan2(sine, Math.abs(w)) / (sine * seconds) * Math.sign(w || 1);
  return [x * rate, y * rate, z * rate];
}
