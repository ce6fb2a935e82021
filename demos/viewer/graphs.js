// Graphs of one body over time: momentum, speed, forces.
import { numberText } from './colors.js';

export class BodyHistory {
  // Gathers the values of a body over the whole recording, a little at a time; `changed` is called as they come.
  constructor(source, place, changed) {
    const { scene, count } = source, body = scene.bodies[place], { units } = scene.head;
    this.place = place;
    this.done = 0;
    this.count = count;
    const series = (title, unit) => ({ title, unit, values: new Float32Array(count).fill(NaN) });
    this.momentum = series('Momentum', 'kg m/s');
    this.speed = series('Speed', 'm/s');
    this.contact = series('Contact force', 'N');
    this.net = series('Net force', 'N');
    this.net.about = 'change of momentum per time';
    this.ended = false;
    const v = units.velocity, mass = body.mass;
    let before = null;
    source.scan((moment, decoder) => {
      const i = moment.index;
      if (place < moment.count && moment.exists[place]) {
        const at = 3 * place, now = [0, 1, 2].map((k) => moment.velocity[at + k] * v);
        const speed = Math.hypot(...now);
        this.speed.values[i] = speed;
        this.momentum.values[i] = mass * speed;
        this.contact.values[i] = decoder.forceOf(moment.force[place]);
        if (before) this.net.values[i] = mass * Math.hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]) / source.seconds;
        before = now;
      } else {
        before = null;
      }
      this.done = i + 1;
      if (i % 30 === 0) changed();
    }, () => this.ended).then(changed, () => {});
  }
  get series() { return [this.momentum, this.speed, this.contact, this.net]; }
  stop() { this.ended = true; }
}

// A round number at or above a value.
function axisEnd(value) {
  if (!(value > 0)) return 1;
  const unit = 10 ** Math.floor(Math.log10(value));
  return [1, 1.5, 2, 3, 4, 5, 6, 8, 10].map((round) => round * unit).find((round) => value <= round * 1.0001) ?? value;
}

export function drawGraph(canvas, { values }, done, frame, colors) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (width === 0) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  let most = 0;
  for (let i = 0; i < done; ++i) if (values[i] > most) most = values[i];
  const end = axisEnd(most), last = Math.max(1, values.length - 1);
  const x = (i) => 1 + (width - 2) * i / last, y = (value) => height - 2 - (height - 6) * value / end;
  context.strokeStyle = colors.grid;
  context.lineWidth = 1;
  context.beginPath();
  for (const part of [0, 0.5, 1]) {
    context.moveTo(0, Math.round(y(part * end)) + 0.5);
    context.lineTo(width, Math.round(y(part * end)) + 0.5);
  }
  context.stroke();
  // Of several frames to a pixel the least and the greatest.
  context.strokeStyle = colors.line;
  context.lineWidth = 1.5;
  context.lineJoin = 'round';
  context.beginPath();
  const together = Math.max(1, Math.floor(last / width));
  let pen = false;
  for (let i = 0; i < done; i += together) {
    let low = Infinity, high = -Infinity;
    for (let k = i; k < Math.min(i + together, done); ++k) {
      if (values[k] < low) low = values[k];
      if (values[k] > high) high = values[k];
    }
    if (low > high) {
      pen = false;
      continue;
    }
    if (pen) context.lineTo(x(i), y(low)); else context.moveTo(x(i), y(low));
    if (high > low) context.lineTo(x(i), y(high));
    pen = true;
  }
  context.stroke();
  context.fillStyle = colors.ink;
  context.globalAlpha = 0.7;
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'right';
  context.fillText(numberText(end), width - 2, 14);
  context.globalAlpha = 1;
  context.strokeStyle = colors.cursor;
  context.beginPath();
  context.moveTo(x(frame), 0);
  context.lineTo(x(frame), height);
  context.stroke();
}

// Events over the time line: breaks as lines, hits by their strength.
export function drawEvents(canvas, events, duration, colors) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (width === 0) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d'), columns = new Float32Array(Math.ceil(width));
  context.scale(ratio, ratio);
  let most = 0;
  for (const event of events) {
    if (event.kind !== 'hit') continue;
    const column = Math.min(columns.length - 1, Math.max(0, Math.round(event.time / duration * (width - 1))));
    columns[column] = Math.max(columns[column], event.impulse);
    most = Math.max(most, event.impulse);
  }
  context.fillStyle = colors.hit;
  columns.forEach((value, i) => {
    if (value > 0) context.fillRect(i, height - height * Math.sqrt(value / most), 1, height);
  });
  context.fillStyle = colors.broke;
  for (const event of events) if (event.kind !== 'hit') context.fillRect(event.time / duration * (width - 1), 0, 1.5, height);
}
