// Where a value stands between its limits, and how the limits are written.

import { digitsFor, number } from './units';

type End = number | null | undefined;
const known = (end: End): end is number => end !== null && end !== undefined;

/** Share of the room between the limits, or of the one limit, within which a value is near to it. */
const NEAR = 0.05;

/** "≤ 200", "≥ 24", "−45 to 45"; empty where there is none. */
export function limitWords(low: End, high: End, unit: string | undefined): string {
  const write = (end: number): string => number(end, Number.isInteger(end) ? 0 : digitsFor(end, unit));
  if (known(low) && known(high)) return `${write(low)} to ${write(high)}`;
  return known(high) ? `≤\u202f${write(high)}` : known(low) ? `≥\u202f${write(low)}` : '';
}

/** Whether a value within its limits is so near to one of them that a person should know. */
export function isNear(value: End, low: End, high: End): boolean {
  if (!known(value) || Number.isNaN(value)) return false;
  const room = NEAR * (known(low) && known(high) ? high - low : Math.abs((known(high) ? high : low) ?? 0));
  return (known(low) && value >= low && value < low + room) || (known(high) && value <= high && value > high - room);
}

/** Where between both limits a value stands, from 0 to 1; undefined where one is missing. */
export function placeBetween(value: End, low: End, high: End): number | undefined {
  if (!known(value) || !known(low) || !known(high) || high <= low) return undefined;
  return Math.max(0, Math.min(1, (value - low) / (high - low)));
}
