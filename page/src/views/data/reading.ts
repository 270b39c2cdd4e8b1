// What is read where the cursor is, in words: the same by pointer and by keys, seen and heard.

import { dateTime, number } from '../../lib/units';
import type { Variable } from './variables';

export interface Where {
  readonly depth_m: number;
  readonly t: number | null | undefined;
  readonly profile: number;
}

export function valueWords(variable: Variable, value: number | null | undefined): string {
  if (value === null || value === undefined) return 'no value';
  return `${number(value, variable.digits)} ${variable.unit}`.trim();
}

export function readingWords(values: string, { depth_m, t, profile }: Where, digits = 1): string {
  const of = profile > 0 ? `profile ${profile}` : 'between profiles';
  return `${values} at ${number(depth_m, digits)} m, ${dateTime(t, false)}, ${of}`;
}
