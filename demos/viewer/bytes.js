// Reads the numbers of chunks, as demos/film/pages/chunk_bytes.h writes them.

const texts = new TextDecoder();

export class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }
  get left() { return this.bytes.length - this.at; }
  u8() { return this.view.getUint8(this.at++); }
  u32() { this.at += 4; return this.view.getUint32(this.at - 4, true); }
  f32() { this.at += 4; return this.view.getFloat32(this.at - 4, true); }
  f64() { this.at += 8; return this.view.getFloat64(this.at - 8, true); }
  floats(count) { return Array.from({ length: count }, () => this.f32()); }
  // Numbers beyond 2^31 are none that this format has.
  count() {
    let value = 0, shift = 0, byte;
    do {
      byte = this.view.getUint8(this.at++);
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return value >>> 0;
  }
  integer() { const bits = this.count(); return (bits >>> 1) ^ -(bits & 1); }
  slice(length) {
    if (length > this.left) throw new Error('the recording ends within a chunk');
    this.at += length;
    return this.bytes.subarray(this.at - length, this.at);
  }
  part() { return this.slice(this.count()); }
  text() { return texts.decode(this.part()); }
}

// The chunks of a block: [{ name, bytes }].
export function chunksOf(bytes) {
  const reader = new Reader(bytes), chunks = [];
  while (reader.left > 0) {
    const name = String.fromCharCode(...reader.slice(4));
    chunks.push({ name, bytes: reader.slice(reader.u32()) });
  }
  return chunks;
}

export function bytesOfBase64(text) {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// The chunks' bytes of a block as it is sent: a 0 and these, or a 1 and a zlib stream of them.
export async function unpacked(block) {
  if (block[0] === 0) return block.subarray(1);
  if (block[0] !== 1) throw new Error('the recording is packed in a way that this page does not know');
  const stream = new Blob([block.subarray(1)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
