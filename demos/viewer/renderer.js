// Draws a moment of a recording with WebGL 2: instances of few meshes, sorted by level of detail, with two light maps.
import { BOX, CAPSULE, CONE, CYLINDER, FIRST_MESH, SPHERE } from './scene.js';
import * as geometry from './geometry.js';
import { axesOf, dot, length, rotated, scaled, sub, unit } from './math.js';
import { sources } from './shaders.js';

const WORDS = 12, ROW = 1024;  // words of a body in the texture: place, tint, turn, size, number; bodies of a row
const MOST_CORNERS = 2048;     // of an instance

// Light of the skies of pictures (host/canvas/frame.cpp): sun, zenith, horizon, bounce, ambient, glow.
export const SKIES = {
  day: [[1.02, 0.94, 0.82], [0.10, 0.22, 0.44], [0.60, 0.66, 0.72], [0.20, 0.18, 0.16], [0.44, 0.48, 0.55], 1, [-0.52, 0.74, 0.43]],
  evening: [[1.25, 0.72, 0.38], [0.09, 0.13, 0.28], [0.72, 0.50, 0.36], [0.17, 0.13, 0.11], [0.30, 0.31, 0.40], 1.6, [-0.85, 0.32, 0.35]],
  overcast: [[0.30, 0.30, 0.30], [0.55, 0.58, 0.62], [0.70, 0.72, 0.74], [0.34, 0.33, 0.32], [0.90, 0.92, 0.95], 0.3, [-0.52, 0.74, 0.43]],
  studio: [[0.85, 0.85, 0.85], [0.78, 0.78, 0.79], [0.86, 0.86, 0.86], [0.34, 0.34, 0.34], [0.62, 0.62, 0.63], 0, [-0.45, 0.85, 0.55]],
  night: [[0.30, 0.36, 0.50], [0.008, 0.012, 0.030], [0.030, 0.040, 0.075], [0.05, 0.05, 0.06], [0.13, 0.15, 0.21], 0.25, [-0.52, 0.74, 0.43]],
};

// Of falling quality: most pixels to one of the screen's units, texels of the maps (0: none), and how many of a body's pixels count
// for its level of detail.
const QUALITIES = [
  { ratio: 2, sun: 2048, sky: 1024, detail: 1 },
  { ratio: 1, sun: 2048, sky: 1024, detail: 1 },
  { ratio: 1, sun: 1024, sky: 0, detail: 0.6 },
  { ratio: 0.6, sun: 512, sky: 0, detail: 0.4 },
  { ratio: 0.4, sun: 0, sky: 0, detail: 0.3 },
];
export const WORST_QUALITY = QUALITIES.length - 1;

export const isSoftware = () => {
  const gl = document.createElement('canvas').getContext('webgl2'), info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
};

export class Renderer {
  constructor(canvas, software) {
    this.canvas = canvas;
    const gl = canvas.getContext('webgl2', { antialias: !software, stencil: true, alpha: false, powerPreference: 'high-performance' });
    if (!gl) throw new Error('this browser draws no WebGL 2');
    this.gl = gl;
    this.quality = software ? 3 : 0;
    this.programs = {};
    for (const [name, [vertex, fragment]] of Object.entries(sources())) this.programs[name] = { name, vertex, fragment };
    this.drawn = [];        // geometry by kind and level
    this.sky = 'day';
    this.sun = null;        // the scene's own direction
    this.instances = { texture: null, rows: 0 };
    this.lines = { buffer: gl.createBuffer(), array: gl.createVertexArray(), data: new Float32Array(0), count: 0 };
    this.empty = gl.createVertexArray();
    this.setUpLines();
    this.makeShapes();
    this.shapesOfMeshes = 0;
    this.parts = null;
    this.sceneVersion = -1;
    this.maps = {};
    this.pickTarget = null;
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.cullFace(gl.BACK);
  }

