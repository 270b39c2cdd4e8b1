// Oracle: written out by hand.
import { describe, expect, it } from 'vitest';
import { groupsOf, offTrackWords, totalsWords } from './compared';

const plain = (words: string): string => words.replaceAll('\u202f', ' ');
const fix = (minute: number, off: number): { t: number; lat: number; lon: number; off_track_m: number } => ({
  t: 60 * minute,
  lat: 28.7,
  lon: 126.1,
  off_track_m: off,
});
const total = (dives: number, predicted: number, flown: number): { dives: number; predicted: number; flown: number; difference: number } => ({
  dives,
  predicted,
  flown,
  difference: flown - predicted,
});
const nothing = { mission: 'Out', t: 0, dives: [], reason: null, prediction: null, so_far: null, fixes: [], left_geofence: null };

describe('flown against predicted', () => {
  it('tells the last fix, and the farthest where that is another one', () => {
    expect(offTrackWords([])).toBe('');
    expect(plain(offTrackWords([fix(1, 20), fix(2, 130)]))).toBe('130 m off the predicted track at its last fix, 1970-01-01 00:02 UTC.');
    expect(plain(offTrackWords([fix(1, 1500), fix(2, 130)]))).toBe(
      '130 m off the predicted track at its last fix, 1970-01-01 00:02 UTC; at most 1.5 km at its last 2 fixes, 1970-01-01 00:01 UTC.',
    );
  });

  it('tells of what a preview foretold what it told', () => {
    expect(plain(totalsWords({ duration_s: 7200, energy_j: 90_000, distance_m: 4500, dive_count: 12, track: [] }))).toBe(
      '2 h 00 min, 12 dives, 4.5 km over ground, 25 Wh',
    );
    expect(totalsWords({ duration_s: null, energy_j: null, distance_m: null, track: [] })).toBe('');
  });

  it('says of how many dives a sum is, where it is not of all', () => {
    const so_far = { first: 1, last: 9, time_s: total(8, 7200, 9000), energy_j: total(3, 2e6, 1.5e6), distance_m: null };
    const [mission] = groupsOf({ ...nothing, so_far });
    expect(mission?.note).toBe('dives 1 to 9, energy of 3');
    expect(mission?.lines.map((line) => plain([line.what, ...line.cells].join('|')))).toEqual([
      'flown||2 h 30 min|–||1.50 MJ',
      'predicted||2 h 00 min|–||2.00 MJ',
      'difference||+30 min|–||−500.0 kJ',
    ]);
  });

  it('shows a dive that nobody predicted, and leaves out what was not flown', () => {
    const place = { latitude_begin: 0, longitude_begin: 0, latitude_end: null, longitude_end: null };
    const flown = { dive: 7, t_begin: 0, t_end: null, ...place, greatest_depth_m: 68, current_north_m_s: null, current_east_m_s: null, energy_j: null };
    const row = { dive: 1, predicted: null, flown, difference: null, predicted_way_m: null, flown_way_m: null, off_track_m: null };
    const found = groupsOf({ ...nothing, dives: [row, { ...row, dive: 2, flown: null }] });
    expect(found.map((group) => [group.title, group.note])).toEqual([['Dive 1', '']]);
    expect(found[0]?.lines.map((line) => plain(line.cells.join('|')))).toEqual(['–|–|–|68.0 m|–']);
  });
});
