// Worlds: a scene that is run.
import { Held } from './library.js';
import { addBodies } from './world_bodies.js';
import { addJoints } from './world_joints.js';
import { addQueries } from './world_queries.js';
import { addRecordings } from './world_recordings.js';

export function worldClass(library, Scene) {
  class World extends Held {
    // settings: over those of the scene. copies: of the scene, which do not meet. threads: at most those that scree was loaded with.
    constructor(scene, { settings, copies = 0, threads = library.threads } = {}) {
      if (!(scene instanceof Scene)) throw new TypeError('World: needs a Scene');
      super(library, 'world', library.within((room) => {
        const options = room.options('scree_world_options',
          { backend: room.text('cpu'), settings_json: room.json(settings), threads: Math.max(1, Math.min(threads, library.threads)), copies });
        const handle = room.word();
        library.call('world_create', scene.handle, options, handle.at);
        return handle.get();
      }));
    }
    step(count = 1) {
      library.call('world_step', this.handle, BigInt(count), 0, 0);
    }
    // Later steps perform what the program does in a run of this demo and is no part of its scene: the bodies of fountain are born and
    // go. Undefined: nothing any more. Views are to be disposed before each step.
    followDemo(name, { bodies = 0, seed = 1 } = {}) {
      library.within((room) => library.call('world_follow_demo', this.handle, name === undefined ? 0 : room.text(name), bodies, BigInt(seed)));
    }
    // steps, time (s), bodies, ...
    info() {
      return library.within((room) => {
        const at = room.options('scree_world_info', {});
        library.call('world_get_info', this.handle, at);
        const { size, device, buffer_bytes, records_events, bodies_there, ...info } = library.read('scree_world_info', at);
        return { ...info, bodiesThere: bodies_there, bufferBytes: buffer_bytes, recordsEvents: records_events !== 0 };
      });
    }
    get steps() {
      return this.info().steps;
    }
    get time() {
      return this.info().time;
    }
    // Equal exactly where positions, orientations and velocities are, bit for bit: 16 hexadecimal digits.
    hash() {
      return library.within((room) => {
        const hash = room.word();
        library.call('world_hash', this.handle, hash.at);
        return hash.hash();
      });
    }
    copyHashes() {
      return this.array('copy_hashes', (array) => Array.from(array.copy('u64'), (hash) => hash.toString(16).padStart(16, '0')));
    }
    statistics(copy = 0) {
      return library.within((room) => {
        const at = room.options('scree_statistics', {});
        library.call('world_statistics', this.handle, copy, at);
        const { size, ...statistics } = library.read('scree_statistics', at);
        return statistics;
      });
    }
    // list: bodies, bodies_there, joints, vehicles, copies.
    count(list) {
      return library.within((room) => {
        const count = room.word();
        library.call('world_count', this.handle, room.text(list), count.at);
        return count.get();
      });
    }
    // key: settings, stage_times, bodies or joints (names).
    get(key) {
      return library.within((room) => {
        const json = room.word();
        library.call('world_get', this.handle, room.text(key), json.at);
        return json.json();
      });
    }
    // what: fields, friction_factor, least_restitution, substeps, sleeping, profiling.
    set(what, value) {
      library.within((room) => library.call('world_set', this.handle, room.text(what), room.json(value)));
    }
    // Index of a body, joint or vehicle; -1: none of that name.
    find(list, name) {
      return library.within((room) => {
        const found = room.array();
        library.call('world_find', this.handle, room.text(list), room.text(name), found.at);
        const indices = found.copy('u64');
        if (indices.length > 1) throw new RangeError(`${list}: several are named "${name}"`);
        return indices.length === 0 ? -1 : Number(indices[0]);
      });
    }

    // The state in bytes, which restore() takes in a world of the same scene.
    save() {
      return this.array('save', (array) => array.copy('u8'));
    }
    restore(bytes) {
      library.within((room) => library.call('world_restore', this.handle, room.numbers('u8', bytes), bytes.length));
    }
    keepState() {
      library.call('world_keep_state', this.handle);
    }
    // Back by so many steps, to a kept state.
    rollBack(steps) {
      library.call('world_roll_back', this.handle, BigInt(steps));
    }
    keptStates() {
      return this.array('kept_states', (array) => Array.from(array.copy('u64'), Number));
    }
    dropStates() {
      library.call('world_drop_states', this.handle);
    }
    // The scene as it is now.
    snapshot(copy = 0) {
      return library.within((room) => {
        const handle = room.word();
        library.call('world_snapshot', this.handle, copy, handle.at);
        return new Scene(handle.get());
      });
    }

    // Copies (by a list of their numbers) back to the start.
    reset(copies = Array.from({ length: this.count('copies') }, (_, copy) => copy)) {
      const chosen = new Uint8Array(this.count('copies'));
      for (const copy of copies) {
        if (!(copy in chosen)) throw new RangeError(`copies: there is no copy ${copy}`);
        chosen[copy] = 1;
      }
      library.within((room) => library.call('world_reset', this.handle, room.numbers('u8', chosen), chosen.length));
    }
    gravity(copy = 0) {
      return library.within((room) => {
        const at = room.take(12);
        library.call('world_gravity', this.handle, copy, at);
        return library.copy('f32', at, 3);
      });
    }
    setGravity(gravity, copy = 0xffffffff) {
      library.within((room) => library.call('world_set_gravity', this.handle, copy, room.vector(gravity, 'gravity')));
    }

    // What a call without further arguments gives as an array.
    array(name, take) {
      return library.within((room) => {
        const array = room.array();
        library.call(`world_${name}`, this.handle, array.at);
        return take(array);
      });
    }
  }
  addBodies(World, library, Scene);
  addJoints(World, library);
  addQueries(World, library);
  addRecordings(World, library);
  return World;
}
