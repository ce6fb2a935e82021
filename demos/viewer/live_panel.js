// The bar and the panel of the live page: who drives, the clock, other scenes, and keys.
import { numberText } from './colors.js';

const element = (id) => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};
const ICONS = {
  step: 'M3 2l7 6-7 6zM11 2h2v12h-2z',
  restart: 'M8 3a5 5 0 1 1-4.6 3.1l1.7.7A3.2 3.2 0 1 0 8 4.800V7L3.500 3.500 8 0z',
  live: 'M2 3h12v8H2zM5 13h6v1.500H5z',
};
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const KEYS = [
  ['drag a body', 'grab it, and throw it (wheel: nearer or farther)'], ['drag beside bodies', 'turn the view'], ['B, Shift+B', 'throw a ball, a box through the pointer'],
  ['X', 'explosion at the pointer'], ['.', 'a single step'], [',', 'a step back'], ['R', 'restart'], ['K, Shift+K', 'keep this state, return to it'],
  ['Ctrl+Z', 'take the last command back'], ['Delete, V', 'delete, duplicate the chosen body'], ['W, S, A, D', 'with a vehicle: throttle, brake, left, right'],
  ['H, Backspace', 'hand brake, reset upright'],
];

// Keys of vehicles that are held down.
export const drivingKeys = {
  held: new Set(),
  press(player, key, on) {
    if (on === this.held.has(key)) return;
    if (on) this.held.add(key); else this.held.delete(key);
    player.tell({ do: 'key', key, on });
  },
  release(player) { for (const key of [...this.held]) this.press(player, key, false); },
};
const DRIVING = { w: 'w', a: 'a', s: 's', d: 'd', h: 'space' };

export class LivePanel {
  constructor(player, controls) {
    Object.assign(this, { player, controls, busy: false });
    this.makePanel();
    this.makeBar();
    const list = element('help').querySelector('dl');
    list.prepend(...KEYS.flatMap(([keys, meaning]) => [make('dt', { textContent: keys }), make('dd', { textContent: meaning })]));
    for (const term of [...list.querySelectorAll('dt')].slice(KEYS.length))
      if (['drag, arrow keys', ', and .'].includes(term.textContent)) {
        if (term.textContent === ', and .') {
          term.nextSibling?.remove();
          term.nextElementSibling?.remove();
          term.remove();
        } else {
          term.textContent = 'arrow keys';
        }
      }
    document.addEventListener('keyup', (event) => {
      const key = DRIVING[event.key.toLowerCase()];
      if (key && drivingKeys.held.has(key)) drivingKeys.press(player, key, false);
    });
    this.update();
  }
  tell(message) { this.player.tell(message); }
  get server() { return this.player.source.state; }

  makeBar() {
    const { player } = this, bar = element('bar'), speed = element('speed'), time = element('time');
    element('loop').remove();
    element('marks').remove();
    element('play').addEventListener('click', () => this.pause());
    const icon = (name, label, work) => {
      const button = make('button', { type: 'button', id: name, title: label });
      button.setAttribute('aria-label', label);
      button.innerHTML = `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${ICONS[name]}" fill-rule="evenodd"/></svg>`;
      button.addEventListener('click', work);
      return button;
    };
    element('play').after(icon('step', 'A single step (.)', () => this.tell({ do: 'step' })), icon('restart', 'Restart (R)', () => this.tell({ do: 'restart' })));
    // The time line of the session: it can go back.
    time.addEventListener('input', () => (this.sliding = true));
    time.addEventListener('change', () => {
      this.sliding = false;
      this.tell({ do: 'go', step: Number(time.value) });
    });
    speed.replaceChildren(...SPEEDS.map((value) => new Option(`${value === 0.25 ? '¼' : value}×`, value)));
    speed.addEventListener('change', () => this.tell({ do: 'speed', value: Number(speed.value) }));
    const toggle = icon('live', 'Drive', () => this.show(this.panel.hidden));
    toggle.setAttribute('aria-controls', 'live-panel');
    bar.insertBefore(toggle, element('more'));
    this.toggle = toggle;
    this.show(false);
    const more = element('more'), settings = element('settings'), help = element('help');
    more.addEventListener('click', () => {
      settings.hidden = !settings.hidden;
      more.setAttribute('aria-expanded', !settings.hidden);
      if (!settings.hidden) {
        this.show(false);
        element('color').focus();
      }
    });
    element('ask').addEventListener('click', () => help.showModal());
    element('help-close').addEventListener('click', () => help.close());
    document.title = `${player.scene.head.title} · scree`;
  }
  show(on) {
    this.panel.hidden = !on;
    this.toggle.setAttribute('aria-expanded', on);
    if (on && !element('settings').hidden) element('more').click();
  }

