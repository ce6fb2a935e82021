// Bodies of worlds: their state, what acts on them, contacts and events.
const columns = { position: 3, orientation: 4, velocity: 3, angular_velocity: 3, mass: 1, asleep: 1, exists: 1,
  origin_position: 3, origin_orientation: 4, touch_force: 3 };
const views = { poses: ['f32'], velocities: ['f32'], ids: ['u32'] };
const eventKinds = ['begin', 'end', 'hit', 'body_broke', 'joint_broke', 'fell_asleep', 'woke', 'sensor_begin', 'sensor_end', 'bond_broke'];

// A table of the world without a copy: rows in an order of the world's own. While it is held, bodies cannot be added or removed.
class View {
  constructor(library, handle, { data, count, stride }, kind) {
    Object.assign(this, { library, handle, at: data, kind, count, stride: stride / 4 });
  }
  // A typed array on the world's memory, with `stride` numbers for each of `count` rows. Ask again after each step: memory may
  // have grown, and old arrays then are empty.
  get data() {
    if (this.handle === 0) throw new Error('the view was disposed of');
    return this.library.look(this.kind, this.at, this.count * this.stride);
  }
  dispose() {
    if (this.handle !== 0) this.library.module._scree_view_release(this.handle);
    this.handle = 0;
  }
}

