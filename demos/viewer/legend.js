// The legend of colours: the scale's bar with its ticks (parts/legend.html).
import { numberText } from './colors.js';

const element = (id) => document.getElementById(id);

export function drawLegend(palette) {
  const legend = element('legend'), { scale } = palette;
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
