// Scenes of the playground's own: heaps of bodies of one shape or of all, and what visitors throw.
import { SHAPES } from './shapes.js';

// Numbers from 0 to 1 that are the same in every browser.
function numbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

const wall = (x, z, along) => ({
  motion: 'fixed', name: 'wall', shape: { box: { half_extents: along === 'x' ? [x, 1, 0.2] : [0.2, 1, z] } },
});

// The layers of a heap fall into a square pit, one after the other.
export function heapOf(Scene, { shape, count }) {
  const scene = new Scene(), next = numbers(7), names = shape === 'mixed' ? Object.keys(SHAPES) : [shape];
  const side = Math.max(3, Math.ceil(Math.cbrt(3 * count))), half = 0.45 * side + 0.6;
  scene.addBodies({ motion: 'fixed', name: 'ground', shape: { plane: {} } });
  for (const way of [-1, 1]) {
    scene.addBodies({ ...wall(half, half, 'x'), position: [0, 1, way * half] });
    scene.addBodies({ ...wall(half, half, 'z'), position: [way * half, 1, 0] });
  }
  const positions = names.map(() => []), orientations = names.map(() => []);
  for (let i = 0; i < count; ++i) {
    const layer = Math.floor(i / (side * side)), within = i % (side * side), kind = Math.floor(next() * names.length);
    positions[kind].push([(within % side - (side - 1) / 2) * 0.85 + 0.1 * next(), 0.6 + 0.9 * layer,
      (Math.floor(within / side) - (side - 1) / 2) * 0.85 + 0.1 * next()]);
    const turn = [next() - 0.5, next() - 0.5, next() - 0.5, next() + 0.2], size = Math.sqrt(turn.reduce((sum, x) => sum + x * x, 0));
    orientations[kind].push(turn.map((x) => x / size));
  }
  names.forEach((name, kind) => {
    if (positions[kind].length > 0)
      scene.addBodies({ shape: SHAPES[name].shape(0.3) }, positions[kind].length, { position: positions[kind], orientation: orientations[kind] });
  });
  const height = 0.9 * count / (side * side);
  scene.set('camera', { eye: [1.5 * half + 4, 1.1 * half + 3, 2.2 * half + 5], target: [0, Math.min(0.4 * height, 3), 0] });
  return scene;
}
