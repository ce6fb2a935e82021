// What a recording tells of a scene: its head, meshes, bodies and joints.
import { Reader } from './bytes.js';

export const SPHERE = 0, BOX = 1, CAPSULE = 2, CYLINDER = 3, CONE = 4, FIRST_MESH = 8;
export const DYNAMIC = 0, FIXED = 1, KINEMATIC = 2;

function meshOf(bytes) {
  const from = new Reader(bytes), kind = from.u8();
  if (kind === 0) {
    const vertices = from.count(), faces = from.count();
    return {
      kind: 'hull', points: Float32Array.from(from.floats(3 * vertices)),
      faces: Array.from({ length: faces }, () => Array.from({ length: from.count() }, () => from.count())),
    };
  }
  if (kind === 1) {
    const vertices = from.count(), triangles = from.count();
    const points = Float32Array.from(from.floats(3 * vertices));
    return { kind: 'mesh', points, corners: Uint32Array.from({ length: 3 * triangles }, () => from.count()) };
  }
  const columns = from.count(), rows = from.count(), spacing = from.f32();
  const points = new Float32Array(3 * columns * rows), corners = [];
  for (let row = 0, at = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column, ++at) {
      points.set([(column - (columns - 1) / 2) * spacing, from.f32(), (row - (rows - 1) / 2) * spacing], 3 * at);
      if (row + 1 < rows && column + 1 < columns) corners.push(at, at + columns, at + 1, at + 1, at + columns, at + columns + 1);
    }
  return { kind: 'mesh', points, corners: Uint32Array.from(corners) };
}

function bodyOf(from) {
  const body = { id: from.count(), name: from.text(), motion: from.u8() };
  const flags = from.u8();
  body.color = flags & 1 ? [from.u8() / 255, from.u8() / 255, from.u8() / 255] : null;
  body.fragment = (flags & 2) !== 0;
  body.mass = from.f32();
  body.inertia = from.floats(3);
  body.shape = from.text();
  body.plane = from.u8() ? { normal: from.floats(3), offset: from.f32() } : null;
  body.parts = Array.from({ length: from.count() }, () => (
    { mesh: from.count(), size: from.floats(3), position: from.floats(3), orientation: from.floats(4) }));
  body.label = body.name || `body ${body.id}`;
  return body;
}

export class Scene {
  constructor() {
    this.head = null;
    this.meshes = [];
    this.bodies = [];  // by place, as in frames
    this.joints = [];
    this.events = [];
    this.version = 0;  // rises with each change
  }
  // Takes a chunk; false: it is of a frame, or unknown.
  take({ name, bytes }) {
    const from = new Reader(bytes);
    if (name === 'head') {
      this.head = JSON.parse(from.bytes.length ? new TextDecoder().decode(bytes) : '{}');
      if (this.head.format !== 1) throw new Error(`this page plays recordings of format 1, not ${this.head.format}`);
    } else if (name === 'mesh') {
      this.meshes.push(meshOf(bytes));
    } else if (name === 'body') {
      for (let left = from.count(); left > 0; --left) this.bodies.push(bodyOf(from));
    } else if (name === 'join') {
      this.joints = Array.from({ length: from.count() }, () => ({
        a: from.count() - 1, b: from.count() - 1, axis: from.u8() === 1,
        anchorA: from.floats(3), anchorB: from.floats(3), frame: from.floats(4),
      }));
    } else if (name === 'evnt') {
      for (let left = from.count(); left > 0; --left)
        this.events.push({
          kind: ['hit', 'broke', 'joint'][from.u8()], time: from.f32(), a: from.count() - 1, b: from.count() - 1,
          speed: from.f32(), impulse: from.f32(), point: from.floats(3),
        });
      this.events.sort((x, y) => x.time - y.time);
    } else {
      return false;
    }
    ++this.version;
    return true;
  }
}
