// From the answers of the archive, and what came since, to what is drawn.

export interface Trace {
  readonly t: readonly number[];
  readonly value: readonly (number | null)[];
  readonly samples: number;
  readonly reduced: boolean;
}

export type Traces = ReadonlyMap<string, Trace>;

export interface Aligned {
  readonly t: number[];
  readonly values: (number | null | undefined)[][];
}

/**
 * Several traces on one axis of times. A value that a trace does not have at a time of another one is undefined (the
 * line goes on over it); null is a gap and stays one.
 */
export function aligned(traces: readonly (Trace | undefined)[]): Aligned {
  const present = traces.filter((trace): trace is Trace => trace !== undefined && trace.t.length > 0);
  if (present.length === 1) {
    const only = present[0]!;
    return { t: [...only.t], values: traces.map((trace) => (trace === only ? [...only.value] : [])) };
  }
  const places = traces.map(() => 0);
  const t: number[] = [];
  const values: (number | null | undefined)[][] = traces.map(() => []);
  for (;;) {
    const next = earliest(traces, places);
    if (next === Infinity) return { t, values };
    t.push(next);
    traces.forEach((trace, index) => {
      const place = places[index]!;
      const isHere = trace !== undefined && place < trace.t.length && trace.t[place] === next;
      values[index]!.push(isHere ? trace.value[place] : undefined);
      if (isHere) places[index] = place + 1;
    });
  }
}

function earliest(traces: readonly (Trace | undefined)[], places: readonly number[]): number {
  let next = Infinity;
  traces.forEach((trace, index) => {
    const t = trace?.t[places[index]!];
    if (t !== undefined && t < next) next = t;
  });
  return next;
}

/** The greatest distance in time over which two samples still belong to one line. */
export function gapAfter(period_s: number | null | undefined): number {
  return period_s && period_s > 0 ? 5 * period_s : Infinity;
}

/** The trace with later samples behind it; a null between two that are too far apart; older ones than begin fall off. */
export function extended(
  trace: Trace | undefined, t: readonly number[], value: readonly (number | null)[], begin: number, gap_s: number,
): Trace {
  const times = trace ? [...trace.t] : [];
  const values = trace ? [...trace.value] : [];
  t.forEach((time, index) => {
    const last = times.at(-1);
    if (last !== undefined && time <= last) return;
    if (last !== undefined && time - last > gap_s && values.at(-1) !== null) {
      times.push((last + time) / 2);
      values.push(null);
    }
    times.push(time);
    values.push(value[index] ?? null);
  });
  let first = 0;
  while (first + 1 < times.length && times[first + 1]! < begin) first += 1;
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
  let low = 0;
  let high = trace.t.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (trace.t[middle]! < time) low = middle + 1;
    else high = middle;
  }
  let left = low;
  while (left >= 0 && (trace.value[left] == null || trace.t[left]! > time)) left -= 1;
  let right = low;
  while (right < trace.t.length && (trace.value[right] == null || trace.t[right]! < time)) right += 1;
  if (left < 0) return right < trace.t.length ? right : -1;
  if (right >= trace.t.length) return left;
  return time - trace.t[left]! <= trace.t[right]! - time ? left : right;
}
