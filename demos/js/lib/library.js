// Calls of the C interface: texts, records and arrays go into the module's memory and come out of it.

const kinds = ['', 'BAD_ARGUMENT', 'BAD_HANDLE', 'BAD_INDEX', 'BAD_SCENE', 'BAD_CHECKPOINT', 'FILE_ERROR', 'DEVICE_ERROR', 'NO_MEMORY',
  'BUSY', 'STOPPED', 'IMPOSSIBLE', 'VIEWED'];

export class ScreeError extends Error {
  constructor(message, kind, place) {
    super(message);
    this.name = 'ScreeError';
    this.kind = kind;
    this.place = place;
  }
}

const arrays = { f32: Float32Array, f64: Float64Array, i32: Int32Array, u32: Uint32Array, u8: Uint8Array, i64: BigInt64Array,
  u64: BigUint64Array };
const readers = { f32: 'getFloat32', f64: 'getFloat64', i32: 'getInt32', u32: 'getUint32', u8: 'getUint8', i64: 'getBigInt64',
  u64: 'getBigUint64' };
const writers = { f32: 'setFloat32', f64: 'setFloat64', i32: 'setInt32', u32: 'setUint32', u8: 'setUint8', i64: 'setBigInt64',
  u64: 'setBigUint64' };
const sizes = { f32: 4, f64: 8, i32: 4, u32: 4, u8: 1, i64: 8, u64: 8 };

export class Library {
  constructor(module, memory, threads) {
    this.module = module;
    this.memory = memory;
    this.threads = threads;
    this.layouts = JSON.parse(this.text(module._scree_js_layouts()));
  }

  // A call that may fail.
  call(name, ...given) {
    const result = this.module[`_scree_${name}`](...given);
    if (result === 0) return;
    const message = this.text(this.module._scree_error_message());
    throw new ScreeError(message, kinds[result] ?? `kind ${result}`, this.text(this.module._scree_error_place()));
  }
  // Calls work(room), whose memory is given back afterwards.
  within(work) {
    const room = new Room(this);
    try {
      return work(room);
    } finally {
      for (const place of room.places) this.module._free(place);
    }
  }

  // Memory moves when it grows: what looks at it is asked for anew.
  get data() {
    if (this.seen?.buffer !== this.memory.buffer) this.seen = new DataView(this.memory.buffer);
    return this.seen;
  }
  look(kind, at, count) {
    return new arrays[kind](this.memory.buffer, at >>> 0, count);
  }
  copy(kind, at, count) {
    return this.look(kind, at, count).slice();
  }
  // A null pointer is an empty text.
  text(at) {
    if (!at) return '';
    const bytes = new Uint8Array(this.memory.buffer);
    const begin = at >>> 0;
    return new TextDecoder().decode(bytes.slice(begin, bytes.indexOf(0, begin)));
  }
  pointer(at) {
    return this.data.getUint32(at, true);
  }

  // A struct in memory as an object. 64-bit whole numbers become numbers.
  read(name, at) {
    const value = {};
    for (const [member, [offset, kind, count]] of Object.entries(this.layouts[name].members)) {
      const one = (k) => {
        const number = this.data[readers[kind]](at + offset + k * sizes[kind], true);
        return typeof number === 'bigint' ? Number(number) : number;
      };
      value[member] = count === 0 ? one(0) : Array.from({ length: count }, (_, k) => one(k));
    }
    return value;
  }
  write(name, at, value) {
    for (const key of Object.keys(value))
      if (!(key in this.layouts[name].members)) throw new TypeError(`${key}: unknown; known: ${Object.keys(this.layouts[name].members).join(', ')}`);
    for (const [member, [offset, kind, count]] of Object.entries(this.layouts[name].members)) {
      const given = value[member];
      if (given === undefined) continue;
      if (count !== 0 && given.length !== count) throw new RangeError(`${member}: has ${given.length} numbers, not ${count}`);
      for (let k = 0; k < Math.max(1, count); ++k) {
        const number = Number(count === 0 ? given : given[k]);
        this.data[writers[kind]](at + offset + k * sizes[kind], kind.endsWith('64') && kind[0] !== 'f' ? BigInt(number) : number, true);
      }
    }
  }
}