  makePanel() {
    const { player } = this, button = (text, title, work) => {
      const made = make('button', { type: 'button', textContent: text, title });
      made.addEventListener('click', work);
      return made;
    };
    const field = (text, input) => make('label', {}, text, input);
    const number = (properties) => make('input', { type: 'number', ...properties });
    this.role = make('p', { id: 'role' });
    this.wheel = button('Take over', 'Drive, or let another viewer drive', () => this.tell({ do: player.drives ? 'yield' : 'take' }));
    this.wheel.id = 'wheel';
    this.names = make('select', { id: 'scenes' });
    for (const { name, line } of player.source.hello.demos) this.names.append(new Option(name, name, false, false));
    for (const option of this.names.options) option.title = player.source.hello.demos.find(({ name }) => name === option.value).line;
    this.bodies = number({ id: 'bodies', min: 1, step: 1, placeholder: 'its own' });
    this.gravity = number({ id: 'gravity', step: 'any' });
    this.substeps = number({ id: 'substeps', min: 1, max: 64, step: 1 });
    const open = () => {
      const count = Math.round(Number(this.bodies.value));
      this.tell({ do: 'open', name: this.names.value, bodies: count > 0 ? count : 0 });
    };
    this.names.addEventListener('change', () => {
      this.bodies.value = '';
      this.fitBodies();
      open();
    });
    this.gravity.addEventListener('change', () => {
      if (this.gravity.value === '' || !Number.isFinite(Number(this.gravity.value))) return;
      const [x, , z] = this.server.gravity;
      this.tell({ do: 'set', gravity: [x, Math.max(-1000, Math.min(1000, -Number(this.gravity.value))), z] });
    });
    this.substeps.addEventListener('change', () => {
      const count = Math.max(1, Math.min(64, Math.round(Number(this.substeps.value))));
      if (this.substeps.value !== '') this.tell({ do: 'set', substeps: count });
    });
    this.keep = button('Keep state', 'Keep this state (K)', () => this.tell({ do: 'keep' }));
    this.restore = button('Return to it', 'Return to the state that was kept (Shift+K)', () => this.tell({ do: 'restore' }));
    this.deeds = make('div', { className: 'deeds' },
      this.keep, this.restore, button('Undo', 'Take the last command back (Ctrl+Z)', () => this.tell({ do: 'undo' })),
      button('Ball', 'Throw a ball where the pointer was (B)', () => this.tell({ do: 'ball', at: player.at() })),
      button('Box', 'Throw a box (Shift+B)', () => this.tell({ do: 'box', at: player.at() })),
      button('Explode', 'Explosion where the pointer was (X)', () => this.tell({ do: 'explode', at: player.at() })));
    this.message = make('p', { id: 'message' });
    this.message.setAttribute('role', 'status');
    this.rate = make('p', { className: 'dim' });
    this.controlsOfDriver = make('fieldset', { className: 'plain' },
      field('Scene', this.names), make('div', { className: 'row' }, field('Bodies', this.bodies), button('Open', 'Open the scene with so many bodies', open)),
      field('Gravity', this.gravity), field('Substeps', this.substeps), this.deeds);
    this.panel = make('section', { id: 'live-panel', className: 'panel', hidden: true }, make('div', { className: 'row' }, this.role, this.wheel),
      this.controlsOfDriver, this.message, this.rate);
    this.panel.setAttribute('aria-label', 'Drive');
    element('stage').append(this.panel);
    this.badge = make('p', { id: 'badge' });
    element('title').append(this.badge);
  }
  fitBodies() {
    const demo = this.player.source.hello.demos.find(({ name }) => name === this.names.value);
    this.bodies.disabled = !demo || demo.bodies === 0;
    this.bodies.placeholder = demo?.bodies ? String(demo.bodies) : 'its own';
  }
  pause() { this.tell({ do: 'pause', on: !this.server.paused }); }

