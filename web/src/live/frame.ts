// The binary frame of docs/wire.md: little-endian header of 24 bytes, then one column of float32 per channel.

export const VERSION = 1;
export const KIND_SAMPLES = 1;
export const HEADER_BYTES = 24;

export interface SampleFrame {
  readonly firstTick: number;
  readonly samples: number;
  /** Ticks that this client missed just before this frame. */
  readonly lostTicks: number;
  readonly subscription: number;
  /** One column per subscribed channel, in the order of the subscription. */
  readonly columns: readonly Float32Array[];
}

export class FrameError extends Error {}

/** Reads one frame. @throws FrameError where version, kind or size are not what they must be. */
export function decodeFrame(buffer: ArrayBuffer): SampleFrame {
  if (buffer.byteLength < HEADER_BYTES)
    throw new FrameError(`Frame of ${buffer.byteLength} bytes has no whole header`);
  const view = new DataView(buffer);
  const version = view.getUint8(0);
  if (version !== VERSION) throw new FrameError(`Frame version ${version} is not known, ${VERSION} is`);
  const kind = view.getUint8(1);
  if (kind !== KIND_SAMPLES) throw new FrameError(`Frame kind ${kind} is not known`);

  const channels = view.getUint16(2, true);
  const samples = view.getUint32(4, true);
  const expected = HEADER_BYTES + 4 * channels * samples;
  if (buffer.byteLength !== expected) {
    throw new FrameError(
      `Frame of ${buffer.byteLength} bytes, ${expected} expected for ${channels} × ${samples}`,
    );
  }
  return {
    firstTick: Number(view.getBigInt64(8, true)),
    samples,
    lostTicks: view.getUint32(16, true),
    subscription: view.getUint32(20, true),
    columns: Array.from({ length: channels }, (_, channel) => column(buffer, channel, samples)),
  };
}

const HOST_IS_LITTLE_ENDIAN = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

function column(buffer: ArrayBuffer, channel: number, samples: number): Float32Array {
  const offset = HEADER_BYTES + 4 * channel * samples;
  if (HOST_IS_LITTLE_ENDIAN) return new Float32Array(buffer, offset, samples);
  const view = new DataView(buffer, offset);
  return Float32Array.from({ length: samples }, (_, i) => view.getFloat32(4 * i, true));
}
