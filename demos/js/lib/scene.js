// Scenes: descriptions of bodies, joints, vehicles, and how they are run.
import { Held } from './library.js';

export function sceneClass(library) {
  const made = (room, name, ...given) => {
    const handle = room.word();
    library.call(name, ...given, handle.at);
    return new Scene(handle.get());
  };

  class Scene extends Held {
    // Empty; Scene.demo() and the like give others.
    constructor(handle = undefined) {
      super(library, 'scene', handle ?? library.within((room) => {
        const empty = room.word();
        library.call('scene_create', empty.at);
        return empty.get();
      }));
    }
    // A demo of the program; bodies: about how many, 0: as many as it has.
    static demo(name, { bodies = 0, seed = 1 } = {}) {
      return library.within((room) => made(room, 'scene_demo', room.text(name), bodies, BigInt(seed)));
    }
    // A scene file: its text, or the object in it.
    static fromJSON(scene) {
      const text = typeof scene === 'string' ? scene : JSON.stringify(scene);
      return library.within((room) => made(room, 'scene_from_json', room.text(text)));
    }
    // One of the files by name (texts or bytes): a scene file, MJCF, URDF, glTF, STL or OBJ, which may refer to the others.
    static fromFiles(files, name, { packages, base, keyframe, ...flags } = {}) {
      const { FS } = library.module;
      const folder = `/tmp/scree-${(sceneFolders += 1)}`;
      const remove = (path) => {
        for (const entry of FS.readdir(path).filter((entry) => entry !== '.' && entry !== '..')) {
          const inner = `${path}/${entry}`;
          if (FS.isDir(FS.stat(inner).mode)) remove(inner);
          else FS.unlink(inner);
        }
        FS.rmdir(path);
      };
      FS.mkdir(folder);
      try {
        for (const [file, content] of Object.entries(files)) {
          const parts = file.split('/');
          if (parts.some((part) => part === '' || part === '..')) throw new RangeError(`files: "${file}" is no path below a folder`);
          FS.mkdirTree(`${folder}/${parts.slice(0, -1).join('/')}`);
          FS.writeFile(`${folder}/${file}`, content);
        }
        return library.within((room) => {
          const options = room.options('scree_load_options', Object.fromEntries(
            Object.entries({ ...flags, base: room.text(base), keyframe: room.text(keyframe), packages_json: room.json(packages) })
              .map(([key, value]) => [key.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`), value])));
          return made(room, 'scene_load', room.text(`${folder}/${name}`), options);
        });
      } finally {
        remove(folder);
      }
    }
    copy() {
      return library.within((room) => made(room, 'scene_copy', this.handle));
    }

    // Adds one body, or `count` that are alike but for the columns. Returns the index of the first.
    addBodies(body, count = 1, columns = {}) {
      return library.within((room) => {
        const given = room.columns(columns, count);
        const first = room.word();
        library.call('scene_add_bodies', this.handle, room.json(body), count, given.at, given.count, first.at);
        return first.get();
      });
    }
    // list: joints, vehicles, events, exclusions, cars, carts. Returns the index in it.
    add(list, item) {
      return library.within((room) => {
        const index = room.word();
        library.call('scene_add', this.handle, room.text(list), room.json(item), index.at);
        return index.get();
      });
    }
    // key: settings, picture, camera, fields, gravity, duration.
    set(key, value) {
      library.within((room) => library.call('scene_set', this.handle, room.text(key), room.json(value)));
    }
    // Those, and notes, bodies, joints, vehicles (names), scene (all of it), whole (with the meshes of files in it).
    get(key) {
      return library.within((room) => {
        const json = room.word();
        library.call('scene_get', this.handle, room.text(key), json.at);
        return json.json();
      });
    }
    count(list) {
      return library.within((room) => {
        const count = room.word();
        library.call('scene_count', this.handle, room.text(list), count.at);
        return count.get();
      });
    }
    // Index of a body, joint or vehicle; -1: none of that name.
    find(list, name) {
      return library.within((room) => {
        const found = room.array();
        library.call('scene_find', this.handle, room.text(list), room.text(name), found.at);
        const indices = found.copy('u64');
        if (indices.length > 1) throw new RangeError(`${list}: several are named "${name}"`);
        return indices.length === 0 ? -1 : Number(indices[0]);
      });
    }
    // Throws if it cannot be simulated. Returns notes of what is changed before.
    check() {
      return library.within((room) => {
        const notes = room.word();
        library.call('scene_check', this.handle, notes.at);
        return notes.json();
      });
    }
    hash() {
      return library.within((room) => {
        const hash = room.word();
        library.call('scene_hash', this.handle, hash.at);
        return hash.hash();
      });
    }
    toJSON() {
      return this.get('whole');
    }
  }
  return Scene;
}

let sceneFolders = 0;
