// Queries in worlds, in batches, and lines and points to draw them.
const everything = { mask: 0xffffffff, copy: 0 };
const upright = { orientation: [0, 0, 0, 1] };

export function addQueries(World, library) {
  const size = (name) => library.layouts[name].size;
  const hit = (record) => (record.body < 0 ? null : record);
  // Lists of results of each, from starts and one array of all.
  const split = (room, count, name, call) => {
    const starts = room.take(8 * (count + 1));
    const all = room.array();
    call(starts, all.at);
    const records = all.records(name);
    const at = Array.from(library.look('u64', starts, count + 1), Number);
    return Array.from({ length: count }, (_, i) => records.slice(at[i], at[i + 1]));
  };
  // The nearest of each, null: none.
  const nearest = (room, given, call) => {
    const each = size('scree_hit');
    const hits = room.take(each * given.count);
    call(given.at, given.count, given.size, hits, each);
    return Array.from({ length: given.count }, (_, i) => hit(library.read('scree_hit', hits + i * each)));
  };
  const rays = (room, list) =>
    room.records('scree_ray', list.map((ray) => ({ reach: Infinity, solid: 1, ...everything, ...ray, along: unit(ray.along) })));
  const unit = (along) => {
    const length = Math.hypot(...along);
    return length > 0 ? along.map((number) => number / length) : along;
  };

  Object.assign(World.prototype, {
    // Each { from, along, reach?, mask?, solid?, copy? }.
    castRays(list) {
      return library.within((room) => nearest(room, rays(room, list), (...given) => library.call('world_cast_rays', this.handle, ...given)));
    },
    raysHit(list) {
      return library.within((room) => {
        const given = rays(room, list);
        const hits = room.take(given.count);
        library.call('world_rays_hit', this.handle, given.at, given.count, given.size, hits);
        return Array.from(library.look('u8', hits, given.count), (byte) => byte !== 0);
      });
    },
    castRaysThrough(list) {
      return library.within((room) => {
        const given = rays(room, list);
        return split(room, given.count, 'scree_hit', (starts, hits) =>
          library.call('world_cast_rays_through', this.handle, given.at, given.count, given.size, starts, hits));
      });
    },
    // Each { from, along, reach, orientation?, mask?, solid?, copy?, ignored? }.
    castShapes(shape, casts) {
      return library.within((room) => {
        const given = room.records('scree_cast',
          casts.map((cast) => ({ solid: 1, ignored: -1, ...upright, ...everything, ...cast, along: unit(cast.along) })));
        return nearest(room, given, (...rest) => library.call('world_cast_shapes', this.handle, room.json(shape), ...rest));
      });
    },
    // Each { point, reach, mask?, copy? }.
    closestPoints(points) {
      return library.within((room) => nearest(room, room.records('scree_point', points.map((point) => ({ ...everything, ...point }))),
        (...given) => library.call('world_closest_points', this.handle, ...given)));
    },
    debugDrawing(options = undefined) {
      return library.within((room) => {
        const chosen = options?.bodies;
        const given = options ? { ...options } : undefined;
        if (chosen) Object.assign(given, { bodies: room.numbers('i64', chosen), body_count: chosen.length });
        const lines = room.array();
        const dots = room.array();
        library.call('world_debug_drawing', this.handle, given ? room.options('scree_debug_options', given) : 0, lines.at, dots.at);
        // 9 and 6 numbers each: ends and colour, place and colour.
        return { lines: lines.copy('f32', 9), points: dots.copy('f32', 6) };
      });
    },
  });
  // Each { position, orientation?, mask?, ignored?, copy? }.
  for (const [method, record] of Object.entries({ overlaps: 'scree_part', penetrations: 'scree_depth' }))
    World.prototype[method] = function (shape, placed) {
      return library.within((room) => {
        const given = room.records('scree_placed', placed.map((one) => ({ ignored: -1, ...upright, ...everything, ...one })));
        return split(room, given.count, record, (starts, found) =>
          library.call(`world_${method}`, this.handle, room.json(shape), given.at, given.count, given.size, starts, found));
      });
    };
}
