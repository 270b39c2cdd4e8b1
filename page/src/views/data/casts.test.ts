// Oracle: samples put in order by hand.
import { expect, it } from 'vitest';

import { castOf, castsOf } from './casts';
import { readingWords } from './reading';
import { spotNear } from './profiles';

it('has the samples of each profile from the surface down, without those of no depth', () => {
  const casts = castsOf([2, 2, 1, 0, 1, 1], [30, 10, 5, 0, 25, null]);
  expect(casts.map(({ profile, samples }) => [profile, samples])).toEqual([[0, [3]], [1, [2, 4]], [2, [1, 0]]]);
  expect(casts[2]?.depth).toEqual([10, 30]);
});

it('finds the sample nearest to the pointer, both axes counted by their spans', () => {
  const casts = [castOf(1, [0, 1], [0, 100]), castOf(2, [0, 1], [0, 100])];
  const values = [[10, 20], [12, null]];
  const near = (x: number, y: number): unknown =>
    spotNear(casts, (column) => values[column] ?? [], { low: 10, high: 20, label: '' }, { low: 0, high: 100, label: '' }, { x, y });
  expect(near(11.5, 10)).toEqual({ column: 1, row: 0 });
  expect(near(12, 90)).toEqual({ column: 0, row: 1 });
});

it('says of which profile a reading is', () => {
  const where = { depth_m: 12.34, t: 1_700_000_000 };
  expect(readingWords('17.2 °C', { ...where, profile: 3 })).toBe('17.2 °C at 12.3 m, 2023-11-14 22:13, profile 3');
  expect(readingWords('17.2 °C', { ...where, profile: 0 }, 0)).toBe('17.2 °C at 12 m, 2023-11-14 22:13, between profiles');
});
