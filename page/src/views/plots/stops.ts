// The samples of a plot as a cursor goes over them: times at which something was received.

import { onLine, onwards, type Step } from '../../lib/steps';
import type { Line } from '../../lib/turns';
import { SAME_S } from './traces';

/** The times in a window at which any of some traces has a value, in their order. */
export function stopsOf(traces: readonly (Line | undefined)[], begin: number, end: number): number[] {
  const times = traces.flatMap((trace) =>
    (trace?.t ?? []).filter((t, place) => t >= begin && t <= end && typeof trace?.value[place] === 'number'),
  );
  return times.sort((a, b) => a - b).filter((t, place) => place === 0 || t - (times[place - 1] ?? t) > SAME_S);
}

/** The stop to which a step leads from a time, at a stop or between two; undefined where none lies that way. */
export function stopAfter(stops: readonly number[], t: number, step: Step): number | undefined {
  const later = stops.findIndex((stop) => stop >= t - SAME_S);
  const next = later < 0 ? stops.length : later;
  const isThere = Math.abs((stops[next] ?? Infinity) - t) <= SAME_S;
  const found = stops[onLine(isThere || onwards(step) < 0 ? next : next - 1, stops.length, step)];
  if (found === undefined || (step.reach !== 'end' && (found - t) * onwards(step) <= SAME_S)) return undefined;
  return found;
}
