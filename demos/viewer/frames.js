// Decodes frames: repeats the arithmetic of demos/film/pages/frame_encoder.cpp bit for bit.
import { Reader } from './bytes.js';

function grown(array, length) {
  if (array.length >= length) return array;
  const larger = new array.constructor(Math.max(length, 2 * array.length));
  larger.set(array);
  return larger;
}

// What all bodies do at a moment. Positions and velocities in units of the head.
export class Moment {
  constructor() {
    this.index = -1;  // of the frame
    this.time = 0;    // s
    this.step = 0;
    this.count = 0;   // bodies
    this.exists = new Uint8Array(0);
    this.asleep = new Uint8Array(0);
    this.position = new Int32Array(0);
    this.velocity = new Int32Array(0);
    this.orientation = new Float64Array(0);
    this.force = new Int32Array(0);  // levels
    this.contacts = null;
    this.jointForce = new Int32Array(0);
    this.jointBroken = new Uint8Array(0);
    this.camera = null;
  }
  grow(count) {
    for (const name of ['exists', 'asleep', 'force']) this[name] = grown(this[name], count);
    for (const name of ['position', 'velocity']) this[name] = grown(this[name], 3 * count);
    this.orientation = grown(this.orientation, 4 * count);
    this.count = Math.max(this.count, count);
  }
  copy(other) {
    this.grow(other.exists.length);
    for (const name of ['exists', 'asleep', 'position', 'velocity', 'orientation', 'force']) this[name].set(other[name]);
    for (const name of ['index', 'time', 'step', 'count', 'contacts', 'camera']) this[name] = other[name];
    this.jointForce = other.jointForce.slice();
    this.jointBroken = other.jointBroken;
  }
}

// Several columns of integers, read side by side.
class Columns {
  constructor(from, count) {
    this.bytes = from.bytes;
    this.at = new Int32Array(count);
    for (let k = 0; k < count; ++k) {
      const length = from.count();
      this.at[k] = from.at;
      from.slice(length);
    }
  }
  next(k) {
    const bytes = this.bytes;
    let at = this.at[k], byte = bytes[at++], value = byte & 127;
    for (let shift = 7; byte > 127; shift += 7) {
      byte = bytes[at++];
      value |= (byte & 127) << shift;
    }
    this.at[k] = at;
    return (value >>> 1) ^ -(value & 1);
  }
}

function readLevels(from, levels, count, whole) {
  if (whole) levels.fill(0);
  const changed = from.part(), values = new Reader(from.part());
  for (let byte = 0; byte < changed.length; ++byte) {
    if (changed[byte] === 0) continue;
    for (let bit = 0; bit < 8; ++bit) if (changed[byte] & (1 << bit)) levels[8 * byte + bit] += values.integer();
  }
}

export class FrameDecoder {
  constructor(units) {
    this.units = units;
    this.before = new Moment();
    this.now = new Moment();
    this.falls = new Uint8Array(0);
    this.turn = new Int32Array(0);
    this.touching = [];
  }

  // Decodes the bytes of a frame chunk; `index` is the frame's number.
  decode(bytes, index) {
    const from = new Reader(bytes), { now, units } = this;
    this.before.copy(now);
    now.index = index;
    now.time = from.f64();
    now.step = from.count();
    const flags = from.u8(), whole = (flags & 1) !== 0;
    const count = from.count();
    now.grow(count);
    now.count = count;
    this.falls = grown(this.falls, count);
    this.turn = grown(this.turn, 3 * count);
    if (whole) {
      now.exists.fill(0);
      now.asleep.fill(0);
    }
    const fresh = [];
    for (let left = from.count(), place = 0; left > 0; --left) {
      place += from.count();
      now.exists[place] ^= 1;
      if (now.exists[place]) fresh.push(place);
    }
    for (let left = from.count(), place = 0; left > 0; --left) {
      place += from.count();
      now.asleep[place] ^= 1;
    }
    this.readWhole(from, fresh);
    this.readChanges(from, fresh);
    readLevels(from, now.force, count, whole);
    now.contacts = flags & 2 ? this.readContacts(from, whole) : null;
    if (flags & 4) {
      const joints = from.count(), row = from.part();
      now.jointBroken = Uint8Array.from({ length: joints }, (_, i) => (row[i >> 3] >> (i & 7)) & 1);
      now.jointForce = grown(now.jointForce, joints);
      readLevels(from, now.jointForce, joints, whole);
    }
    now.camera = flags & 8 ? { eye: from.floats(3), target: from.floats(3), fov: from.f32(), orthographic: from.u8() === 1 } : null;
    return units;
  }

  readWhole(from, fresh) {
    const { now, units, turn } = this, columns = new Columns(from, 13), { velocity, position, orientation } = now, { parts } = units;
    let x = 0, y = 0, z = 0;
    for (const place of fresh) {
      const at = 3 * place;
      for (let k = 0; k < 3; ++k) velocity[at + k] = columns.next(k);
      position[at] = parts * (x += columns.next(3));
      position[at + 1] = parts * (y += columns.next(4));
      position[at + 2] = parts * (z += columns.next(5));
      for (let k = 0; k < 3; ++k) turn[at + k] = columns.next(6 + k);
      const code = columns.next(9), largest = code >> 1;
      this.falls[place] = code & 1;
      const a = columns.next(10) * units.orientation, b = columns.next(11) * units.orientation, c = columns.next(12) * units.orientation;
      const rest = Math.sqrt(Math.max(0, 1 - ((a * a + b * b) + c * c)));
      const given = [a, b, c];
      for (let k = 0, next = 0; k < 4; ++k) orientation[4 * place + k] = k === largest ? rest : given[next++];
    }
  }

