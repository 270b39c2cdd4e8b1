// Oracle: limits and shares worked out by hand.
import { expect, test } from 'vitest';
import { isNear, limitWords, placeBetween } from './limits';

test('limits are written with a real minus and only those that are set', () => {
  expect(limitWords(null, 200, 'm')).toBe('≤\u202f200');
  expect(limitWords(24.5, null, 'V')).toBe('≥\u202f24.5');
  expect(limitWords(-45, 45, 'deg')).toBe('\u221245 to 45');
  expect(limitWords(null, undefined, 'm')).toBe('');
});

test('near is within a twentieth: of the room between both, or of the one', () => {
  expect([189, 191, 200, 201].map((value) => isNear(value, null, 200))).toEqual([false, true, true, false]);
  expect([-45, -40.6, -40, 0, 41].map((value) => isNear(value, -45, 45))).toEqual([true, true, false, false, true]);
  expect([30, 31.4, 32].map((value) => isNear(value, 30, null))).toEqual([true, true, false]);
  expect(isNear(0, null, null)).toBe(false);
  expect(isNear(null, 0, 1)).toBe(false);
});

test('a bar needs both ends', () => {
  expect(placeBetween(0, -45, 45)).toBe(0.5);
  expect(placeBetween(90, -45, 45)).toBe(1);
  expect(placeBetween(5, null, 10)).toBe(undefined);
});
