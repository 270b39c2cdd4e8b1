// A section as an image: a column for each profile, a row for each cell of depth.

import type { Columns, Spot } from '../../lib/steps';
import { ordinal } from '../../lib/units';
import type { SectionAnswer } from './answers';
import type { Axis, Pen } from './sheet';

/** A column reaches half-way to its neighbours, but never farther than this many usual distances: a gap stays a gap. */
const REACH = 1.5;

export interface Column {
  readonly begin: number;
  readonly end: number;
}

/** What a section goes over from left to right: when, or how far along the track. */
export interface Over {
  /** The stretch that each profile stands for; null for one of which it is not known. */
  readonly columns: readonly (Column | null)[];
  readonly axis: Axis;
  /** Whether any profile can stand on it. */
  readonly isKnown: boolean;
}

export function overTime(section: SectionAnswer): Over {
  return over(section.profiles.map((profile) => profile.time), 3600, { label: '', isTime: true });
}

export function overDistance(section: SectionAnswer): Over {
  const km = section.profiles.map((profile) => (profile.distance === null ? null : profile.distance / 1000));
  return over(km, 1, { label: 'Distance along the track, km' });
}

function over(middles: readonly (number | null)[], alone: number, about: Omit<Axis, 'low' | 'high'>): Over {
  const columns = columnsOf(middles, alone);
  const known = columns.filter((column) => column !== null);
  return { columns, axis: { ...about, low: known[0]?.begin ?? 0, high: known.at(-1)?.end ?? 1 }, isKnown: known.length > 0 };
}

/** The stretch that each profile stands for about its middle; `alone` is the width of one without neighbours. */
export function columnsOf(middles: readonly (number | null)[], alone: number): (Column | null)[] {
  const known = middles.filter((middle) => middle !== null);
  const steps = known.slice(1).map((middle, index) => middle - (known[index] ?? middle)).sort((a, b) => a - b);
  const usual = steps[Math.floor(steps.length / 2)] || alone;
  let place = -1;
  return middles.map((middle) => {
    if (middle === null) return null;
    place += 1;
    const [left, right] = [known[place - 1], known[place + 1]];
    const before = left === undefined ? usual / 2 : (middle - left) / 2;
    const after = right === undefined ? usual / 2 : (right - middle) / 2;
    return { begin: middle - Math.min(before, REACH * usual), end: middle + Math.min(after, REACH * usual) };
  });
}

/** Least and greatest value without the outermost 1 %, which would take the colours from all others. */
export function colourRange(values: readonly (readonly (number | null)[])[]): [number, number] | null {
  const present = values.flat().filter((value): value is number => value !== null).sort((a, b) => a - b);
  if (present.length === 0) return null;
  const low = present[Math.floor(0.01 * (present.length - 1))] ?? 0;
  const high = present[Math.ceil(0.99 * (present.length - 1))] ?? 0;
  return high > low ? [low, high] : [low - 0.5, low + 0.5];
}

/** Whether most cells between the first and the last of each column have a value. */
export function isDense(values: readonly (readonly (number | null)[])[]): boolean {
  let cells = 0;
  let full = 0;
  for (const column of values) {
    const first = column.findIndex((value) => value !== null);
    const last = column.findLastIndex((value) => value !== null);
    if (first < 0) continue;
    cells += last - first + 1;
    full += column.filter((value) => value !== null).length;
  }
  return full >= 0.9 * cells;
}

export function drawSection(
  it: Pen, section: SectionAnswer, columns: readonly (Column | null)[], range: [number, number], colours: Uint8ClampedArray,
): void {
  const half = section.cell_m / 2;
  section.values.forEach((values, index) => {
    const column = columns[index];
    if (!column) return;
    // Whole pixels: no seams between the cells.
    const left = Math.round(it.x(column.begin));
    const width = Math.max(1, Math.round(it.x(column.end)) - left);
    values.forEach((value, row) => {
      const depth = section.depth_m[row];
      if (value === null || depth === undefined) return;
      const share = Math.min(1, Math.max(0, (value - range[0]) / (range[1] - range[0])));
      const at = 4 * Math.round(share * 255);
      it.context.fillStyle = `rgb(${colours[at]} ${colours[at + 1]} ${colours[at + 2]})`;
      const top = Math.round(it.y(depth - half));
      it.context.fillRect(left, top, width, Math.max(1, Math.round(it.y(depth + half)) - top));
    });
  });
}

/** The cell under a place; null beside all columns. */
export function cellAt(section: SectionAnswer, columns: readonly (Column | null)[], at: { x: number; y: number }): Spot | null {
  const column = columns.findIndex((one) => one !== null && at.x >= one.begin && at.x <= one.end);
  const row = section.depth_m.findIndex((middle) => Math.abs(middle - at.y) <= section.cell_m / 2);
  return column < 0 || row < 0 ? null : { column, row };
}

/** All cells, as a cursor goes over them. */
export function cellsOf(section: SectionAnswer): Columns {
  return section.profiles.map(() => section.depth_m);
}

/** How many profiles and samples stand behind what is drawn. */
export function madeOf(section: SectionAnswer): string {
  const counts = section.samples.flat().filter((count) => count > 0);
  const least = counts.reduce((low, count) => Math.min(low, count), Infinity);
  const most = counts.reduce((high, count) => Math.max(high, count), 0);
  const profiles = `${section.profiles.length} profiles${section.stride > 1 ? `, every ${ordinal(section.stride)} shown` : ''}`;
  if (most === 0) return profiles;
  if (most === 1) return `${profiles}; each cell one sample`;
  return `${profiles}; each cell the mean of ${least === most ? least : `${least} to ${most}`} samples`;
}
