// Where frames come from. A source has `scene`, `count` (frames so far), `seconds` (from one to the next), `now` and `before` (two
// moments one after the other), and show(frame): whether `before` and `now` are those about that frame; if not it fetches them, and
// calls `onReady`. A live source (live.js) has the same, and a growing `count`.
import { bytesOfBase64, chunksOf, unpacked } from './bytes.js';
import { FrameDecoder } from './frames.js';
import { Scene } from './scene.js';

const MOST_KEPT = 6;  // blocks of frames that stay unpacked

// A recording in the page's own elements, which hold blocks as base64.
export class RecordedSource {
  constructor(elements) {
    this.scene = new Scene();
    this.blocks = [];
    this.others = [];
    this.count = 0;
    this.onReady = () => {};
    this.live = false;
    for (const element of elements) {
      if (element.dataset.kind !== 'frames') {
        this.others.push(element);
        continue;
      }
      const block = { element, first: Number(element.dataset.first), frames: Number(element.dataset.frames),
        whole: element.dataset.whole === '1', chunks: null, pending: null };
      this.blocks.push(block);
      this.count = block.first + block.frames;
    }
    this.kept = [];
  }

  async open() {
    for (const element of this.others)
      for (const chunk of chunksOf(await unpacked(bytesOfBase64(element.textContent)))) this.scene.take(chunk);
    if (!this.scene.head || this.count === 0) throw new Error('the page holds no recording');
    this.seconds = this.scene.head.seconds;
    this.decoder = this.newDecoder();
    await this.load(this.blocks[0]);
  }
  newDecoder() {
    const decoder = new FrameDecoder(this.scene.head.units);
    decoder.planes = this.scene.bodies.map((body) => body.plane !== null);
    return decoder;
  }

  get before() { return this.decoder.before; }
  get now() { return this.decoder.now; }

  // The block's frames, now or later.
  async load(block) {
    if (block.chunks) return block.chunks;
    block.pending ??= unpacked(bytesOfBase64(block.element.textContent)).then((bytes) => {
      block.chunks = chunksOf(bytes).filter(({ name }) => name === 'fram');
      block.pending = null;
      this.keep(block);
      return block.chunks;
    });
    return block.pending;
  }
  keep(block) {
    this.kept = [...this.kept.filter((other) => other !== block), block];
    while (this.kept.length > MOST_KEPT) this.kept.shift().chunks = null;
  }
  blockOf(frame) {
    let low = 0, high = this.blocks.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.blocks[middle].first <= frame) low = middle; else high = middle - 1;
    }
    return low;
  }
  // The last frame up to this one at which decoding may begin.
  wholeBefore(frame) {
    let block = this.blockOf(frame);
    while (block > 0 && !this.blocks[block].whole) --block;
    return this.blocks[block].first;
  }

  show(frame) {
    const last = Math.max(0, Math.min(frame + 1, this.count - 1));
    if (this.now.index === last) return true;
    const ahead = this.now.index < last && this.now.index >= 0 && this.now.index + 1 >= this.wholeBefore(Math.max(0, last - 1));
    const from = ahead ? this.now.index + 1 : this.wholeBefore(Math.max(0, last - 1));
    const first = this.blockOf(from), end = this.blockOf(last);
    const missing = this.blocks.slice(first, end + 1).filter((block) => !block.chunks);
    if (missing.length > 0) {
      Promise.all(missing.map((block) => this.load(block))).then(() => this.onReady(), (error) => this.onError?.(error));
      return false;
    }
    for (let index = from, at = first; index <= last; ++index) {
      while (index >= this.blocks[at].first + this.blocks[at].frames) ++at;
      this.decoder.decode(this.blocks[at].chunks[index - this.blocks[at].first].bytes, index);
      this.keep(this.blocks[at]);
    }
    const next = this.blocks[end + 1];
    if (next && !next.chunks && last > this.blocks[end].first + this.blocks[end].frames / 2) this.load(next);
    return true;
  }

  // Calls look(moment, decoder) with every frame in order, a little at a time, until `ended()`.
  async scan(look, ended) {
    const decoder = this.newDecoder();
    let index = 0;
    for (const block of this.blocks) {
      const chunks = block.chunks ?? chunksOf(await unpacked(bytesOfBase64(block.element.textContent))).filter(({ name }) => name === 'fram');
      let begun = performance.now();
      for (const chunk of chunks) {
        if (ended()) return;
        decoder.decode(chunk.bytes, index++);
        look(decoder.now, decoder);
        if (performance.now() - begun > 6) {
          await new Promise((resume) => setTimeout(resume, 4));
          begun = performance.now();
        }
      }
    }
  }
}
