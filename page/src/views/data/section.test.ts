// Oracle: columns and cells of a small section, reckoned by hand.
import { describe, expect, it } from 'vitest';

import type { SectionAnswer } from './answers';
import { cellAt, columnsOf, madeOf, overDistance, overTime } from './section';

function section(distances: (number | null)[], samples: number[][], stride = 1): SectionAnswer {
  return {
    variable: 'temperature',
    words: 'In-situ temperature',
    unit: 'degC',
    cell_m: 2,
    stride,
    depth_m: [1, 3],
    profiles: distances.map((distance, index) => ({
      profile_number: index + 1, profile_direction: 1, time: 1000 * index, latitude: null, longitude: null, distance,
    })),
    values: samples.map((counts) => counts.map((count) => (count ? 10 : null))),
    samples,
  };
}

const FULL = [[1, 1], [1, 1], [1, 1]];

describe('columns', () => {
  it('reach half-way to their neighbours, and over a gap no farther than one and a half usual ways', () => {
    expect(columnsOf([0, 10, 20, 120], 1)).toEqual([
      { begin: -5, end: 5 }, { begin: 5, end: 15 }, { begin: 15, end: 35 }, { begin: 105, end: 125 },
    ]);
  });

  it('go past what has no place', () => {
    expect(columnsOf([0, null, 10], 1)).toEqual([{ begin: -5, end: 5 }, null, { begin: 5, end: 15 }]);
    expect(columnsOf([null], 1)).toEqual([null]);
    expect(columnsOf([7], 4)).toEqual([{ begin: 5, end: 9 }]);
  });

  it('stand over time, or over kilometres along the track', () => {
    const found = section([0, 500, 1500], FULL);
    expect(overTime(found).axis).toMatchObject({ low: -500, high: 2500, isTime: true });
    expect(overDistance(found).axis).toMatchObject({ low: -0.5, high: 2, label: 'Distance along the track, km' });
    expect(overDistance(section([null, null], FULL)).isKnown).toBe(false);
  });
});

it('finds the cell under a place', () => {
  const found = section([0, null, 2000], FULL);
  const { columns } = overDistance(found);
  expect(cellAt(found, columns, { x: 2.4, y: 2.5 })).toEqual({ column: 2, row: 1 });
  expect(cellAt(found, columns, { x: 9, y: 2.5 })).toBeNull();
  expect(cellAt(found, columns, { x: 0, y: 9 })).toBeNull();
});

it('tells what stands behind it', () => {
  expect(madeOf(section([0, 1, 2], FULL))).toBe('3 profiles; each cell one sample');
  expect(madeOf(section([0, 1], [[2, 0], [3, 12]], 4))).toBe('2 profiles, every 4th shown; each cell the mean of 2 to 12 samples');
  expect(madeOf(section([0, 1], [[3], [3]], 22))).toBe('2 profiles, every 22nd shown; each cell the mean of 3 samples');
});
