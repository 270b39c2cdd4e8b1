// A section as an image: a column for each profile, a row for each cell of depth.

import type { SectionAnswer } from './answers';
import type { Pen } from './sheet';

/** A column reaches half-way to its neighbours, but never farther than this many usual distances: a gap stays a gap. */
const REACH = 1.5;

export interface Column {
  readonly begin: number;
  readonly end: number;
}

/** The stretch of time that each profile stands for. */
export function columnsOf(times: readonly number[]): Column[] {
  const steps = times.slice(1).map((t, index) => t - (times[index] ?? t)).sort((a, b) => a - b);
  const usual = steps[Math.floor(steps.length / 2)] ?? 3600;
  return times.map((t, index) => {
    const before = index > 0 ? (t - (times[index - 1] ?? t)) / 2 : usual / 2;
    const after = index + 1 < times.length ? ((times[index + 1] ?? t) - t) / 2 : usual / 2;
    return { begin: t - Math.min(before, REACH * usual), end: t + Math.min(after, REACH * usual) };
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
  it: Pen, section: SectionAnswer, columns: readonly Column[], range: [number, number], colours: Uint8ClampedArray,
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

/** The value in the cell under a place; null beside all cells. */
export function cellAt(
  section: SectionAnswer, columns: readonly Column[], t: number, depth: number,
): { profile: number; value: number | null } | null {
  const index = columns.findIndex((column) => t >= column.begin && t <= column.end);
  const profile = section.profiles[index];
  if (!profile) return null;
  const row = section.depth_m.findIndex((middle) => Math.abs(middle - depth) <= section.cell_m / 2);
  return { profile: profile.profile_number, value: section.values[index]?.[row] ?? null };
}
