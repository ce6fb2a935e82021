// Triangle meshes of shapes. A corner has 8 numbers: position, normal, distance to the edge of its face and width of edges, m.
import { cross, sub, unit } from './math.js';

const made = () => ({ corners: [], indices: [] });
function put(mesh, position, normal, toEdge = 0, edges = 0) {
  mesh.corners.push(...position, ...normal, toEdge, edges);
  return mesh.corners.length / 8 - 1;
}
const finished = ({ corners, indices }) => ({ corners: new Float32Array(corners), indices: new Uint32Array(indices) });

// A unit ball in rings; with `caps` two halves, told apart by the sign in place of the distance to the edge.
export function ball(around, rings, caps = false) {
  const mesh = made(), rows = [];
  for (let k = 0; k <= rings; ++k) {
    const polar = Math.PI * k / rings;
    const halves = caps && 2 * k === rings ? [1, -1] : [2 * k <= rings ? 1 : -1];
    for (const half of halves) {
      const row = [];
      for (let i = 0; i < around; ++i) {
        const angle = 2 * Math.PI * i / around;
        const at = [Math.sin(polar) * Math.cos(angle), Math.cos(polar), Math.sin(polar) * Math.sin(angle)];
        row.push(put(mesh, at, at, caps ? half : 0));
      }
      rows.push(row);
    }
  }
  for (let k = 0; k + 1 < rows.length; ++k)
    for (let i = 0; i < around; ++i) {
      const j = (i + 1) % around;
      if (k > 0) mesh.indices.push(rows[k][i], rows[k][j], rows[k + 1][i]);
      if (k + 2 < rows.length) mesh.indices.push(rows[k][j], rows[k + 1][j], rows[k + 1][i]);
    }
  return finished(mesh);
}

// A ball of few pixels, as large as one of its outline.
export function octahedron() {
  const mesh = made(), at = (x, y, z) => put(mesh, [1.15 * x, 1.15 * y, 1.15 * z], [x, y, z]);
  const [left, right, low, high, back, front] = [at(-1, 0, 0), at(1, 0, 0), at(0, -1, 0), at(0, 1, 0), at(0, 0, -1), at(0, 0, 1)];
  for (const [a, b] of [[front, right], [right, back], [back, left], [left, front]]) mesh.indices.push(high, a, b, low, b, a);
  return finished(mesh);
}

// The corners of a box that its near faces need; which, the shader finds (shaders/render/bodies/cube.h).
export function nearBox() {
  const mesh = made();
  for (let i = 0; i < 7; ++i) put(mesh, [i, 0, 0], [0, 1, 0]);
  const quad = (a, b, c, d) => mesh.indices.push(a - 1, b - 1, c - 1, a - 1, c - 1, d - 1);
  quad(1, 3, 7, 5);  // the face of bit 0, and so on
  quad(2, 6, 7, 3);
  quad(4, 5, 7, 6);
  return finished(mesh);
}

function disc(mesh, sides, height, up) {
  const middle = put(mesh, [0, height, 0], [0, up, 0]), rim = [];
  for (let i = 0; i < sides; ++i) {
    const angle = 2 * Math.PI * i / sides;
    rim.push(put(mesh, [Math.cos(angle), height, Math.sin(angle)], [0, up, 0]));
  }
  for (let i = 0; i < sides; ++i) {
    const a = rim[i], b = rim[(i + 1) % sides];
    mesh.indices.push(middle, up > 0 ? b : a, up > 0 ? a : b);
  }
}

export function cylinder(sides) {
  const mesh = made(), rows = [[], []];
  disc(mesh, sides, 1, 1);
  disc(mesh, sides, -1, -1);
  for (let i = 0; i < sides; ++i) {
    const angle = 2 * Math.PI * i / sides, out = [Math.cos(angle), 0, Math.sin(angle)];
    rows[0].push(put(mesh, [out[0], -1, out[2]], out));
    rows[1].push(put(mesh, [out[0], 1, out[2]], out));
  }
  for (let i = 0; i < sides; ++i) {
    const j = (i + 1) % sides;
    mesh.indices.push(rows[0][i], rows[1][i], rows[1][j], rows[0][i], rows[1][j], rows[0][j]);
  }
  return finished(mesh);
}

export function cone(sides) {
  const mesh = made();
  disc(mesh, sides, -0.25, -1);
  for (let i = 0; i < sides; ++i) {
    const at = (k) => [Math.cos(2 * Math.PI * k / sides), 0, Math.sin(2 * Math.PI * k / sides)];
    const a = at(i), b = at(i + 1), tip = at(i + 0.5);
    mesh.indices.push(
      put(mesh, [a[0], -0.25, a[2]], unit([a[0], 1, a[2]])), put(mesh, [0, 0.75, 0], unit([tip[0], 1, tip[2]])),
      put(mesh, [b[0], -0.25, b[2]], unit([b[0], 1, b[2]])));
  }
  return finished(mesh);
}

const pointOf = (points, i) => [points[3 * i], points[3 * i + 1], points[3 * i + 2]];

// Faces with edges as those of boxes: 14% of the thinnest half width, at most 6 cm.
export function hull({ points, faces }) {
  const mesh = made();
  const normals = faces.map((face) => {
    const normal = [0, 0, 0];  // by Newell
    for (let k = 0; k < face.length; ++k) {
      const a = pointOf(points, face[k]), b = pointOf(points, face[(k + 1) % face.length]);
      const c = cross(a, b);
      for (let i = 0; i < 3; ++i) normal[i] += c[i];
    }
    return unit(normal);
  });
  let thinnest = Infinity;
  faces.forEach((face, f) => {
    const a = pointOf(points, face[0]);
    thinnest = Math.min(thinnest, normals[f][0] * a[0] + normals[f][1] * a[1] + normals[f][2] * a[2]);
  });
  const edges = Math.min(Math.max(0.14 * thinnest, 1e-6), 0.06);
  faces.forEach((face, f) => {
    const middle = [0, 0, 0];
    for (const corner of face) pointOf(points, corner).forEach((x, i) => (middle[i] += x / face.length));
    for (let k = 0; k < face.length; ++k) {
      const a = pointOf(points, face[k]), b = pointOf(points, face[(k + 1) % face.length]);
      const along = sub(b, a), away = cross(sub(middle, a), along), size = Math.hypot(...along) || 1e-12;
      mesh.indices.push(put(mesh, middle, normals[f], Math.hypot(...away) / size, edges), put(mesh, a, normals[f], 0, edges),
        put(mesh, b, normals[f], 0, edges));
    }
  });
  return finished(mesh);
}

export function surface({ points, corners }) {
  const count = corners.length, mesh = { corners: new Float32Array(8 * count), indices: new Uint32Array(count) };
  for (let k = 0; k < count; k += 3) {
    const at = [0, 1, 2].map((i) => pointOf(points, corners[k + i]));
    const normal = unit(cross(sub(at[1], at[0]), sub(at[2], at[0])));
    for (let i = 0; i < 3; ++i) {
      mesh.corners.set([...at[i], ...normal], 8 * (k + i));
      mesh.indices[k + i] = k + i;
    }
  }
  return mesh;
}

export const radiusOf = ({ points }) => {
  let most = 0;
  for (let i = 0; i < points.length; i += 3) most = Math.max(most, Math.hypot(points[i], points[i + 1], points[i + 2]));
  return most;
};
