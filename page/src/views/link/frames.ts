/** A MAVLink frame taken apart as far as its header says; the fields of a message come from the station. */

export type { Frame as FrameRow } from '../../lib/types';

export interface FramePart {
  from: number;
  to: number;
  kind: 'mark' | 'header' | 'payload' | 'checksum' | 'signature';
  words: string;
}

/** The bytes of hexadecimal digits. */
export function bytesOf(hex: string): Uint8Array {
  const tidy = hex.replace(/[^0-9a-fA-F]/g, '');
  const bytes = new Uint8Array(Math.floor(tidy.length / 2));
  for (let index = 0; index < bytes.length; index++)
    bytes[index] = Number.parseInt(tidy.slice(2 * index, 2 * index + 2), 16);
  return bytes;
}

/** Stretches of a frame and what they are; of what is no frame, one stretch. */
export function partsOf(bytes: Uint8Array): FramePart[] {
  const second = bytes[0] === 0xfd;
  const header = second ? 10 : 6;
  const length = bytes[1] ?? 0;
  if ((bytes[0] !== 0xfd && bytes[0] !== 0xfe) || bytes.length < header + length + 2)
    return [{ from: 0, to: bytes.length, kind: 'payload', words: 'bytes that are no whole frame' }];
  const parts: FramePart[] = [
    { from: 0, to: 1, kind: 'mark', words: second ? 'start of a MAVLink 2 frame' : 'start of a MAVLink 1 frame' },
    { from: 1, to: header, kind: 'header', words: 'length, flags, sequence, system, component, message' },
    { from: header, to: header + length, kind: 'payload', words: `payload, ${length} bytes` },
    { from: header + length, to: header + length + 2, kind: 'checksum', words: 'checksum' },
  ];
  if (second && bytes.length >= header + length + 15)
    parts.push({
      from: header + length + 2,
      to: header + length + 15,
      kind: 'signature',
      words: 'link, time stamp and signature',
    });
  return parts.filter((part) => part.to > part.from);
}

/** One line of a dump: offset, the bytes with their parts, and the characters. */
export interface DumpLine {
  offset: string;
  cells: { hex: string; kind: FramePart['kind'] }[];
  text: string;
}

/** A frame as lines of so many bytes. */
export function dump(bytes: Uint8Array, width = 16): DumpLine[] {
  const parts = partsOf(bytes);
  const kinds = Array.from(
    bytes,
    (_, index) => parts.find((part) => index >= part.from && index < part.to)?.kind ?? 'payload',
  );
  const lines: DumpLine[] = [];
  for (let from = 0; from < bytes.length; from += width) {
    const row = bytes.slice(from, from + width);
    lines.push({
      offset: from.toString(16).padStart(4, '0'),
      cells: Array.from(row, (byte, index) => ({
        hex: byte.toString(16).padStart(2, '0'),
        kind: kinds[from + index] ?? 'payload',
      })),
      text: Array.from(row, (byte) => (byte >= 32 && byte < 127 ? String.fromCharCode(byte) : '·')).join(''),
    });
  }
  return lines;
}

/** A value of a field in words. */
export function fieldWords(value: unknown): string {
  if (value === null || value === undefined) return 'not a number';
  if (Array.isArray(value)) return value.map(fieldWords).join(' ');
  if (typeof value === 'number' && !Number.isInteger(value)) return String(Number(value.toPrecision(8)));
  return typeof value === 'object' ? JSON.stringify(value) : String(value);
}
