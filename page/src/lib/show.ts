// How a channel's number is shown: words for states, per cent for shares, degrees and minutes for places.

import type { Channel } from './types';
import { readAround } from './turns';
import { digitsFor, duration, latitude, longitude } from './units';

export interface Shown {
  value: number | null;
  unit: string;
  words?: string;
}

export function shown(channel: Channel, value: number | null | undefined): Shown {
  if (value === null || value === undefined || !Number.isFinite(value)) return { value: null, unit: channel.unit };
  const words = wordsOf(channel, value);
  if (words !== undefined) return { value, unit: '', words };
  if (channel.key.endsWith('_share')) return { value: value * 100, unit: '%' };
  return { value: readAround(value, channel, digitsFor(value, channel.unit)), unit: channel.unit };
}

function wordsOf(channel: Channel, value: number): string | undefined {
  const named = channel.values?.[String(Math.round(value))];
  if (named !== undefined) return named;
  if (channel.key === 'latitude_deg') return latitude(value);
  if (channel.key === 'longitude_deg') return longitude(value);
  if (channel.unit === 's' && channel.group !== 'link') return duration(value);
  const isFlag = channel.unit === '' && channel.low === 0 && channel.high === 1 && !channel.key.endsWith('_share');
  return isFlag ? (value >= 0.5 ? 'yes' : 'no') : undefined;
}

/** A limit in the unit in which the value is shown. */
export function shownLimit(channel: Channel, limit: number | null | undefined): number | null {
  return limit === null || limit === undefined ? null : channel.key.endsWith('_share') ? limit * 100 : limit;
}