// Memory for one call.
class Room {
  constructor(library) {
    this.library = library;
    this.places = [];
  }
  take(bytes) {
    const place = this.library.module._malloc(Math.max(bytes, 8)) >>> 0;
    if (place === 0) throw new ScreeError(`no memory for ${bytes} bytes`, 'NO_MEMORY', '');
    this.places.push(place);
    new Uint8Array(this.library.memory.buffer, place, Math.max(bytes, 8)).fill(0);
    return place;
  }
  // null and undefined: a null pointer.
  text(words) {
    if (words === null || words === undefined) return 0;
    const bytes = new TextEncoder().encode(`${words}\0`);
    const at = this.take(bytes.length);
    this.library.look('u8', at, bytes.length).set(bytes);
    return at;
  }
  // undefined: a null pointer.
  json(value) {
    return value === undefined ? 0 : this.text(JSON.stringify(value));
  }
  numbers(kind, values) {
    const at = this.take(sizes[kind] * values.length);
    const into = this.library.look(kind, at, values.length);
    if (kind.endsWith('64') && kind[0] !== 'f') for (let i = 0; i < values.length; ++i) into[i] = BigInt(values[i]);
    else into.set(values);
    return at;
  }
  vector(values, name) {
    if (values?.length !== 3) throw new RangeError(`${name}: needs three numbers`);
    return this.numbers('f32', values);
  }
  // Structs that begin with their size.
  options(name, value) {
    const layout = this.library.layouts[name];
    const at = this.take(layout.size);
    this.library.write(name, at, { ...value, size: layout.size });
    return at;
  }
  records(name, values) {
    const size = this.library.layouts[name].size;
    const at = this.take(size * values.length);
    values.forEach((value, i) => this.library.write(name, at + i * size, value));
    return { at, size, count: values.length };
  }
  // Columns of floats by name, with `rows` rows each: arrays of rows, or flat arrays of numbers.
  columns(values, rows) {
    const names = Object.keys(values);
    const size = this.library.layouts.scree_column.size;
    const at = this.take(size * names.length);
    names.forEach((name, i) => {
      const given = values[name];
      const flat = typeof given === 'number' ? new Float32Array(rows).fill(given) : ArrayBuffer.isView(given) ? given : given.flat();
      if (rows > 0 && flat.length % rows !== 0) throw new RangeError(`${name}: ${flat.length} numbers for ${rows} rows`);
      const data = this.numbers('f32', flat);
      const stride = rows > 0 ? (4 * flat.length) / rows : 0;
      this.library.write('scree_column', at + i * size, { name: this.text(name), data, stride });
    });
    return { at, count: names.length };
  }
  // What a call gives: a scree_array, a number, a text, a handle.
  array() {
    const at = this.take(this.library.layouts.scree_array.size);
    return {
      at,
      raw: () => this.library.read('scree_array', at),
      copy: (kind, perRow = 1) => {
        const { data, count } = this.library.read('scree_array', at);
        return this.library.copy(kind, data, count * perRow);
      },
      records: (name) => {
        const { data, count, stride } = this.library.read('scree_array', at);
        return Array.from({ length: count }, (_, i) => this.library.read(name, data + i * stride));
      },
    };
  }
  word() {
    const at = this.take(8);
    return {
      at,
      get: () => this.library.pointer(at),
      text: () => this.library.text(this.library.pointer(at)),
      json: () => JSON.parse(this.library.text(this.library.pointer(at))),
      hash: () => this.library.data.getBigUint64(at, true).toString(16).padStart(16, '0'),
    };
  }
}

// An object of the library, released by dispose(), at the latest when nothing refers to it any more.
const forgotten = new FinalizationRegistry(({ library, release, handle }) => library.module[release](handle));

export class Held {
  constructor(library, kind, handle) {
    this.library = library;
    this.kind = kind;
    this.address = handle;
    forgotten.register(this, { library, release: `_scree_${kind}_release`, handle }, this);
  }
  get handle() {
    if (this.address === 0) throw new ScreeError(`the ${this.kind} was disposed of`, 'BAD_HANDLE', '');
    return this.address;
  }
  // May be called again.
  dispose() {
    if (this.address === 0) return;
    forgotten.unregister(this);
    this.library.module[`_scree_${this.kind}_release`](this.address);
    this.address = 0;
  }
}
