// The page's controls: buttons, keys, pointers, panels. They tell the player what to do, and show what it tells.
import { numberText, QUANTITIES, quantitiesOf } from './colors.js';
import { cameraKey, followPointers } from './gestures.js';
import { drawEvents, drawGraph } from './graphs.js';
import { drawLegend } from './legend.js';
import { SKIES } from './renderer.js';
import { followTheme } from './theme.js';

const element = (id) => document.getElementById(id);
const SPEEDS = ['0.1', '0.25', '0.5', '1', '2', '4'];
const SHOWN = ['contacts', 'joints', 'velocities', 'hits', 'sleep'];
const clock = (seconds) => seconds.toFixed(2);

export class Controls {
  constructor(player) {
    this.player = player;
    this.said = '';
    followTheme(() => {
      this.colors = null;
      this.drawMarks();
      player.change();
    });
    this.setUpBar();
    this.setUpSettings();
    this.setUpPicked();
    this.setUpView();
    document.addEventListener('keydown', (event) => this.key(event));
    window.addEventListener('resize', () => {
      this.drawMarks();
      this.drawLegend();
      player.change();
    });
  }

  say(text) {
    if (text !== this.said) element('status').textContent = this.said = text;
  }

  themeColors() {
    if (!this.colors) {
      const style = getComputedStyle(document.documentElement), of = (name) => style.getPropertyValue(name).trim();
      this.colors = { ink: of('--ink'), grid: of('--grid'), line: of('--accent'), cursor: of('--broke'), hit: of('--hit'), broke: of('--broke') };
    }
    return this.colors;
  }

  setUpBar() {
    const { player } = this, time = element('time'), speed = element('speed'), loop = element('loop');
    element('play').addEventListener('click', () => player.setPlaying(!player.playing));
    time.max = player.source.count - 1;
    time.addEventListener('input', () => {
      player.seek(Number(time.value));
    });
    speed.addEventListener('change', () => {
      player.speed = Number(speed.value);
    });
    loop.addEventListener('click', () => {
      player.loops = !player.loops;
      loop.setAttribute('aria-pressed', player.loops);
    });
    const more = element('more'), settings = element('settings');
    more.addEventListener('click', () => {
      settings.hidden = !settings.hidden;
      more.setAttribute('aria-expanded', !settings.hidden);
      if (!settings.hidden) element('color').focus();
    });
    const help = element('help');
    element('ask').addEventListener('click', () => help.showModal());
    element('help-close').addEventListener('click', () => help.close());
  }

  setUpSettings() {
    const { player } = this, sky = element('sky'), find = element('find');
    element('color').addEventListener('change', (event) => this.chooseColor(event.target.value));
    for (const name of Object.keys(SKIES)) sky.append(new Option(name[0].toUpperCase() + name.slice(1), name));
    sky.addEventListener('change', () => {
      player.renderer.sky = sky.value;
      player.change();
    });
    element('quality').addEventListener('change', (event) => player.setQuality(event.target.value));
    for (const name of SHOWN) element(`show-${name}`).addEventListener('change', (event) => player.show(name, event.target.checked));
    find.addEventListener('change', () => {
      const word = find.value.trim(), { scene } = player;
      if (!word) return;
      let place = scene.bodies.findIndex((body) => body.name === word);
      if (place < 0 && /^\d+$/.test(word)) place = scene.bodies.findIndex((body) => body.id === Number(word));
      if (place < 0) place = scene.bodies.findIndex((body) => body.name.toLowerCase().includes(word.toLowerCase()));
      if (place < 0) this.say(`no body is called ${word}`); else player.select(place, true);
    });
    element('home').addEventListener('click', () => player.goHome());
    this.fillSettings();
  }
  // What depends on the scene.
  fillSettings() {
    const { player } = this, { scene, palette } = player, { head } = scene;
    const color = element('color'), names = element('names'), known = new Set();
    color.replaceChildren();
    for (const [value, text] of quantitiesOf(palette, scene)) color.append(new Option(text, value));
    color.value = palette.by;
    element('sky').value = player.renderer.sky;
    for (const name of SHOWN) {
      const box = element(`show-${name}`);
      box.checked = player.shows[name];
      box.disabled = (name === 'contacts' && !head.has.contacts) || (name === 'joints' && scene.joints.length === 0) || (name === 'hits' && !head.has.events);
      if (name === 'contacts') box.parentElement.lastChild.textContent = box.disabled ? ' Contacts (not recorded: run with \u2011\u2011show contacts)' : ' Contacts';
    }
    names.replaceChildren();
    for (const body of scene.bodies) {
      if (known.size >= 300) break;
      if (body.name && !known.has(body.name)) {
        known.add(body.name);
        names.append(new Option('', body.name));
      }
    }
    this.tellErrors();
    element('name').textContent = head.title;
    this.drawLegend();
  }
  tellErrors() {
    const { errors, seconds } = this.player.scene.head, millimetres = (x) => `${numberText(x * 1000, 2)} mm`;
    element('errors').textContent = `Recorded ${numberText(1 / seconds)} times a second and interpolated between. In recorded moments positions are within `
      + `${millimetres(errors.position)} along each axis, angles within ${numberText(errors.angle * 180 / Math.PI, 2)}°, velocities within `
      + `${numberText(errors.velocity, 2)} m/s, forces within ${numberText(100 * errors.force, 2)} %.`;
  }
  chooseColor(value) {
    const { player } = this;
    player.palette.choose(value);
    element('color').value = value;
    this.drawLegend();
    this.say(`coloured by ${QUANTITIES.find(([name]) => name === value)[1].toLowerCase()}`);
    player.change();
  }

