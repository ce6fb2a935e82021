// The shapes that the playground makes, by name; of about the same volume for a size, m.
const turned = Math.SQRT1_2;

export const SHAPES = {
  box: { label: 'Boxes', one: 'Box', shape: (s) => ({ box: { half_extents: [s, s, s] } }) },
  sphere: { label: 'Spheres', one: 'Sphere', shape: (s) => ({ sphere: { radius: 1.2 * s } }) },
  capsule: { label: 'Capsules', one: 'Capsule', shape: (s) => ({ capsule: { radius: 0.8 * s, half_height: 0.7 * s } }) },
  cylinder: { label: 'Cylinders', one: 'Cylinder', shape: (s) => ({ cylinder: { radius: 1.1 * s, half_height: 0.9 * s } }) },
  cone: { label: 'Cones', one: 'Cone', shape: (s) => ({ cone: { radius: 1.3 * s, height: 2.2 * s } }) },
  hull: {
    label: 'Stones', one: 'Stone',
    shape: (s) => ({ hull: { points: [[1.3, 0.1, 0], [-1.2, 0.2, 0.1], [0.1, 1, 0.2], [-0.1, -0.9, 0], [0, 0.1, 1.4], [0.2, -0.1, -1.3], [0.8, 0.6, 0.7],
      [-0.7, -0.5, -0.8], [-0.8, 0.5, 0.8], [0.7, -0.6, -0.7]].map((point) => point.map((x) => x * s)) } }),
  },
  jack: {
    label: 'Jacks', one: 'Jack',
    shape: (s) => ({ compound: { parts: [[0, 0, 0, 1], [turned, 0, 0, turned], [0, 0, turned, turned]].map((orientation) => (
      { shape: { capsule: { radius: 0.35 * s, half_height: 1.2 * s } }, orientation })) } }),
  },
};
