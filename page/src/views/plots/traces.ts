// From the answers of the archive, and what came since, to what is drawn.

import { staying } from '../../lib/clock.svelte';
import type { Line } from '../../lib/turns';

export interface Trace extends Line {
  readonly samples: number;
  readonly reduced: boolean;
}

export type Traces = ReadonlyMap<string, Trace>;

type Drawn = (number | null | undefined)[];

export interface Aligned {
  readonly t: number[];
  readonly values: Drawn[];
}

/**
 * Several traces on one axis of times. A value that a trace does not have at a time of another one is undefined (the
 * line goes on over it); null is a gap and stays one.
 */
export function aligned(traces: readonly (Line | undefined)[]): Aligned {
  const rows = traces.map((trace) => ({ t: trace?.t ?? [], value: trace?.value ?? [], place: 0, drawn: [] as Drawn }));
  const t: number[] = [];
  for (;;) {
    let next = Infinity;
    for (const row of rows) next = Math.min(next, row.t[row.place] ?? Infinity);
    if (next === Infinity) return { t, values: rows.map((row) => row.drawn) };
    t.push(next);
    for (const row of rows) {
      const isHere = row.t[row.place] === next;
      row.drawn.push(isHere ? row.value[row.place] : undefined);
      if (isHere) row.place += 1;
    }
  }
}

/** The greatest distance in time over which two samples still belong to one line. */
export function gapAfter(period_s: number | null | undefined): number {
  return period_s && period_s > 0 ? 5 * period_s : Infinity;
}

/** The archive keeps whole microseconds: times that are nearer than that are one. */
export const SAME_S = 1.5e-6;

/**
 * The trace with later samples behind it; a null between two that are too far apart; older ones than begin fall off.
 * Where the vehicle's clock was set back, what lies ahead of it falls off too: the archive has it.
 */
export function extended(
  trace: Trace | undefined, t: readonly number[], value: readonly (number | null)[], begin: number, gap_s: number,
): Trace {
  const times = trace ? [...trace.t] : [];
  const values = trace ? [...trace.value] : [];
  t.forEach((time, index) => {
    times.length = values.length = staying(times, time);
    const last = times.at(-1);
    if (last !== undefined && time <= last + SAME_S) return;
    if (last !== undefined && time - last > gap_s && values.at(-1) !== null) {
      times.push((last + time) / 2);
      values.push(null);
    }
    times.push(time);
    values.push(value[index] ?? null);
  });
  let first = 0;
  while (first + 1 < times.length && (times[first + 1] ?? Infinity) < begin) first += 1;
  return {
    t: first ? times.slice(first) : times,
    value: first ? values.slice(first) : values,
    samples: (trace?.samples ?? 0) + t.length,
    reduced: trace?.reduced ?? false,
  };
}

/** The place of the sample nearest to a time, among those that have a value; -1 where there is none. */
export function nearest(trace: Trace | undefined, time: number): number {
  if (!trace || trace.t.length === 0) return -1;
  const t = (place: number): number => trace.t[place] ?? NaN;
  const has = (place: number): boolean => typeof trace.value[place] === 'number';
  let low = 0;
  let high = trace.t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (t(middle) < time) low = middle + 1;
    else high = middle;
  }
  let right = low;
  while (right < trace.t.length && !has(right)) right += 1;
  let left = low - 1;
  while (left >= 0 && !has(left)) left -= 1;
  if (right >= trace.t.length) return left;
  return left < 0 || t(right) - time < time - t(left) ? right : left;
}
