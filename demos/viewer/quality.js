// Lowers the quality of pictures while they come too slowly.
import { WORST_QUALITY } from './renderer.js';

const SLOW = 45, PAUSE = 5000;  // ms from picture to picture

export class Governor {
  constructor(renderer) {
    this.renderer = renderer;
    this.paces = [];
  }
  forget() { this.paces = []; }
  // After each picture; `counts`: pictures follow one another as fast as they can.
  drawn(now, counts) {
    const pace = this.last ? now - this.last : 0;
    this.last = now;
    if (!counts || pace <= 0 || pace > PAUSE) return;
    this.paces.push(pace);
    if (this.paces.length < (pace > 150 ? 3 : 16)) return;
    const middle = this.paces.sort((a, b) => a - b)[this.paces.length >> 1];
    this.paces = [];
    if (middle > SLOW && this.renderer.quality < WORST_QUALITY) ++this.renderer.quality;
  }
}
