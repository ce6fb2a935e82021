// scree in WebAssembly: load() gives the classes Scene and World.
import { ScreeError } from './library.js';
import { loadLibrary } from './load.js';
import { sceneClass } from './scene.js';
import { worldClass } from './world.js';

export { ScreeError };

// threads: of a loop, 1 (the default): none but the caller. print, printError: take lines of what command() writes.
export async function load(options = {}) {
  const library = await loadLibrary(options);
  const Scene = sceneClass(library);
  const World = worldClass(library, Scene);
  return {
    Scene,
    World,
    version: library.text(library.module._scree_version()),
    threads: library.threads,
    files: library.module.FS,
    // JSON of what scree knows. what: schema, settings, demos, keys (name: of which object).
    describe(what, name = undefined) {
      return library.within((room) => {
        const json = room.word();
        library.call('describe', room.text(what), room.text(name), json.at);
        return json.json();
      });
    },
    // Runs a command of the program, as ['run', 'wall', '--steps', '12']. Returns its exit status.
    command(words) {
      return library.within((room) => {
        const pointers = ['scree', ...words].map((word) => room.text(word));
        return library.module._scree_command(pointers.length, room.numbers('u32', pointers));
      });
    },
    massProperties(body, density) {
      return library.within((room) => {
        const mass = room.word();
        const inertia = room.take(12);
        library.call('mass_properties', room.json(body), density, mass.at, inertia);
        return { mass: library.data.getFloat32(mass.at, true), inertia: library.copy('f32', inertia, 3) };
      });
    },
  };
}