  readChanges(from, fresh) {
    const { now, units, turn, falls } = this, { exists, velocity, position, orientation } = now;
    const changed = from.part(), columns = new Columns(from, 9);
    const { parts } = units, step = units.turn, [fallX, fallY, fallZ] = units.fall;
    const canFall = fallX !== 0 || fallY !== 0 || fallZ !== 0;
    let next = 0, bit = 0;
    for (let place = 0; place < now.count; ++place) {
      if (!exists[place]) continue;
      if (next < fresh.length && fresh[next] === place) {
        ++next;
        continue;
      }
      const differs = (changed[bit >> 3] >> (bit & 7)) & 1, at = 3 * place;
      ++bit;
      const vx = velocity[at], vy = velocity[at + 1], vz = velocity[at + 2];
      if (!differs && !falls[place] && vx === 0 && vy === 0 && vz === 0 && turn[at] === 0 && turn[at + 1] === 0 && turn[at + 2] === 0) continue;
      let nx = vx, ny = vy, nz = vz;
      if (falls[place]) {
        nx += fallX;
        ny += fallY;
        nz += fallZ;
      }
      if (differs) {
        nx += columns.next(0);
        ny += columns.next(1);
        nz += columns.next(2);
      }
      position[at] += vx + nx;
      position[at + 1] += vy + ny;
      position[at + 2] += vz + nz;
      if (differs) for (let k = 0; k < 3; ++k) {
        position[at + k] += parts * columns.next(3 + k);
        turn[at + k] += columns.next(6 + k);
      }
      falls[place] = canFall && Math.abs(nx - vx - fallX) <= 2 && Math.abs(ny - vy - fallY) <= 2 && Math.abs(nz - vz - fallZ) <= 2 ? 1 : 0;
      velocity[at] = nx;
      velocity[at + 1] = ny;
      velocity[at + 2] = nz;
      if (turn[at] === 0 && turn[at + 1] === 0 && turn[at + 2] === 0) continue;
      const ux = turn[at] * step, uy = turn[at + 1] * step, uz = turn[at + 2] * step, q = 4 * place;
      const x = orientation[q], y = orientation[q + 1], z = orientation[q + 2], w = orientation[q + 3];
      const rx = ((w * ux + x) + y * uz) - z * uy, ry = ((w * uy + y) + z * ux) - x * uz,
        rz = ((w * uz + z) + x * uy) - y * ux, rw = ((w - x * ux) - y * uy) - z * uz;
      const length = Math.sqrt(((rx * rx + ry * ry) + rz * rz) + rw * rw);
      orientation[q] = rx / length;
      orientation[q + 1] = ry / length;
      orientation[q + 2] = rz / length;
      orientation[q + 3] = rw / length;
    }
  }

  // Points that touch: { count, a, b (places), point (m, three each), normal, level }.
  readContacts(from, whole) {
    const known = whole ? [] : this.touching, stays = from.part(), changed = from.part(), columns = new Columns(from, 6);
    const kept = [];
    known.forEach((point, i) => {
      if (!(stays[i >> 3] >> (i & 7) & 1)) return;
      const k = kept.push(point) - 1;
      if (changed[k >> 3] >> (k & 7) & 1) for (let c = 0; c < 6; ++c) point.told[c] += columns.next(c);
    });
    const fresh = [], count = from.count(), numbers = new Columns(from, 8);
    for (let i = 0, a = 0; i < count; ++i) {
      a += numbers.next(0);
      fresh.push({ a, b: a + numbers.next(1), told: Array.from({ length: 6 }, (_, c) => numbers.next(2 + c)) });
    }
    // By bodies; of a pair those that were there before come first.
    this.touching = [];
    for (let i = 0, j = 0; i < kept.length || j < fresh.length;) {
      const old = kept[i], young = fresh[j];
      const first = !young || (old && (old.a < young.a || (old.a === young.a && old.b <= young.b)));
      this.touching.push(first ? old : young);
      if (first) ++i; else ++j;
    }
    const { touching } = this, { position } = this.now, { units } = this, n = touching.length;
    const made = { count: n, a: new Int32Array(n), b: new Int32Array(n), point: new Float64Array(3 * n), normal: new Float32Array(3 * n),
      level: new Int32Array(n) };
    touching.forEach(({ a, b, told }, i) => {
      made.a[i] = a - 1;
      made.b[i] = b - 1;
      const beside = this.planes?.[a - 1] ? b - 1 : a - 1;
      for (let k = 0; k < 3; ++k) made.point[3 * i + k] = (position[3 * beside + k] + 4 * units.parts * told[k]) * units.position;
      let x = told[3] / 127.5 - 1, z = told[4] / 127.5 - 1;
      const y = 1 - Math.abs(x) - Math.abs(z);
      if (y < 0) [x, z] = [Math.sign(x) * (1 - Math.abs(z)), Math.sign(z) * (1 - Math.abs(x))];
      const length = Math.hypot(x, y, z) || 1;
      made.normal.set([x / length, y / length, z / length], 3 * i);
      made.level[i] = told[5];
    });
    return made;
  }

  forceOf(level) { return level > 0 ? this.units.force * 2 ** ((level - 1) / this.units.levels_per_octave) : 0; }
}
