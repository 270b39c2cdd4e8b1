// Oracle: samples of two traces, counted by hand.
import { expect, it } from 'vitest';

import { stepOf, type Step } from '../../lib/steps';
import { stopAfter, stopsOf } from './stops';

const STOPS = [10, 20, 30];

function step(key: string): Step {
  const found = stepOf({ key, shiftKey: false, ctrlKey: false, altKey: false, metaKey: false });
  if (!found) throw new Error(key);
  return found;
}

it('stops where any trace has a value, once each, and not in a gap', () => {
  const one = { t: [0, 10, 15, 20, 40], value: [1, 2, null, 3, 4] };
  const other = { t: [20 + 1e-6, 30], value: [5, 6] };
  expect(stopsOf([one, undefined, other], 5, 35)).toEqual([10, 20, 30]);
});

it('goes from sample to sample, also from between two', () => {
  expect([10, 14, 20].map((t) => stopAfter(STOPS, t, step('ArrowRight')))).toEqual([20, 20, 30]);
  expect([30, 24, 20].map((t) => stopAfter(STOPS, t, step('ArrowLeft')))).toEqual([20, 20, 10]);
});

it('finds nothing beyond the last, whence the window has to move', () => {
  expect([30, 34].map((t) => stopAfter(STOPS, t, step('ArrowRight')))).toEqual([undefined, undefined]);
  expect([10, 4].map((t) => stopAfter(STOPS, t, step('ArrowLeft')))).toEqual([undefined, undefined]);
  expect(stopAfter([], 4, step('End'))).toBeUndefined();
});

it('goes to both ends from wherever it is', () => {
  expect([stopAfter(STOPS, 34, step('End')), stopAfter(STOPS, 4, step('Home'))]).toEqual([30, 10]);
});