  // Compiled when it is needed for the first time.
  program(name) {
    const program = this.programs[name], { gl } = this;
    if (!program.handle) {
      const compile = (type, text) => {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
          throw new Error(`shader ${name}: ${gl.getShaderInfoLog(shader)}`);
        return shader;
      };
      program.handle = gl.createProgram();
      gl.attachShader(program.handle, compile(gl.VERTEX_SHADER, program.vertex));
      gl.attachShader(program.handle, compile(gl.FRAGMENT_SHADER, program.fragment));
      gl.linkProgram(program.handle);
      if (!gl.getProgramParameter(program.handle, gl.LINK_STATUS) && !gl.isContextLost())
        throw new Error(`shader ${name}: ${gl.getProgramInfoLog(program.handle)}`);
      program.places = {};
      const count = gl.getProgramParameter(program.handle, gl.ACTIVE_UNIFORMS);
      for (let i = 0; i < count; ++i) {
        const { name: uniform } = gl.getActiveUniform(program.handle, i);
        program.places[uniform] = gl.getUniformLocation(program.handle, uniform);
      }
    }
    gl.useProgram(program.handle);
    return program;
  }

  setUpLines() {
    const { gl, lines } = this;
    gl.bindVertexArray(lines.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, lines.buffer);
    for (let i = 0; i < 3; ++i) {
      gl.enableVertexAttribArray(i);
      gl.vertexAttribPointer(i, 4, gl.FLOAT, false, 48, 16 * i);
      gl.vertexAttribDivisor(i, 1);
    }
    gl.bindVertexArray(null);
  }

