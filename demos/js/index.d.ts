// scree in WebAssembly. Units are SI; quaternions are x, y, z, w. Descriptions have the keys of scene files.

export type Vector = [number, number, number] | number[] | Float32Array;
export type Json = unknown;
// Rows for the bodies or joints of a call: a number for all, one array of all numbers, or an array for each.
export type Columns = Record<string, number | number[] | number[][] | Float32Array>;
// 16 hexadecimal digits.
export type Hash = string;

export class ScreeError extends Error {
  kind: 'BAD_ARGUMENT' | 'BAD_HANDLE' | 'BAD_INDEX' | 'BAD_SCENE' | 'BAD_CHECKPOINT' | 'FILE_ERROR' | 'DEVICE_ERROR' | 'NO_MEMORY' |
    'BUSY' | 'STOPPED' | 'IMPOSSIBLE' | 'VIEWED';
  place: string; // of a scene: a JSON pointer, or ''
}

export interface LoadOptions {
  threads?: number; // of a loop, 1 to 64; 1, the default: the form without threads
  print?: (line: string) => void; // what command() writes; the console by default
  printError?: (line: string) => void;
  folder?: string; // URL of the folder module/, where it is not beside lib/
}
export function load(options?: LoadOptions): Promise<Scree>;

export interface Scree {
  Scene: SceneClass;
  World: WorldClass;
  version: string;
  threads: number;
  files: any; // emscripten's file system, for command()
  describe(what: 'schema' | 'settings' | 'demos' | 'keys', name?: string): Json;
  command(words: string[]): number;
  massProperties(body: Json, density: number): { mass: number; inertia: Float32Array };
}

export interface SceneClass {
  new (): Scene;
  demo(name: string, options?: { bodies?: number; seed?: number }): Scene;
  fromJSON(scene: string | object): Scene;
  fromFiles(files: Record<string, string | Uint8Array>, name: string, options?: {
    strict?: 0 | 1; fileAxes?: 0 | 1; ground?: 0 | 1; base?: 'fixed' | 'free'; keyframe?: string; packages?: Record<string, string>;
  }): Scene;
}
export interface Scene {
  addBodies(body: Json, count?: number, columns?: Columns): number;
  add(list: 'joints' | 'vehicles' | 'events' | 'grains' | 'exclusions' | 'cars' | 'carts', item: Json): number;
  set(key: 'settings' | 'picture' | 'camera' | 'fields' | 'periodic' | 'gravity' | 'duration', value: Json): void;
  get(key: string): any;
  count(list: 'bodies' | 'joints' | 'vehicles' | 'events'): number;
  find(list: 'bodies' | 'joints' | 'vehicles', name: string): number;
  check(): string[];
  hash(): Hash;
  copy(): Scene;
  toJSON(): any;
  dispose(): void;
}

export interface WorldClass {
  new (scene: Scene, options?: { settings?: Json; copies?: number; threads?: number }): World;
}
export interface World {
  readonly steps: number;
  readonly time: number; // s
  step(count?: number): void;
  followDemo(name?: string, options?: { bodies?: number; seed?: number | bigint }): void;
  info(): { steps: number; time: number; bodies: number; bodiesThere: number; joints: number; copies: number; bufferBytes: number;
    recordsEvents: boolean };
  hash(): Hash;
  copyHashes(): Hash[];
  statistics(copy?: number): Record<string, number> & { momentum: number[]; angular_momentum: number[] };
  count(list: 'bodies' | 'bodies_there' | 'joints' | 'vehicles' | 'copies'): number;
  get(key: 'settings' | 'stage_times' | 'bodies' | 'joints'): any;
  set(what: 'fields' | 'friction_factor' | 'least_restitution' | 'substeps' | 'cell_rate' | 'sleeping' | 'profiling', value: Json): void;
  find(list: 'bodies' | 'joints', name: string): number;
  dispose(): void;

  save(): Uint8Array;
  restore(bytes: Uint8Array): void;
  keepState(): void;
  rollBack(steps: number): void;
  keptStates(): number[];
  dropStates(): void;
  snapshot(copy?: number): Scene;
  reset(copies?: number[]): void;
  gravity(copy?: number): Float32Array; // m/s^2
  setGravity(gravity: Vector, copy?: number): void;

  read(names?: StateName[]): State;
  readOf(bodies: number | number[], names?: (StateName | 'origin_position' | 'origin_orientation' | 'touch_force')[]): State;
  view(name: 'poses' | 'velocities'): View<Float32Array>;
  view(name: 'ids'): View<Uint32Array>;
  write(bodies: number | number[], columns: Columns): void;
  apply(bodies: number | number[], columns: Columns): void;
  move(bodies: number | number[], columns: Columns, steps: number): void;
  wake(bodies: number | number[]): void;
  addBodies(scene: Scene): Body[];
  removeBodies(bodies: Body | Body[]): void;
  bodies(indices: number | number[]): Body[];
  areValid(bodies: Body | Body[]): boolean[];
  setMaterial(bodies: number | number[], material: Json): void;
  setBody(body: number, what: 'mass' | 'filter' | 'motion', value: Json): void;
  setExclusion(a: number, b: number, excluded: boolean): void;
  explode(centre: Vector, radius: number, speed: number): void;
  grip(body: number, anchor: Vector, target: Vector,
       options?: { hertz?: number; damping_ratio?: number; max_acceleration?: number; spin_damping?: number }): number;
  moveGrip(grip: number, target: Vector): void;
  releaseGrip(grip: number): void;
  contacts(): Contact[];
  setEvents(options: { contacts?: 0 | 1; hit_speed?: number; breaks?: 0 | 1; sleep?: 0 | 1; sensors?: 0 | 1 }): void;
  takeEvents(): ScreeEvent[];
  sensed(): { sensor: number; body: number; sensor_part: number; part: number }[];

