// The page's controls: buttons, keys, pointers, panels. They tell the player what to do, and show what it tells.
import { numberText, QUANTITIES } from './colors.js';
import { drawEvents, drawGraph } from './graphs.js';
import { SKIES } from './renderer.js';

const element = (id) => document.getElementById(id);
const SPEEDS = ['0.1', '0.25', '0.5', '1', '2', '4'];
const SHOWN = ['contacts', 'joints', 'velocities', 'hits', 'sleep'];
const clock = (seconds) => seconds.toFixed(2);

export class Controls {
  constructor(player) {
    this.player = player;
    this.dark = matchMedia('(prefers-color-scheme: dark)');
    this.said = '';
    this.setUpTheme();
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

  setUpTheme() {
    let kept = 'auto';
    try { kept = localStorage.getItem('scree-theme') ?? 'auto'; } catch { /* pages of files may have no storage */ }
    const theme = element('theme');
    theme.value = kept;
    const show = () => {
      document.documentElement.dataset.theme = theme.value === 'auto' ? (this.dark.matches ? 'dark' : 'light') : theme.value;
      this.colors = null;
      this.drawMarks?.();
      this.player.change();
    };
    this.dark.addEventListener('change', show);
    theme.addEventListener('change', () => {
      try { localStorage.setItem('scree-theme', theme.value); } catch { /* likewise */ }
      show();
    });
    document.documentElement.dataset.theme = theme.value === 'auto' ? (this.dark.matches ? 'dark' : 'light') : theme.value;
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
    const { player } = this, { scene, palette } = player, { head } = scene;
    const color = element('color');
    for (const [value, text] of QUANTITIES) {
      const usable = palette.scales[value] || ['sleep', 'body', 'plain'].includes(value) || (value === 'own' && scene.bodies.some((body) => body.color));
      if (usable) color.append(new Option(text, value));
    }
    color.value = palette.by;
    color.addEventListener('change', () => this.chooseColor(color.value));
    const sky = element('sky');
    for (const name of Object.keys(SKIES)) sky.append(new Option(name[0].toUpperCase() + name.slice(1), name));
    sky.value = player.renderer.sky;
    sky.addEventListener('change', () => {
      player.renderer.sky = sky.value;
      player.change();
    });
    element('quality').addEventListener('change', (event) => player.setQuality(event.target.value));
    for (const name of SHOWN) {
      const box = element(`show-${name}`);
      box.checked = player.shows[name];
      box.disabled = (name === 'contacts' && !head.has.contacts) || (name === 'joints' && scene.joints.length === 0) || (name === 'hits' && !head.has.events);
      if (box.disabled && name === 'contacts') box.parentElement.append(' (not recorded: run with \u2011\u2011show contacts)');
      box.addEventListener('change', () => player.show(name, box.checked));
    }
    const find = element('find'), names = element('names'), known = new Set();
    for (const body of scene.bodies) {
      if (known.size >= 300) break;
      if (body.name && !known.has(body.name)) {
        known.add(body.name);
        names.append(new Option('', body.name));
      }
    }
    find.addEventListener('change', () => {
      const word = find.value.trim();
      if (!word) return;
      let place = scene.bodies.findIndex((body) => body.name === word);
      if (place < 0 && /^\d+$/.test(word)) place = scene.bodies.findIndex((body) => body.id === Number(word));
      if (place < 0) place = scene.bodies.findIndex((body) => body.name.toLowerCase().includes(word.toLowerCase()));
      if (place < 0) this.say(`no body is called ${word}`); else player.select(place, true);
    });
    element('home').addEventListener('click', () => player.goHome());
    const { errors } = head, millimetres = (x) => `${numberText(x * 1000, 2)} mm`;
    element('errors').textContent = `Recorded ${numberText(1 / head.seconds)} times a second and interpolated between. In recorded moments positions are within `
      + `${millimetres(errors.position)} along each axis, angles within ${numberText(errors.angle * 180 / Math.PI, 2)}°, velocities within `
      + `${numberText(errors.velocity, 2)} m/s, forces within ${numberText(100 * errors.force, 2)} %.`;
    element('name').textContent = head.title;
    this.drawLegend();
  }
  chooseColor(value) {
    const { player } = this;
    player.palette.choose(value);
    element('color').value = value;
    this.drawLegend();
    this.say(`coloured by ${QUANTITIES.find(([name]) => name === value)[1].toLowerCase()}`);
    player.change();
  }

  drawLegend() {
    const { palette } = this.player, legend = element('legend'), { scale } = palette;
    legend.hidden = !scale;
    if (!scale) return;
    element('legend-title').textContent = scale.title;
    element('legend-unit').textContent = [scale.unit, scale.scale === 'root' ? 'root scale' : scale.scale === 'log' ? 'log scale' : ''].filter(Boolean).join(', ');
    const bar = element('legend-bar'), context = bar.getContext('2d'), image = context.createImageData(256, 1);
    for (let i = 0; i < 256; ++i) {
      const word = palette.table[i];
      for (let k = 0; k < 3; ++k) {
        const linear = ((word >>> 8 * k & 255) / 255) ** 2;
        image.data[4 * i + k] = Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
      }
      image.data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
    const ticks = element('legend-ticks'), width = ticks.clientWidth || 290;
    let values = [], texts = [];
    for (let most = 6; most > 1; --most) {
      values = scale.ticks(most);
      texts = values.map((value) => numberText(value));
      // Labels as they will lie, those at the ends within the bar.
      let end = -Infinity;
      const apart = values.every((value, i) => {
        const half = 3.9 * texts[i].length, at = scale.place(value), middle = at < 0.04 ? half : at > 0.96 ? width * at - half : width * at;
        const free = middle - half > end + 6;
        end = middle + half;
        return free;
      });
      if (apart) break;
    }
    ticks.replaceChildren(...values.map((value, i) => {
      const tick = document.createElement('span'), place = scale.place(value);
      tick.textContent = texts[i];
      tick.style.left = `${100 * place}%`;
      if (place < 0.04) tick.className = 'first';
      if (place > 0.96) tick.className = 'last';
      return tick;
    }));
    legend.setAttribute('aria-label', `Colours: ${scale.title}, ${scale.unit}, from ${numberText(scale.low)} to ${numberText(scale.high)}`);
  }
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
    const { history, frame } = this.player;
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
    const { player } = this, view = element('view'), held = new Map();
    let moved = 0, middle = null, gap = 0;
    const around = () => {
      const points = [...held.values()], sum = points.reduce((a, p) => [a[0] + p[0], a[1] + p[1]], [0, 0]).map((x) => x / points.length);
      return [sum, points.length > 1 ? Math.hypot(points[0][0] - points[1][0], points[0][1] - points[1][1]) : 0];
    };
    view.addEventListener('pointerdown', (event) => {
      view.setPointerCapture(event.pointerId);
      held.set(event.pointerId, [event.offsetX, event.offsetY]);
      if (held.size === 1) moved = 0;
      [middle, gap] = around();
    });
    view.addEventListener('pointermove', (event) => {
      if (!held.has(event.pointerId)) return;
      held.set(event.pointerId, [event.offsetX, event.offsetY]);
      const [now, wide] = around(), dx = now[0] - middle[0], dy = now[1] - middle[1];
      moved += Math.abs(dx) + Math.abs(dy) + Math.abs(wide - gap);
      if (moved < 4) return;
      player.takeCamera();
      if (held.size > 1 || event.buttons & 6 || event.shiftKey) {
        player.pan(-dx / view.clientHeight, dy / view.clientHeight);
        if (gap > 0 && wide > 0) player.camera.zoom(gap / wide);
      } else {
        player.camera.orbit(-dx * 0.006, dy * 0.006);
      }
      [middle, gap] = [now, wide];
      player.change();
    });
    const release = (event) => {
      if (!held.delete(event.pointerId)) return;
      if (held.size > 0) [middle, gap] = around();
      if (event.type === 'pointerup' && held.size === 0 && moved < 4 && event.button === 0) player.pickAt(event.offsetX, event.offsetY);
    };
    view.addEventListener('pointerup', release);
    view.addEventListener('pointercancel', release);
    view.addEventListener('contextmenu', (event) => event.preventDefault());
    view.addEventListener('wheel', (event) => {
      event.preventDefault();
      player.takeCamera();
      player.camera.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY * (event.deltaMode === 1 ? 16 : 1))) * 0.003));
      player.change();
    }, { passive: false });
  }

  key(event) {
    const { player } = this, on = event.target, inView = on === element('view') || on === document.body;
    if (event.ctrlKey || event.metaKey || event.altKey || element('help').open) return;
    if (on.matches?.('select, input[type="search"]')) return;
    const takes = (work) => {
      event.preventDefault();
      work();
    };
    const move = (right, up) => takes(() => {
      player.takeCamera();
      if (event.shiftKey) player.pan(0.04 * right, 0.04 * up); else player.camera.orbit(0.08 * right, 0.08 * up);
      player.change();
    });
    const zoom = (factor) => takes(() => {
      player.takeCamera();
      player.camera.zoom(factor);
      player.change();
    });
    const speed = element('speed');
    const faster = (by) => takes(() => {
      speed.value = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, SPEEDS.indexOf(speed.value) + by))];
      speed.dispatchEvent(new Event('change'));
      this.say(`speed ${speed.value}`);
    });
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (inView && arrows[event.key]) return move(...arrows[event.key]);
    if (inView && event.key === 'Home') return takes(() => player.goHome());
    if (event.key === ' ' && !on.matches?.('button, input[type="checkbox"]')) return takes(() => player.setPlaying(!player.playing));
    switch (event.key) {
      case '+': case '=': return zoom(0.88);
      case '-': return zoom(1 / 0.88);
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
