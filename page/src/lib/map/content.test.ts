// Oracle: a square flown twice is four places.
import { expect, it, vi } from 'vitest';

vi.mock('../live.svelte', () => ({ live: {} }));
const { together } = await import('./content.svelte');

it('shows the waypoints of a mission in rounds once, with all their numbers', () => {
  const corners = [0, 1, 2, 3].map((i) => ({ latitude: 30 + (i % 2), longitude: 120 + (i >> 1) }));
  const found = together([...corners, ...corners, ...corners.slice(0, 1)]);
  expect(found.map((one) => one.numbers)).toEqual([[1, 5, 9], [2, 6], [3, 7], [4, 8]]);
  expect(found.map((one) => one.label)).toEqual(['1', '2', '3', '4']);
});