  // axis: 0 to 5, along x, y, z, then about; -1, the default: along or about which each joint moves.
  joints(): JointState[];
  drives(axis?: number): Record<string, number | boolean>[];
  setDrives(joints: number | number[], columns: Columns, axis?: number): void;
  setMotors(joints: number | number[], columns: Columns, axis?: number): void;
  setSprings(joints: number | number[], spring: Json, axis?: number): void;
  setJointCoordinates(joints: number | number[], columns: Columns, axis?: number): void;
  applyJointForces(joints: number | number[], columns: Columns, axis?: number): void;
  addJoint(joint: Json, anchor?: Vector, axis?: Vector): number;
  removeJoint(joint: number): void;
  vehicles(): Record<string, number | boolean>[];
  drive(vehicle: number, controls?: { throttle?: number; brake?: number; steer?: number; handBrake?: number }): void;
  driveByRoute(vehicle: number): void;
  resetUpright(vehicle: number): void;

  castRays(rays: Ray[]): (Hit | null)[];
  raysHit(rays: Ray[]): boolean[];
  castRaysThrough(rays: Ray[]): Hit[][];
  castShapes(shape: Json, casts: (Ray & { reach: number; orientation?: number[]; ignored?: number })[]): (Hit | null)[];
  overlaps(shape: Json, placed: Placed[]): { body: number; part: number }[][];
  penetrations(shape: Json, placed: Placed[]): { body: number; part: number; depth: number; normal: number[] }[][];
  closestPoints(points: { point: Vector; reach: number; mask?: number; copy?: number }[]): (Hit | null)[];
  debugDrawing(options?: { shapes?: 0 | 1; contacts?: 0 | 1; joints?: 0 | 1; boxes?: 0 | 1; segments?: number; line_length?: number;
    force_length?: number; bodies?: number[] }): { lines: Float32Array; points: Float32Array };
  // Of the steps from now on. fps: frames a second of time; live: keeps no frames, for take().
  record(options?: { title?: string; camera?: Json; look?: Json; fps?: number; contacts?: -1 | 0 | 1; events?: 0 | 1; live?: 0 | 1;
    copy?: number }): Recording;
}

export interface Recording {
  count(): number; // frames
  page(): string; // HTML that plays them, so far
  take(frame?: boolean): Uint8Array; // of a live one: chunks of demos/docs/guide/viewer.md
  stop(): void;
  dispose(): void;
}

export type StateName = 'position' | 'orientation' | 'velocity' | 'angular_velocity' | 'mass' | 'asleep' | 'exists';
export type State = Record<string, Float32Array | Uint8Array> & { position: Float32Array; orientation: Float32Array };
// While a view is held, bodies are neither added nor removed. data: asked for anew after each step, for memory may have grown.
export interface View<Rows> {
  readonly data: Rows;
  count: number;
  stride: number; // numbers from row to row
  dispose(): void;
}
export interface Body {
  index: number;
  generation: number;
}
export interface Contact {
  a: number;
  b: number;
  part_a: number;
  part_b: number;
  normal: number[]; // from a to b
  friction: number[]; // on b, N
  count: number; // points, 1 to 4
  position: number[][]; // m
  separation: number[]; // m, below 0: overlap
  force: number[]; // N
}
export interface ScreeEvent {
  kind: 'begin' | 'end' | 'hit' | 'body_broke' | 'joint_broke' | 'fell_asleep' | 'woke' | 'sensor_begin' | 'sensor_end' | 'bond_broke';
  step: number;
  a: number;
  a_generation: number;
  b: number;
  b_generation: number;
  part_a: number;
  part_b: number;
  joint: number;
  speed: number; // m/s
  impulse: number; // N s
  point: number[];
  normal: number[];
}
export interface JointState {
  force: number[]; // N
  torque: number[]; // N m
  max_force: number;
  max_torque: number;
  gap: number; // m
  coordinates: number[]; // m, m, m, rad, rad, rad
  rates: number[];
  broken: boolean;
  axis: number;
}
export interface Ray {
  from: Vector;
  along: Vector; // of any length above 0
  reach?: number; // m; Infinity by default
  mask?: number;
  solid?: 0 | 1;
  copy?: number;
}
export interface Hit {
  body: number;
  part: number;
  distance: number; // m
  point: number[];
  normal: number[];
}
export interface Placed {
  position: Vector;
  orientation?: number[];
  mask?: number;
  ignored?: number;
  copy?: number;
}