  update() {
    const { server, player } = this;
    if (!server) return;
    const { drives } = player, { source } = player, others = server.viewers - 1, time = element('time');
    const watchers = others === 0 ? '' : ` · ${others} other${others === 1 ? '' : 's'}`;
    const role = drives ? 'You drive' : server.driver === 0 ? 'Nobody drives' : 'You watch';
    this.set(this.role, role + watchers);
    this.set(this.badge, source.ended ? 'Ended' : `${server.paused ? 'Paused' : 'Live'} · ${role}${watchers}`);
    this.wheel.textContent = drives ? 'Hand over' : 'Take over';
    this.wheel.disabled = source.ended || (!drives && server.driver !== 0);
    this.controlsOfDriver.disabled = !drives;
    for (const id of ['play', 'step', 'restart', 'time', 'speed']) element(id).disabled = !drives;
    this.restore.disabled = server.kept === null;
    this.restore.title = server.kept === null ? 'No state is kept' : `Return to ${server.kept.toFixed(2)} s (Shift+K)`;
    const seconds = source.decoder?.now.time ?? server.seconds;
    this.set(element('facts'), `${seconds.toFixed(2)} s · ${server.there.toLocaleString('en')} ${server.there === 1 ? 'body' : 'bodies'}`);
    this.set(element('clock'), `${seconds.toFixed(2)} s`);
    if (!this.sliding) {
      if (time.max !== String(server.farthest)) time.max = server.farthest;
      if (time.value !== String(server.step)) time.value = server.step;
      time.setAttribute('aria-valuetext', `${server.seconds.toFixed(2)} seconds`);
    }
    if (this.paused !== server.paused) {
      this.paused = server.paused;
      element('play').setAttribute('aria-label', server.paused ? 'Go on' : 'Pause');
      element('play-icon').setAttribute('d', server.paused ? 'M4 2l10 6-10 6z' : 'M3 2h4v12H3zM9 2h4v12H9z');
    }
    this.mirror(element('speed'), String(SPEEDS.find((value) => Math.abs(value - server.speed) < 1e-3) ?? ''));
    if (this.scene !== server.scene) {
      this.scene = server.scene;
      this.names.value = server.scene;
      this.fitBodies();
      document.title = `${server.scene} · scree`;
    }
    this.mirror(this.bodies, server.bodies > 0 ? String(server.bodies) : this.bodies.value);
    this.mirror(this.gravity, String(Number((-server.gravity[1]).toPrecision(6))));
    this.mirror(this.substeps, String(server.substeps));
    this.set(this.message, server.message);
    const slow = server.real_speed < 0.9 * server.speed && !server.paused ? `; time runs at ${numberText(server.real_speed, 2)}×` : '';
    this.set(this.rate, `A step of ${numberText(server.rate)} a second takes ${numberText(server.step_ms, 2)} ms${slow}.`);
    if (player.selected >= 0) this.controls.drawGraphs();
  }
  set(to, text) { if (to.textContent !== text) to.textContent = text; }
  // What the server has, unless it is being changed here.
  mirror(input, value) { if (document.activeElement !== input && input.value !== value) input.value = value; }

  // Whether it is a key of the driver.
  key(event) {
    const { player } = this, on = event.target, key = event.key.toLowerCase();
    if (event.altKey || event.metaKey || element('help').open || on.matches?.('select, input[type="search"], input[type="number"]')) return false;
    const done = () => {
      event.preventDefault();
      return true;
    };
    if (event.ctrlKey) {
      if (key !== 'z' || !player.drives) return false;
      this.tell({ do: 'undo' });
      return done();
    }
    if (!player.drives) return event.key === ' ' && !on.matches?.('button, input') ? done() : false;
    if (this.server.vehicle && DRIVING[key]) {
      if (!event.repeat) {
        if (player.selected < 0) this.chooseVehicle();
        drivingKeys.press(player, DRIVING[key], true);
      }
      return done();
    }
    const deeds = {
      ' ': () => this.pause(), '.': () => this.tell({ do: 'step' }), r: () => this.tell({ do: 'restart' }),
      ',': () => this.tell({ do: 'go', step: Math.max(0, this.server.step - 1) }),
      k: () => this.tell({ do: event.shiftKey ? 'restore' : 'keep' }),
      b: () => this.tell({ do: event.shiftKey ? 'box' : 'ball', at: player.at() }),
      x: () => this.tell({ do: 'explode', at: player.at() }),
      delete: () => this.tell({ do: 'remove' }), v: () => this.tell({ do: 'duplicate' }),
      backspace: () => this.tell({ do: 'righten' }),
    };
    if (!deeds[key] || (key === ' ' && on.matches?.('button, input[type="checkbox"]'))) return false;
    deeds[key]();
    return done();
  }
  chooseVehicle() {
    const { player } = this, place = player.scene.bodies.findIndex((body) => body.id === this.server.vehicle.body);
    if (place < 0) return;
    player.select(place);
    player.follow(true);
  }
}
