// Recordings: pages that play a run in any browser, and chunks for live viewers.
import { Held } from './library.js';

export function addRecordings(World, library) {
  class Recording extends Held {
    array(name, ...given) {
      return library.within((room) => {
        const array = room.array();
        library.call(`recording_${name}`, this.handle, ...given, array.at);
        return array.copy('u8');
      });
    }
    // Frames so far.
    count() {
      return library.within((room) => {
        const frames = room.word();
        library.call('recording_count', this.handle, frames.at);
        return Number(library.data.getBigUint64(frames.at, true));
      });
    }
    // The page so far, as text.
    page() {
      return new TextDecoder().decode(this.array('page'));
    }
    // Of a live one: chunks of what is new in the scene since the last call, and with `frame` a frame of now.
    take(frame = false) {
      return this.array('take', frame ? 1 : 0);
    }
    stop() {
      library.call('recording_stop', this.handle);
    }
  }

  // Of the steps from now on. options: title, camera, look (as in scene files), fps, contacts, events, live, copy.
  World.prototype.record = function ({ title, camera, look, ...options } = {}) {
    return new Recording(library, 'recording', library.within((room) => {
      const handle = room.word();
      const given = room.options('scree_record_options',
        { copy: 0, ...options, title: room.text(title), camera_json: room.json(camera), look_json: room.json(look) });
      library.call('world_record', this.handle, given, handle.at);
      return handle.get();
    }));
  };
}
