/** Dives as they were flown beside those of the preview, and their sums, in words: a table's groups of lines. */

import type { Comparison } from '../../lib/types';
import { dateTime, distance, duration, latitude, longitude, number } from '../../lib/units';
import { energyWords } from './geometry';

type Compared = Comparison['dives'][number];
type Flown = NonNullable<Compared['flown']>;
type Predicted = NonNullable<Compared['predicted']>;
type Total = NonNullable<NonNullable<Comparison['so_far']>['time_s']>;
type Known = number | null | undefined;

/** Of the columns behind the first. */
export const COLUMNS = ['Ends, UTC', 'Lasts', 'Way', 'Depth', 'Energy'] as const;

export interface Line {
  what: 'flown' | 'predicted' | 'difference';
  /** One for each column. */
  cells: string[];
}

export interface Group {
  id: string;
  title: string;
  note: string;
  lines: Line[];
}

/** The mission so far, then its dives that were flown, the newest first. */
export function groupsOf({ dives, so_far }: Comparison): Group[] {
  const flown = dives.filter((row) => row.flown !== null).reverse();
  return [...(so_far ? [missionGroup(so_far)] : []), ...flown.map(diveGroup)];
}

/** Where the vehicle was seen last, and where it was farthest, off the predicted track. */
export function offTrackWords(fixes: Comparison['fixes']): string {
  const last = fixes.at(-1);
  if (!last) return '';
  const farthest = fixes.reduce((most, fix) => (fix.off_track_m > most.off_track_m ? fix : most));
  const words = `${distance(last.off_track_m)} off the predicted track at its last fix, ${dateTime(last.t, false)} UTC`;
  return farthest === last ? `${words}.` : `${words}; at most ${distance(farthest.off_track_m)} at its last ${fixes.length} fixes, ${dateTime(farthest.t, false)} UTC.`;
}

/** What the preview foretold of the mission as a whole. */
export function totalsWords({ duration_s, energy_j, distance_m, dive_count }: NonNullable<Comparison['prediction']>): string {
  const told = [
    typeof duration_s === 'number' ? duration(duration_s) : '',
    typeof dive_count === 'number' ? `${dive_count} dives` : '',
    typeof distance_m === 'number' ? `${distance(distance_m)} over ground` : '',
    typeof energy_j === 'number' ? energyWords(energy_j) : '',
  ];
  return told.filter(Boolean).join(', ');
}

function missionGroup({ first, last, time_s, energy_j, distance_m }: NonNullable<Comparison['so_far']>): Group {
  const most = Math.max(...[time_s, energy_j, distance_m].map((total) => total?.dives ?? 0));
  const part = (total: Total | null, name: string): string[] => (total && total.dives < most ? [`${name} of ${total.dives}`] : []);
  const dives = first === last ? `dive ${first}` : `dives ${first} to ${last}`;
  const line = (what: 'flown' | 'predicted'): Line => ({
    what,
    cells: ['', duration(time_s?.[what]), distance(distance_m?.[what]), '', energy(energy_j?.[what])],
  });
  return {
    id: 'so far',
    title: 'Mission so far',
    note: [dives, ...part(time_s, 'time'), ...part(distance_m, 'way'), ...part(energy_j, 'energy')].join(', '),
    lines: [
      line('flown'),
      line('predicted'),
      {
        what: 'difference',
        cells: ['', signed(time_s?.difference, duration), signed(distance_m?.difference, distance), '', signed(energy_j?.difference, energy)],
      },
    ],
  };
}

function diveGroup({ dive, predicted, flown, difference, off_track_m, predicted_way_m, flown_way_m }: Compared): Group {
  const lines: Line[] = [{ what: 'flown', cells: cellsOf(flown, flown_way_m) }];
  if (predicted) lines.push({ what: 'predicted', cells: cellsOf(predicted, predicted_way_m) });
  if (difference) {
    const { end_s, duration_s, depth_m, energy_j } = difference;
    const way = flown_way_m === null || predicted_way_m === null ? null : flown_way_m - predicted_way_m;
    lines.push({
      what: 'difference',
      cells: [signed(end_s, duration), signed(duration_s, duration), signed(way, distance), signed(depth_m, depth), signed(energy_j, energy)],
    });
  }
  return { id: `dive ${dive}`, title: `Dive ${dive}`, note: placeWords(flown, difference?.distance_m, off_track_m), lines };
}

function cellsOf(row: Flown | Predicted | null, way: number | null): string[] {
  const lasts = row === null || row.t_end === null ? null : row.t_end - row.t_begin;
  return [row?.t_end ? dateTime(row.t_end, false).slice(5) : '–', duration(lasts), distance(way), depth(row?.greatest_depth_m), energy(row?.energy_j)];
}

function placeWords(flown: Flown | null, away: Known, off: number | null): string {
  if (flown === null || flown.latitude_end === null || flown.longitude_end === null) return '';
  const words = [`ended at ${latitude(flown.latitude_end)} ${longitude(flown.longitude_end)}`];
  if (typeof away === 'number') words.push(`${distance(away)} from the predicted place`);
  if (off !== null) words.push(`${distance(off)} off the predicted track`);
  return words.join(', ');
}

function depth(metres: Known): string {
  return typeof metres === 'number' ? `${number(metres, 1)}\u202fm` : '–';
}

function energy(joules: Known): string {
  if (typeof joules !== 'number') return '–';
  return Math.abs(joules) < 1e6 ? `${number(joules / 1e3, 1)}\u202fkJ` : `${number(joules / 1e6, 2)}\u202fMJ`;
}

function signed(value: Known, words: (size: number) => string): string {
  if (typeof value !== 'number') return '–';
  const size = words(Math.abs(value));
  return /[1-9]/.test(size) ? `${value < 0 ? '−' : '+'}${size}` : size;
}
