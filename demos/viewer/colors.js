// Colours of bodies, as the program's pictures have them (shaders/render/bodies/tint.comp, host/canvas/colors.cpp).
import { clamp } from './math.js';
import { DYNAMIC, FIXED, KINEMATIC } from './scene.js';

export const linearOf = (encoded) => encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
export const bytesOfHex = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

const STONE = [0.40, 0.385, 0.36], KINEMATIC_COLOR = [0.30, 0.34, 0.40], PLAIN = [0.62, 0.33, 0.13], UNCOLORED = [0.55, 0.53, 0.50];
const PLACES = 256;

export const QUANTITIES = [
  ['momentum', 'Momentum'], ['speed', 'Speed'], ['spin', 'Spin'], ['kinetic-energy', 'Kinetic energy'],
  ['angular-momentum', 'Spin momentum'], ['height', 'Height'], ['contact-impulse', 'Contact impulse'],
  ['sleep', 'Asleep'], ['body', 'Body'], ['own', 'Own colours'], ['plain', 'Plain'],
];
// Those that a scene can be coloured by.
export const quantitiesOf = (palette, scene) => QUANTITIES.filter(([value]) => palette.scales[value] || ['sleep', 'body', 'plain'].includes(value)
  || (value === 'own' && scene.bodies.some((body) => body.color)));

// Distinct colours: hues spaced by the golden ratio, of similar lightness.
export function nameColor(n) {
  const hue = ((n % 4096) * 0.61803399) % 1;
  return [0, 0.33, 0.67].map((shift) => {
    const c = 0.5 + 0.5 * Math.cos(6.2831853 * (hue + shift));
    return 0.10 + 0.65 * c * c;
  });
}

export class ColorScale {
  constructor(given) { Object.assign(this, given); }
  spread(x) { return this.scale === 'log' ? Math.log(Math.max(x, 1e-30)) : this.scale === 'root' ? Math.sqrt(Math.max(x, 0)) : x; }
  place(value) {
    const low = this.spread(this.low);
    return clamp((this.spread(value) - low) / (this.spread(this.high) - low), 0, 1);
  }
  // Values and places of ticks: at most `most`, multiples of 1, 2 or 5 times a power of ten.
  ticks(most) {
    const { low, high } = this, made = [];
    if (!(high > low)) return made;
    if (this.scale === 'log') {
      const first = Math.ceil(Math.log10(low) - 1e-4), last = Math.floor(Math.log10(high) + 1e-4);
      for (let e = first, step = Math.max(1, Math.floor((last - first + most) / most)); e <= last; e += step) made.push(10 ** e);
      return made;
    }
    const power = 10 ** Math.floor(Math.log10((high - low) / most));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each * 1.0001 >= (high - low) / Math.max(most - 1, 1)) ?? 10 * power;
    for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) made.push(k * step);
    return made;
  }
}

const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';
// A number with three digits or so: "1250", "0.031", "4.2·10⁶".
export function numberText(value, digits = 3) {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-9);
  if (exponent >= -3 && exponent <= 4) return String(Number(value.toPrecision(Math.max(digits, Math.min(exponent + 1, 5)))));
  const power = (exponent < 0 ? '⁻' : '') + [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPTS[digit]).join('');
  return `${Number((value / 10 ** exponent).toPrecision(digits))}·10${power}`;
}

// Turns a quantity of a body into four bytes: square roots of linear red, green and blue, and the place on the scale.
export class Palette {
  constructor(head) {
    this.map = head.colors.map.map(bytesOfHex);
    this.scales = Object.fromEntries(Object.entries(head.colors.scales).map(([name, scale]) => [name, new ColorScale(scale)]));
    this.paler = false;
    this.dull = false;
    this.version = 0;
    this.choose(head.colors.first);
  }
  choose(by) {
    this.by = by;
    ++this.version;
    this.scale = this.scales[by] ?? null;
    this.table = new Uint32Array(PLACES);
    for (let i = 0; i < PLACES; ++i) {
      const x = (i / (PLACES - 1)) * (this.map.length - 1), k = Math.min(Math.floor(x), this.map.length - 2);
      const color = [0, 1, 2].map((c) => {
        const a = linearOf(this.map[k][c] / 255), b = linearOf(this.map[k + 1][c] / 255);
        return a + (b - a) * (x - k);
      });
      this.table[i] = this.packed(color, i / (PLACES - 1));
    }
    this.asleep = this.packed([0.10, 0.16, 0.30]);
    this.awake = this.packed([0.62, 0.33, 0.13]);
  }
  packed(color, place = 0) {
    let [r, g, b] = color;
    if (this.paler) {
      const grey = 0.08 + 0.5 * (0.2126 * r + 0.7152 * g + 0.0722 * b);
      [r, g, b] = [r, g, b].map((c) => c + (grey - c) * 0.45);
      place = 0;
    }
    const byte = (x) => Math.round(255 * Math.sqrt(clamp(x, 0, 1)));
    return (byte(r) | byte(g) << 8 | byte(b) << 16 | Math.round(255 * place) << 24) >>> 0;
  }
  // The colour of a body that does not depend on time; null: place it on the scale.
  fixedColor(body) {
    if (this.by === 'own' && body.color) return this.packed(body.color.map(linearOf));
    if (body.motion === FIXED) return this.packed(STONE);
    if (body.motion === KINEMATIC) return this.packed(KINEMATIC_COLOR);
    if (this.by === 'plain') return this.packed(PLAIN);
    if (this.by === 'body') return this.packed(nameColor(body.id));
    if (this.by === 'own') return this.packed(UNCOLORED);
    return this.by === 'sleep' && body.motion === DYNAMIC ? null : this.scale ? null : this.packed(UNCOLORED);
  }
  at(value) { return this.table[Math.round(this.scale.place(value) * (PLACES - 1))]; }
}