export function addBodies(World, library, Scene) {
  // Arrays that a call writes, by name.
  const written = (room, names, rows, call) => {
    const size = library.layouts.scree_output.size;
    const at = room.take(size * names.length);
    const places = names.map((name, i) => {
      if (!(name in columns)) throw new TypeError(`"${name}": unknown; known: ${Object.keys(columns).join(', ')}`);
      const kind = name === 'asleep' || name === 'exists' ? 'u8' : 'f32';
      const data = room.take(4 * columns[name] * rows);
      library.write('scree_output', at + i * size, { name: room.text(name), data });
      return { kind, data, length: columns[name] * rows };
    });
    call(at, names.length);
    return Object.fromEntries(names.map((name, i) => [name, library.copy(places[i].kind, places[i].data, places[i].length)]));
  };
  const indices = (room, bodies) => {
    const list = typeof bodies === 'number' ? [bodies] : bodies;
    return { at: room.numbers('i64', list), count: list.length };
  };
  const records = (room, bodies) => room.records('scree_body', Array.isArray(bodies) ? bodies : [bodies]);

  Object.assign(World.prototype, {
    // Typed arrays by name, of all bodies: position, orientation, velocity, angular_velocity, mass, asleep, exists.
    read(names = ['position', 'orientation']) {
      const rows = this.count('bodies');
      return library.within((room) =>
        written(room, names, rows, (at, count) => library.call('world_read', this.handle, at, count, rows)));
    },
    // Of some bodies; also origin_position, origin_orientation (of authored frames), touch_force (N).
    readOf(bodies, names = ['position', 'orientation']) {
      return library.within((room) => {
        const of = indices(room, bodies);
        return written(room, names, of.count, (at, count) =>
          library.call('world_read_of', this.handle, of.at, of.count, at, count));
      });
    },
    // name: poses (position at 0, orientation at 4), velocities (linear at 0, angular at 4), ids (the body of each row).
    view(name) {
      if (!(name in views)) throw new TypeError(`"${name}": unknown; known: ${Object.keys(views).join(', ')}`);
      return library.within((room) => {
        const handle = room.word();
        const rows = room.array();
        library.call('world_view', this.handle, room.text(name), handle.at, rows.at);
        return new View(library, handle.get(), rows.raw(), views[name][0]);
      });
    },
    move(bodies, given, steps) {
      library.within((room) => {
        const of = indices(room, bodies);
        const { at, count } = room.columns(given, of.count);
        library.call('world_move', this.handle, of.at, of.count, at, count, steps);
      });
    },
    wake(bodies) {
      library.within((room) => {
        const of = indices(room, bodies);
        library.call('world_wake', this.handle, of.at, of.count);
      });
    },
    // The bodies of a scene: { index, generation } of each.
    addBodies(scene) {
      if (!(scene instanceof Scene)) throw new TypeError('addBodies: needs a Scene');
      return library.within((room) => {
        const added = room.array();
        library.call('world_add_bodies', this.handle, scene.handle, added.at);
        return added.records('scree_body');
      });
    },
    removeBodies(bodies) {
      library.within((room) => {
        const { at, count } = records(room, bodies);
        library.call('world_remove_bodies', this.handle, at, count);
      });
    },
    bodies(of) {
      return library.within((room) => {
        const chosen = indices(room, of);
        const size = library.layouts.scree_body.size;
        const at = room.take(size * chosen.count);
        library.call('world_bodies', this.handle, chosen.at, chosen.count, at);
        return Array.from({ length: chosen.count }, (_, i) => library.read('scree_body', at + i * size));
      });
    },
    areValid(bodies) {
      return library.within((room) => {
        const { at, count } = records(room, bodies);
        const valid = room.take(count);
        library.call('world_are_valid', this.handle, at, count, valid);
        return Array.from(library.look('u8', valid, count), (byte) => byte !== 0);
      });
    },
    setMaterial(bodies, material) {
      library.within((room) => {
        const of = indices(room, bodies);
        library.call('world_set_material', this.handle, of.at, of.count, room.json(material));
      });
    },
    // what: mass, filter, motion.
    setBody(body, what, value) {
      library.within((room) => library.call('world_set_body', this.handle, body, room.text(what), room.json(value)));
    },
    setExclusion(a, b, excluded) {
      library.call('world_set_exclusion', this.handle, a, b, excluded ? 1 : 0);
    },
    explode(centre, radius, speed) {
      library.within((room) => library.call('world_explode', this.handle, room.vector(centre, 'centre'), radius, speed));
    },
    // A spring that holds a point of a body, four at a time. Returns its number.
    grip(body, anchor, target, options = {}) {
      return library.within((room) => {
        const grip = room.word();
        library.call('world_grip', this.handle, body, room.vector(anchor, 'anchor'), room.vector(target, 'target'),
          room.options('scree_grip_options', options), grip.at);
        return grip.get();
      });
    },
    moveGrip(grip, target) {
      library.within((room) => library.call('world_move_grip', this.handle, grip, room.vector(target, 'target')));
    },
    releaseGrip(grip) {
      library.call('world_release_grip', this.handle, grip);
    },

    // Of the last step. position, separation and force have `count` points.
    contacts() {
      return this.array('contacts', (array) => array.records('scree_contact').map((contact) => ({
        ...contact,
        position: Array.from({ length: contact.count }, (_, k) => contact.position.slice(3 * k, 3 * k + 3)),
        separation: contact.separation.slice(0, contact.count),
        force: contact.force.slice(0, contact.count),
      })));
    },
    // Which events are recorded: { contacts, hit_speed, breaks, sleep, sensors }.
    setEvents(options) {
      library.within((room) => library.call('world_set_events', this.handle, room.options('scree_event_options', options)));
    },
    // Since they were taken last.
    takeEvents() {
      return this.array('take_events', (array) =>
        array.records('scree_event').map((event) => ({ ...event, kind: eventKinds[event.kind] })));
    },
    sensed() {
      return this.array('sensed', (array) => array.records('scree_sensed'));
    },
  });
  // Columns by name: write sets position, orientation, velocity, angular_velocity; apply acts by force, torque, impulse,
  // angular_impulse, offset.
  for (const name of ['write', 'apply'])
    World.prototype[name] = function (bodies, given) {
      library.within((room) => {
        const of = indices(room, bodies);
        const { at, count } = room.columns(given, of.count);
        library.call(`world_${name}`, this.handle, of.at, of.count, at, count);
      });
    };
}
