// A dive in the log book: how it went, and where its data are.

import type { LogEntry } from '../../lib/types';
import { clockTime, duration, latitude, longitude, quantity } from '../../lib/units';

type Dive = NonNullable<LogEntry['dive']>;

/** How long, from where to where, with how much energy: what is known of it. */
export function courseOf(dive: Dive): string {
  const lasted = dive.t_end === null ? 'under way' : `${duration(dive.t_end - dive.t_begin)}, until ${clockTime(dive.t_end)}`;
  const [from, to] = [place(dive.latitude_begin, dive.longitude_begin), place(dive.latitude_end, dive.longitude_end)];
  const places = [from && `from ${from}`, to && `to ${to}`].filter(Boolean).join(' ');
  const energy = dive.energy_j === null ? '' : quantity(dive.energy_j / 1000, 'kJ', 1);
  return [lasted, places, energy].filter(Boolean).join('; ');
}

/** The query of the data view that shows this dive alone; while it goes on, all since it began. */
export function dataOf(dive: Dive): Record<string, string | number> {
  const begin = { show: 'dives', begin: Math.floor(dive.t_begin) };
  return dive.t_end === null ? begin : { ...begin, end: Math.ceil(dive.t_end) - 1 }; // the next one may begin as it ends
}

function place(north: number | null, east: number | null): string {
  return north === null || east === null ? '' : `${latitude(north)} ${longitude(east)}`;
}
