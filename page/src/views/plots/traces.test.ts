// Oracle: the times that a vehicle's clock can have shown.
import { expect, it } from 'vitest';
import { extended, type Trace } from './traces';

const trace: Trace = { t: [1000, 1010, 1200], value: [1, 2, 3], samples: 3, reduced: false };

it('goes on behind the last sample; the same one again is one', () => {
  const found = extended(trace, [1200, 1210], [3, 4], 0, Infinity);
  expect([found.t, found.value]).toEqual([[1000, 1010, 1200, 1210], [1, 2, 3, 4]]);
});

it('leaves a sample out that comes a moment too late', () => {
  expect(extended(trace, [1190], [9], 0, Infinity).t).toEqual([1000, 1010, 1200]);
});

it('goes on from where a clock was set back to', () => {
  const found = extended(trace, [1020, 1030], [5, 6], 0, Infinity);
  expect([found.t, found.value]).toEqual([[1000, 1010, 1020, 1030], [1, 2, 5, 6]]);
  expect(extended(trace, [10], [5], 0, Infinity).t).toEqual([10]);
  const dense: Trace = { ...trace, t: [1000, 1010, 1030, 1200], value: [1, 2, 3, 4] };
  expect(extended(dense, [1020], [5], 0, Infinity).t).toEqual([1000, 1010, 1020]);
});
