// Numbers out of base64 text, as src/grove/lab/view/packed_bytes.h wrote them.

/** Bytes that numbers are read from, one after another; all are little-endian. */
export class ByteReader {
  private readonly bytes: Uint8Array;
  private readonly view: DataView;
  at = 0;

  constructor(base64: string) {
    const text = atob(base64);
    this.bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) this.bytes[i] = text.charCodeAt(i);
    this.view = new DataView(this.bytes.buffer);
  }

  get length(): number {
    return this.bytes.length;
  }

  byte(): number {
    return this.view.getUint8(this.at++);
  }

  u16(): number {
    this.at += 2;
    return this.view.getUint16(this.at - 2, true);
  }

  float(): number {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }

  /** Up to 2^53. */
  varint(): number {
    let value = 0;
    let scale = 1;
    for (;;) {
      const byte = this.byte();
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) return value;
      scale *= 128;
    }
  }

  /** A varint that may be negative. */
  signed(): number {
    return unzigzag(this.varint());
  }
}

/** 0, 1, 2, 3 … as 0, -1, 1, -2 …. */
export function unzigzag(value: number): number {
  return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
}

export function readVarints(base64: string, count: number): Float64Array {
  const reader = new ByteReader(base64);
  const values = new Float64Array(count);
  for (let i = 0; i < count; ++i) values[i] = reader.varint();
  return values;
}

export function readBytes(base64: string): Uint8Array {
  const reader = new ByteReader(base64);
  const values = new Uint8Array(reader.length);
  for (let i = 0; i < values.length; ++i) values[i] = reader.byte();
  return values;
}