  addGeometry(shader, mesh, culls = true) {
    const { gl } = this, array = gl.createVertexArray(), count = mesh.corners.length / 8;
    const together = Math.max(1, Math.min(256, Math.floor(MOST_CORNERS / count)));
    const corners = new Float32Array(9 * count * together), indices = new Uint32Array(mesh.indices.length * together);
    for (let k = 0, to = 0; k < together; ++k) {
      for (let i = 0; i < count; ++i, to += 9) {
        corners.set(mesh.corners.subarray(8 * i, 8 * i + 8), to);
        corners[to + 8] = k;
      }
      for (let i = 0; i < mesh.indices.length; ++i) indices[k * mesh.indices.length + i] = k * count + mesh.indices[i];
    }
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    for (const [place, offset] of [[0, 0], [1, 12], [2, 24]]) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 36, offset);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    const few = count * together < 65536;
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, few ? Uint16Array.from(indices) : indices, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    this.drawn.push({ shader, array, indices: mesh.indices.length, together, type: few ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT, culls,
      seen: 0, total: 0, first: 0 });
    return this.drawn.length - 1;
  }

  // Levels of detail by radius in pixels, finest first.
  makeShapes() {
    const levels = (shader, meshes) => meshes.map(([least, mesh]) => [least, this.addGeometry(shader, mesh)]);
    const tiny = geometry.octahedron();
    this.levels = [];
    this.levels[SPHERE] = levels('ball', [[60, geometry.ball(48, 24)], [16, geometry.ball(24, 12)], [6, geometry.ball(12, 6)], [2, geometry.ball(8, 4)], [0, tiny]]);
    this.levels[BOX] = [[0, this.addGeometry('box', geometry.nearBox(), false)]];
    this.levels[CAPSULE] = levels('capsule', [[40, geometry.ball(32, 16, true)], [10, geometry.ball(16, 8, true)], [0, geometry.ball(8, 4, true)]]);
    this.levels[CYLINDER] = levels('solid', [[20, geometry.cylinder(32)], [5, geometry.cylinder(16)], [0, geometry.cylinder(8)]]);
    this.levels[CONE] = levels('solid', [[20, geometry.cone(32)], [0, geometry.cone(12)]]);
  }

  takeScene(scene) {
    if (this.sceneVersion === scene.version) return;
    this.sceneVersion = scene.version;
    for (; this.shapesOfMeshes < scene.meshes.length; ++this.shapesOfMeshes) {
      const mesh = scene.meshes[this.shapesOfMeshes];
      mesh.radius = geometry.radiusOf(mesh);
      const drawn = this.addGeometry('mesh', mesh.kind === 'hull' ? geometry.hull(mesh) : geometry.surface(mesh));
      // A hull of few pixels is drawn as a ball.
      this.levels[FIRST_MESH + this.shapesOfMeshes] = mesh.kind === 'hull' ? [[1.2, drawn], [0, -1]] : [[0, drawn]];
    }
    const flat = scene.bodies.flatMap((body, place) => body.parts.map((part) => ({ ...part, place }))).sort((a, b) => a.mesh - b.mesh);
    const count = flat.length;
    const parts = { count, body: new Uint32Array(count), mesh: new Uint32Array(count), size: new Float32Array(3 * count),
      radius: new Float32Array(count), moved: new Uint8Array(count), position: new Float64Array(3 * count), turn: new Float64Array(4 * count),
      place: new Float32Array(3 * count), kind: new Int32Array(count), seen: new Uint8Array(count) };
    parts.groups = [];  // parts of a mesh stand side by side: [mesh, from, to]
    for (let from = 0, to = 0; from < count; from = to) {
      while (to < count && flat[to].mesh === flat[from].mesh) ++to;
      parts.groups.push([flat[from].mesh, from, to]);
    }
    this.bodyRadius = new Float32Array(scene.bodies.length);
    flat.forEach((part, i) => {
      const [x, y, z] = part.size;
      parts.body[i] = part.place;
      parts.mesh[i] = part.mesh;
      parts.size.set(part.size, 3 * i);
      parts.position.set(part.position, 3 * i);
      parts.turn.set(part.orientation, 4 * i);
      parts.moved[i] = part.position.some((v) => v !== 0) || part.orientation[3] !== 1 ? 1 : 0;
      parts.radius[i] = part.mesh === BOX ? Math.hypot(x, y, z) : part.mesh === SPHERE ? Math.max(x, y, z) : part.mesh === CAPSULE ? x + y
        : part.mesh === CYLINDER ? Math.hypot(x, y) : part.mesh === CONE ? Math.hypot(x, y) : scene.meshes[part.mesh - FIRST_MESH].radius;
      this.bodyRadius[part.place] = Math.max(this.bodyRadius[part.place], length(part.position) + parts.radius[i]);
    });
    this.parts = parts;
  }

  // Meshes of a scene that is over.
  forgetScene() {
    const { gl, levels } = this, [first] = levels[FIRST_MESH]?.[0]?.slice(1) ?? [this.drawn.length];
    for (const { array } of this.drawn.splice(first)) gl.deleteVertexArray(array);
    levels.length = Math.min(levels.length, FIRST_MESH);
    this.shapesOfMeshes = 0;
    this.sceneVersion = -1;
  }

  // Words for bodies, kept from frame to frame.
  room(count) {
    const { gl, instances } = this, rows = Math.max(1, Math.ceil(count / ROW));
    if (instances.rows < rows) {
      instances.rows = Math.ceil(rows * 1.25);
      if (instances.texture) gl.deleteTexture(instances.texture);
      instances.texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE2);
      gl.bindTexture(gl.TEXTURE_2D, instances.texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32UI, 3 * ROW, instances.rows);
      for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, gl.NEAREST);
      instances.words = new Uint32Array(instances.rows * ROW * WORDS);
      instances.floats = new Float32Array(instances.words.buffer);
      instances.shorts = new Int16Array(instances.words.buffer);
    }
    return instances;
  }

  // Sorts parts by what draws them, seen ones first, and writes their instances. `pose`: exists, position, orientation, color.
  collect(camera, view, pose) {
    const { parts, drawn, gl } = this, [ex, ey, ez] = camera.eye, parallel = camera.orthographic;
    const { back, sides } = view, fx = -back[0], fy = -back[1], fz = -back[2];
    for (const each of drawn) each.seen = each.total = 0;
    const { place, kind, seen, body, radius, moved, groups } = parts, { position, orientation, exists } = pose;
    this.tiny = this.levels[SPHERE][4][1];
    const { detail } = QUALITIES[this.quality], width = view.pixel / detail;
    const [[[ax, ay, az], aw], [[bx, by, bz], bw], [[cx, cy, cz], cw], [[dx, dy, dz], dw]] = sides;
    let total = 0;
    for (const [mesh, from, to] of groups) {
      const levels = this.levels[mesh].map(([least, chosen]) => [least, chosen < 0 ? this.tiny : chosen]), last = levels.length - 1;
      const least = Float64Array.from(levels, ([pixels]) => pixels), choices = Int32Array.from(levels, ([, chosen]) => chosen);
      const counts = new Int32Array(levels.length), visibles = new Int32Array(levels.length);
      for (let i = from; i < to; ++i) {
        const b = body[i], p = 3 * b;
        if (exists[b] === 0) {
          kind[i] = -1;
          continue;
        }
        let x = position[p] - ex, y = position[p + 1] - ey, z = position[p + 2] - ez;
        if (moved[i] === 1) {
          const at = rotated([orientation[4 * b], orientation[4 * b + 1], orientation[4 * b + 2], orientation[4 * b + 3]],
            [parts.position[3 * i], parts.position[3 * i + 1], parts.position[3 * i + 2]]);
          x += at[0];
          y += at[1];
          z += at[2];
        }
        const at = 3 * i, r = radius[i], ahead = fx * x + fy * y + fz * z;
        place[at] = x;
        place[at + 1] = y;
        place[at + 2] = z;
        const visible = (parallel || ahead > -r) && ax * x + ay * y + az * z + aw > -r && bx * x + by * y + bz * z + bw > -r
          && cx * x + cy * y + cz * z + cw > -r && dx * x + dy * y + dz * z + dw > -r;
        let level = 0;
        if (last > 0) {
          const pixels = r / (width * (parallel ? 1 : Math.max(ahead - r, 1e-3)));
          while (level < last && pixels < least[level]) ++level;
        }
        kind[i] = choices[level];
        seen[i] = visible ? 1 : 0;
        ++counts[level];
        if (visible) ++visibles[level];
      }
      for (let level = 0; level <= last; ++level) {
        drawn[choices[level]].total += counts[level];
        drawn[choices[level]].seen += visibles[level];
        total += counts[level];
      }
    }
    let first = 0;
    for (const each of drawn) {
      each.first = each.next = first;
      each.nextUnseen = first + each.seen;
      first += each.total;
    }
    const { floats, words, shorts, texture } = this.room(total), { size, mesh } = parts, { color } = pose, { tiny } = this;
    const nexts = Int32Array.from(drawn, ({ next }) => next), unseens = Int32Array.from(drawn, ({ nextUnseen }) => nextUnseen);
    for (let i = 0; i < parts.count; ++i) {
      const chosen = kind[i];
      if (chosen < 0) continue;
      const at = (seen[i] === 1 ? nexts[chosen]++ : unseens[chosen]++) * WORDS, b = body[i], from = 3 * i;
      floats[at] = place[from];
      floats[at + 1] = place[from + 1];
      floats[at + 2] = place[from + 2];
      words[at + 3] = color[b];
      let qx = orientation[4 * b], qy = orientation[4 * b + 1], qz = orientation[4 * b + 2], qw = orientation[4 * b + 3];
      if (moved[i] === 1) {
        const x = parts.turn[4 * i], y = parts.turn[4 * i + 1], z = parts.turn[4 * i + 2], w = parts.turn[4 * i + 3];
        const rx = qw * x + qx * w + qy * z - qz * y, ry = qw * y + qy * w + qz * x - qx * z, rz = qw * z + qz * w + qx * y - qy * x;
        qw = qw * w - qx * x - qy * y - qz * z;
        qx = rx;
        qy = ry;
        qz = rz;
      }
      const half = 2 * (at + 4);
      shorts[half] = 32767 * qx;
      shorts[half + 1] = 32767 * qy;
      shorts[half + 2] = 32767 * qz;
      shorts[half + 3] = 32767 * qw;
      if (chosen === tiny && mesh[i] !== SPHERE) {
        floats[at + 6] = floats[at + 7] = floats[at + 8] = 0.8 * radius[i];
      } else {
        floats[at + 6] = size[from];
        floats[at + 7] = size[from + 1];
        floats[at + 8] = size[from + 2];
      }
      words[at + 9] = b + 1;
    }
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const rows = Math.ceil(total / ROW);
    if (rows > 0) gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 3 * ROW, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
    gl.activeTexture(gl.TEXTURE0);
    this.total = total;
  }

  // Draws bodies: all of them, or those that are seen.
  drawBodies(pass, uniforms, seenAlone) {
    const { gl } = this;
    let last = null, program = null;
    for (const each of this.drawn) {
      const count = seenAlone ? each.seen : each.total;
      if (count === 0) continue;
      if (last !== each.shader) {
        program = this.program(`${each.shader} ${pass}`);
        this.set(program, uniforms);
        last = each.shader;
      }
      if (each.culls) gl.enable(gl.CULL_FACE); else gl.disable(gl.CULL_FACE);
      this.drawSome(program, each, each.first, count);
    }
    gl.disable(gl.CULL_FACE);
  }

  drawSome(program, each, first, count) {
    const { gl } = this, { together } = each;
    gl.uniform1i(program.places.bodies, 2);
    gl.uniform3i(program.places.batch, first, count, together);
    gl.bindVertexArray(each.array);
    gl.drawElementsInstanced(gl.TRIANGLES, each.indices * Math.min(together, count), each.type, 0, Math.ceil(count / together));
  }

  set(program, uniforms) {
    const { gl } = this, { places } = program;
    for (const [name, value] of Object.entries(uniforms)) {
      const place = places[name];
      if (place === undefined) continue;
      if (typeof value === 'number') {
        if (name.endsWith('_depths')) gl.uniform1i(place, value); else gl.uniform1f(place, value);
      } else if (value.length === 16) {
        gl.uniformMatrix4fv(place, false, value);
      } else {
        gl[`uniform${value.length}fv`](place, value);
      }
    }
  }

  map(name, size, compares) {
    const { gl } = this;
    let map = this.maps[name];
    if (map?.size === size) return map;
    if (map) gl.deleteTexture(map.texture);
    map = this.maps[name] = { size, texture: gl.createTexture(), frame: map?.frame ?? gl.createFramebuffer() };
    gl.bindTexture(gl.TEXTURE_2D, map.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    const filter = compares ? gl.LINEAR : gl.NEAREST;
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, filter], [gl.TEXTURE_MAG_FILTER, filter], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
      [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
    if (compares) {
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, map.texture, 0);
    gl.drawBuffers([gl.NONE]);
    gl.readBuffer(gl.NONE);
    return map;
  }

  // A box along a direction of light around what casts shadows and may be seen, from the eye.
  lightBox(toward, low, high) {
    const { right, up, back } = axesOf(toward), least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < 8; ++i) {
      const corner = [i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]];
      [right, up, back].forEach((axis, k) => {
        least[k] = Math.min(least[k], dot(axis, corner));
        most[k] = Math.max(most[k], dot(axis, corner));
      });
    }
    const size = least.map((x, k) => (most[k] - x) * 1.04 + 0.1), from = least.map((x, k) => x - 0.02 * (most[k] - x) - 0.05);
    return { right, up, back, size, from };
  }
  // To 0..1 in all axes, or to -1..1 as clip space has it.
  lightMatrix({ right, up, back, size, from }, clip) {
    const m = new Float32Array(16), f = clip ? 2 : 1, o = clip ? 1 : 0;
    for (let k = 0; k < 3; ++k) {
      m[4 * k] = f * right[k] / size[0];
      m[4 * k + 1] = f * up[k] / size[1];
      m[4 * k + 2] = -f * back[k] / size[2];
    }
    m[12] = -f * from[0] / size[0] - o;
    m[13] = -f * from[1] / size[1] - o;
    m[14] = f * (from[2] + size[2]) / size[2] - o;
    m[15] = 1;
    return m;
  }

  // The box about bodies that cast shadows into the picture, from the eye.
  shadowBox(camera) {
    const { parts } = this, reach = 3 * camera.distance, low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const target = sub(camera.target, camera.eye);
    for (let i = 0; i < parts.count; ++i) {
      if (parts.kind[i] < 0) continue;
      const r = parts.radius[i];
      for (let k = 0; k < 3; ++k) {
        const x = parts.place[3 * i + k];
        const a = Math.max(x - r, target[k] - reach), b = Math.min(x + r, target[k] + reach);
        if (a > b) continue;
        if (a < low[k]) low[k] = a;
        if (b > high[k]) high[k] = b;
      }
    }
    if (low.some((x, k) => !(x < high[k]))) return [[-1, -1, -1], [1, 1, 1]];
    return [low, high];
  }

  drawMap(name, size, box, toward, compares) {
    const { gl } = this, map = this.map(name, size, compares);
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.viewport(0, 0, size, size);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.drawBodies('depth', { view_projection: this.lightMatrix(box, true), light_view: toward, inflated: 0, forward: [0, 0, 0, 1] }, false);
    return map;
  }

  resize(ratio) {
    const { canvas } = this, scale = Math.min(ratio, QUALITIES[this.quality].ratio);
    const width = Math.max(1, Math.round(canvas.clientWidth * scale)), height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
  }

  // `pose`: of bodies, in metres of the world; `selected`: place of a body, or -1; `lines`, `joints`: Lines.
  draw(camera, scene, pose, selected, lines, joints, accent) {
    const { gl, canvas } = this, quality = QUALITIES[this.quality];
    if (gl.isContextLost()) return;
    this.takeScene(scene);
    this.resize(window.devicePixelRatio || 1);
    camera.width = canvas.width;
    camera.height = canvas.height;
    const view = camera.frame(), sky = SKIES[this.sky];
    this.collect(camera, view, pose);
    const sun = unit(this.sky === this.ownSky && this.sun ? this.sun : sky[6]);
    const [low, high] = this.shadowBox(camera);
    const sunBox = this.lightBox(sun, low, high), skyBox = this.lightBox([0, 1, 0], low, high);
    if (quality.sun) this.drawMap('sun', quality.sun, sunBox, sun, true); else this.map('sun', 4, true);
    if (quality.sky) this.drawMap('sky', quality.sky, skyBox, [0, 1, 0], false); else this.map('sky', 4, false);
    const sceneSize = length(sub(scene.head.high, scene.head.low));
    const uniforms = {
      ...this.viewUniforms(camera, view), light_view: [0, 0, 0], inflated: 0,
      ...this.lightUniforms({ sun, sky, sunBox, skyBox, quality, haze: Math.max(3.5 * camera.distance, 1.75 * sceneSize) }), sun_depths: 0, sky_depths: 1,
    };
    this.view = view;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.maps.sun.texture);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.maps.sky.texture);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.stencilMask(255);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    this.drawBodies('color', uniforms, true);
    this.drawPlanes(camera, scene, pose, uniforms);
    gl.bindVertexArray(this.empty);
    this.set(this.program('sky'), uniforms);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (selected >= 0) this.drawOutline(selected, uniforms, accent);
    this.drawLines(joints, uniforms, true);
    this.drawLines(lines, uniforms, false);
    gl.bindVertexArray(null);
  }
  // As shaders/render/frame.h has them. Beside a map is full light: without one all is beside it.
  lightUniforms({ sun, sky, sunBox, skyBox, quality, haze }) {
    const texel = (box, size) => Math.max(box.size[0], box.size[1]) / (size || 1), skyTexel = texel(skyBox, quality.sky);
    const light = { sun_map: this.lightMatrix(sunBox, false), sky_map: this.lightMatrix(skyBox, false), toward_sky: [0, 1, 0, 1], toward_sun: [...sun, 1],
      zenith: [...sky[1], sky[5]], horizon: [...sky[2], 0], sun_light: [...sky[0], 0], bounce: [...sky[3], 0], ambient: [...sky[4], 0],
      eye: [0, 0, 0, haze], maps: [texel(sunBox, quality.sun), skyTexel, 1 / (quality.sun || 1), 1 / (quality.sky || 1)],
      pixel: [0, skyBox.size[2], 10 * skyTexel, 0] };
    return Object.fromEntries(Object.entries(light).map(([name, value]) => [`frame.${name}`, value]));
  }
  viewUniforms(camera, view) {
    return { view_projection: view.matrix, forward: [...scaled(view.back, -1), camera.orthographic ? 1 : 0], ray_corner: [...view.corner, 0],
      ray_right: [...view.stepX, 0], ray_down: [...view.stepY, 0], eye: camera.eye, pixel: [view.pixel, view.near],
      screen: [camera.width, camera.height] };
  }

  drawPlanes(camera, scene, pose, uniforms) {
    const { gl } = this, program = this.program('plane');
    gl.bindVertexArray(this.empty);
    this.set(program, uniforms);
    scene.bodies.forEach((body, place) => {
      if (!body.plane || !pose.exists[place]) return;
      const n = body.plane.normal, height = dot(n, camera.eye) - body.plane.offset;
      if (height <= 0 && !camera.orthographic) return;  // unseen from behind
      const v = unit(Math.abs(n[2]) < 0.9 ? sub([0, 0, 1], scaled(n, n[2])) : sub([0, 1, 0], scaled(n, n[1])));
      const u = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
      // Grids repeat every ten metres: near numbers keep them sharp far from the origin.
      const near = (x) => x - 20 * Math.floor(x / 20);
      this.set(program, { plane: [...n, height], axis_u: u, axis_v: v, origin: [near(dot(u, camera.eye)), near(dot(v, camera.eye))] });
      gl.drawArrays(gl.TRIANGLES, 0, 12);
    });
  }

  // Instances of a body: [[geometry, index]].
  instancesOf(place) {
    const found = [], { words } = this.instances;
    for (const each of this.drawn)
      for (let i = each.first; i < each.first + each.total; ++i) if (words[i * WORDS + 9] === place + 1) found.push([each, i]);
    return found;
  }
  drawOutline(place, uniforms, accent) {
    const { gl, canvas } = this, instances = this.instancesOf(place);
    const drawAll = (inflated) => {
      for (const [each, index] of instances) {
        const program = this.program(`${each.shader} outline`);
        this.set(program, { ...uniforms, inflated, paint: accent });
        this.drawSome(program, each, index, 1);
      }
    };
    gl.enable(gl.STENCIL_TEST);
    gl.disable(gl.DEPTH_TEST);
    gl.colorMask(false, false, false, false);
    gl.stencilFunc(gl.ALWAYS, 1, 255);
    gl.stencilOp(gl.REPLACE, gl.REPLACE, gl.REPLACE);
    drawAll(0);
    gl.colorMask(true, true, true, true);
    gl.stencilFunc(gl.NOTEQUAL, 1, 255);
    drawAll(Math.max(1.5, 2.5 * canvas.width / canvas.clientWidth));
    gl.disable(gl.STENCIL_TEST);
    gl.enable(gl.DEPTH_TEST);
  }

  // `faintly`: also what bodies hide.
  drawLines({ data, count }, uniforms, faintly) {
    if (count === 0) return;
    const { gl, lines } = this;
    gl.bindVertexArray(lines.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, lines.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data.subarray(0, 12 * count), gl.STREAM_DRAW);
    this.set(this.program('line'), { ...uniforms, strength: 1 });
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    if (faintly) {
      this.set(this.program('line'), { strength: 0.3 });
      gl.depthFunc(gl.GREATER);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
      gl.depthFunc(gl.LEQUAL);
      this.set(this.program('line'), { strength: 1 });
    }
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }

  // The body at a pixel of the page from the canvas's upper left; -1: none. Of the moment that was drawn last.
  pick(camera, x, y) {
    const { gl, canvas } = this, size = 5;
    if (!this.parts || gl.isContextLost()) return -1;
    if (!this.pickTarget) {
      this.pickTarget = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
      for (const [format, attachment] of [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
        const buffer = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
        gl.renderbufferStorage(gl.RENDERBUFFER, format, size, size);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
      }
    }
    // A view of the few pixels around, in clip space.
    const px = x / canvas.clientWidth * canvas.width, py = (1 - y / canvas.clientHeight) * canvas.height;
    const sx = canvas.width / size, sy = canvas.height / size, m = Float32Array.from(this.view.matrix);
    const ox = sx * (1 - 2 * px / canvas.width), oy = sy * (1 - 2 * py / canvas.height);
    for (let k = 0; k < 4; ++k) {
      m[4 * k] = m[4 * k] * sx + m[4 * k + 3] * ox;
      m[4 * k + 1] = m[4 * k + 1] * sy + m[4 * k + 3] * oy;
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    gl.viewport(0, 0, size, size);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawBodies('id', { ...this.viewUniforms(camera, this.view), view_projection: m, light_view: [0, 0, 0], inflated: 0 }, true);
    const pixels = new Uint8Array(4 * size * size);
    gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindVertexArray(null);
    const at = (i) => (pixels[4 * i] | pixels[4 * i + 1] << 8 | pixels[4 * i + 2] << 16 | pixels[4 * i + 3] << 24) - 1;
    const middle = (size * size - 1) / 2;
    if (at(middle) >= 0) return at(middle);
    for (let i = 0; i < size * size; ++i) if (at(i) >= 0) return at(i);
    return -1;
  }
}

// Lines and discs of a picture.
export class Lines {
  constructor() {
    this.data = new Float32Array(12 * 256);
    this.count = 0;
  }
  clear() { this.count = 0; }
  // From and to from the eye, m; width in pixels; lift towards the eye, m; color linear with alpha.
  add(from, to, width, lift, color) {
    if (this.data.length < 12 * (this.count + 1)) {
      const larger = new Float32Array(2 * this.data.length);
      larger.set(this.data);
      this.data = larger;
    }
    const at = 12 * this.count++;
    this.data.set(from, at);
    this.data[at + 3] = width;
    this.data.set(to, at + 4);
    this.data[at + 7] = lift;
    this.data.set(color, at + 8);
  }
}


