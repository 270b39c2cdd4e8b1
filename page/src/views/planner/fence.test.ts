// Oracles: what is around a few places by eye, and texts that must stay with their places.
import { describe, expect, it, vi } from 'vitest';

vi.mock('./desk.svelte', () => ({}));
const { rectangle } = await import('./fencing.svelte');
const { renumbered, withoutList } = await import('./texts');

const place = (latitude_deg: number, longitude_deg: number) => ({ latitude_deg, longitude_deg });

describe('a rectangle around places', () => {
  it('has room of a quarter of their spread', () => {
    const found = rectangle([place(28, 126), place(29, 127)]);
    expect(found).toEqual([place(27.75, 125.75), place(29.25, 125.75), place(29.25, 127.25), place(27.75, 127.25)]);
  });

  it('lies across the date line where the places do', () => {
    const found = rectangle([place(10, 179.5), place(11, -179.5)]);
    expect(found.map((corner) => corner.longitude_deg)).toEqual([179.25, 179.25, -179.25, -179.25]);
  });

  it('is 2 km wide at least, also far north', () => {
    const [one, , three] = rectangle([place(80, 10)]);
    if (!one || !three) throw new Error('no corners');
    expect((three.latitude_deg - one.latitude_deg) * 111.2).toBeCloseTo(4, 0);
    expect((three.longitude_deg - one.longitude_deg) * 111.2 * Math.cos((80 * Math.PI) / 180)).toBeCloseTo(4, 0);
  });
});

describe('texts that are no right value', () => {
  const texts = { 'waypoints.0.latitude_deg': 'a', 'waypoints.2.longitude_deg': 'b', 'dives.depth_m': 'c' };

  it('stay with their places when one comes before', () => {
    expect(renumbered(texts, 'waypoints', 1, 1)).toEqual({
      'waypoints.0.latitude_deg': 'a', 'waypoints.3.longitude_deg': 'b', 'dives.depth_m': 'c',
    });
  });

  it('go with their place, and the others stay with theirs', () => {
    expect(renumbered(texts, 'waypoints', 1, -1)).toEqual({ 'waypoints.1.longitude_deg': 'b', 'dives.depth_m': 'c' });
    expect(withoutList(texts, 'waypoints')).toEqual({ 'dives.depth_m': 'c' });
  });
});
