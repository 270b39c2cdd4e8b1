// Oracles: ways that can be told in words.
import { expect, it } from 'vitest';
import { routeOnce } from './route';

const [a, b, c, d] = [0, 1, 2, 3].map((i) => ({ latitude: 30 + (i % 2), longitude: 120 + (i >> 1) })) as [P, P, P, P];
type P = { latitude: number; longitude: number };

it('goes around a square once, however often it is flown', () => {
  const rounds = Array.from({ length: 500 }, () => [a, b, c, d]).flat();
  expect(routeOnce(rounds)).toEqual([a, b, c, d, a]);
});

it('goes there, and not back on the same legs', () => {
  expect(routeOnce([a, b, c, b, a])).toEqual([a, b, c]);
});

it('keeps a leg that comes after repeated ones, and all that leads to it', () => {
  expect(routeOnce([a, b, a, b, c])).toEqual([a, b, a, b, c]);
});

it('takes places apart by less than a metre as one', () => {
  const near = { ...a, latitude: a.latitude + 2e-6 };
  expect(routeOnce([a, b, near, b])).toEqual([a, b]);
});

it('leaves nothing and one place as they are', () => {
  expect(routeOnce([])).toEqual([]);
  expect(routeOnce([a])).toEqual([a]);
});