  drawLegend() { drawLegend(this.player.palette); }
  drawMarks() {
    const { source } = this.player;
    drawEvents(element('marks'), this.player.scene.events, Math.max(source.seconds * (source.count - 1), 1e-9), this.themeColors());
  }

  setUpPicked() {
    const { player } = this;
    element('picked-close').addEventListener('click', () => player.select(-1));
    element('follow').addEventListener('click', () => player.follow(!player.follows));
    element('look').addEventListener('click', () => player.lookAt());
  }
  showPicked() {
    const { player } = this, panel = element('picked'), place = player.selected;
    panel.hidden = place < 0;
    element('follow').setAttribute('aria-pressed', player.follows);
    if (place < 0) return;
    const body = player.scene.bodies[place];
    element('picked-name').textContent = body.label;
    const mass = body.mass > 0 ? `, ${numberText(body.mass)} kg` : '';
    element('picked-facts').textContent = `${body.shape}${mass}, ${['dynamic', 'fixed', 'kinematic'][body.motion]}${body.fragment ? ', a fragment' : ''}`;
    const graphs = element('graphs');
    if (graphs.dataset.place !== String(place)) {
      graphs.dataset.place = place;
      graphs.replaceChildren(...(player.history ? player.history.series.map((series) => {
        const figure = document.createElement('figure'), caption = document.createElement('figcaption'), value = document.createElement('b');
        const canvas = document.createElement('canvas'), title = document.createElement('span');
        figure.className = 'graph';
        title.textContent = series.title;
        if (series.about) title.title = series.about;
        caption.append(title, value);
        canvas.setAttribute('role', 'img');
        canvas.addEventListener('click', (event) => player.seek(event.offsetX / canvas.clientWidth * (player.source.count - 1)));
        figure.append(caption, canvas);
        Object.assign(series, { canvas, value });
        return figure;
      }) : []));
      this.say(`${body.label} chosen: ${element('picked-facts').textContent}`);
    }
    this.drawGraphs();
  }
  drawGraphs() {
    const { history } = this.player, frame = history?.cursor ?? this.player.frame;
    if (!history) return;
    const at = Math.min(Math.round(frame), history.done - 1);
    for (const series of history.series) {
      if (!series.canvas) continue;
      const value = series.values[at], text = Number.isFinite(value) ? `${numberText(value)} ${series.unit}` : 'not there';
      series.value.textContent = text;
      series.canvas.setAttribute('aria-label', `${series.title} over time, now ${text}`);
      drawGraph(series.canvas, series, history.done, frame, this.themeColors());
    }
  }

  // Everything that changes as time passes.
  update() {
    const { player } = this, { source } = player, time = element('time'), at = Math.round(player.frame), seconds = player.frame * source.seconds;
    if (time.value !== String(at)) time.value = at;
    const duration = (source.count - 1) * source.seconds;
    time.setAttribute('aria-valuetext', `${clock(seconds)} of ${clock(duration)} seconds`);
    element('clock').textContent = `${clock(seconds)} / ${clock(duration)} s`;
    const bodies = player.pose.shown ?? 0;
    element('facts').textContent = `${clock(seconds + player.scene.head.start)} s · ${bodies.toLocaleString('en')} ${bodies === 1 ? 'body' : 'bodies'}`;
    if (this.playing !== player.playing) {
      this.playing = player.playing;
      element('play').setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
      element('play-icon').setAttribute('d', player.playing ? 'M3 2h4v12H3zM9 2h4v12H9z' : 'M4 2l10 6-10 6z');
    }
    if (player.selected >= 0) this.drawGraphs();
  }

  setUpView() {
    const { player } = this;
    followPointers(element('view'), player);
  }

  key(event) {
    const { player } = this, on = event.target, inView = on === element('view') || on === document.body;
    if (event.ctrlKey || event.metaKey || event.altKey || element('help').open) return;
    if (on.matches?.('select, input[type="search"]')) return;
    const takes = (work) => {
      event.preventDefault();
      work();
    };
    const speed = element('speed');
    const faster = (by) => takes(() => {
      speed.value = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, SPEEDS.indexOf(speed.value) + by))];
      speed.dispatchEvent(new Event('change'));
      this.say(`speed ${speed.value}`);
    });
    const moves = cameraKey(event, inView, player);
    if (moves) return takes(moves);
    if (inView && event.key === 'Home') return takes(() => player.goHome());
    if (event.key === ' ' && !on.matches?.('button, input[type="checkbox"]')) return takes(() => player.setPlaying(!player.playing));
    switch (event.key) {
      case ',': return takes(() => player.seek(Math.ceil(player.frame) - 1));
      case '.': return takes(() => player.seek(Math.floor(player.frame) + 1));
      case '[': return faster(-1);
      case ']': return faster(1);
      case '?': return takes(() => element('help').showModal());
      case 'Escape': return player.select(-1);
    }
    switch (event.key.toLowerCase()) {
      case 'n': return takes(() => player.selectNext(1));
      case 'p': return takes(() => player.selectNext(-1));
      case 'f': return takes(() => player.follow(!player.follows));
      case 'l': return takes(() => player.lookAt());
      case 'c': return takes(() => {
        const { options, selectedIndex } = element('color');
        this.chooseColor(options[(selectedIndex + 1) % options.length].value);
      });
    }
  }
}
