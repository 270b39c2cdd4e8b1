// Oracles: geometry of the Mercator projection, worked out by hand, and what must stay where it is.
import { describe, expect, it } from 'vitest';
import { around, fitted, graticuleLabel, graticuleStep, moved, pixelsPerMetre, placeAt, projection, scaleBar, wrapped, zoomed } from './view';
import type { MapView } from './view';

const SIZE = { width: 800, height: 500 };
const VIEW: MapView = { latitude: 30, longitude: 125, scale: 20000 };

describe('the view of a map', () => {
  it('keeps the place below the pointer while it zooms', () => {
    const before = placeAt(VIEW, SIZE, 123, 321);
    const after = placeAt(zoomed(VIEW, SIZE, 2.5, 123, 321), SIZE, 123, 321);
    expect(after.latitude).toBeCloseTo(before.latitude, 9);
    expect(after.longitude).toBeCloseTo(before.longitude, 9);
  });

  it('moves with the pointer', () => {
    const before = placeAt(VIEW, SIZE, 100, 100);
    const after = placeAt(moved(VIEW, SIZE, 40, -25), SIZE, 140, 75);
    expect(after.latitude).toBeCloseTo(before.latitude, 9);
    expect(after.longitude).toBeCloseTo(before.longitude, 9);
  });

  it('shows all places, also across the date line', () => {
    const places = [
      { latitude: -10, longitude: 179.5 },
      { latitude: -12, longitude: -179.8 },
    ];
    const view = fitted(places, SIZE);
    if (!view) throw new Error('no view');
    expect(Math.abs(wrapped(view.longitude - 179.85))).toBeLessThan(1e-9);
    for (const place of places) {
      const at = projection(view, SIZE)([place.longitude, place.latitude]);
      expect(at?.[0]).toBeGreaterThanOrEqual(47);
      expect(at?.[0]).toBeLessThanOrEqual(SIZE.width - 47);
      expect(at?.[1]).toBeGreaterThanOrEqual(47);
      expect(at?.[1]).toBeLessThanOrEqual(SIZE.height - 47);
    }
  });

  it('does not come nearer than a few kilometres to a single place', () => {
    const view = fitted([{ latitude: 60, longitude: 0 }], SIZE, 4000, 0);
    expect(500 / pixelsPerMetre(view ?? VIEW, 60)).toBeCloseTo(4000, 0);
  });

  it('makes a metre twice as long at 60 degrees as at the equator', () => {
    expect(pixelsPerMetre(VIEW, 60) / pixelsPerMetre(VIEW, 0)).toBeCloseTo(2, 9);
  });

  it('draws a bar of a round length that is not too long', () => {
    for (const scale of [50, 3000, 20000, 1e6, 3e7]) {
      const bar = scaleBar({ ...VIEW, scale }, 120);
      expect(bar.pixels).toBeLessThanOrEqual(120);
      expect(bar.pixels).toBeGreaterThan(120 / 2.6);
      expect(['1', '2', '5']).toContain(bar.metres.toExponential()[0]);
    }
  });

  it('labels the graticule in degrees and minutes', () => {
    expect(graticuleLabel(30.5, 1 / 6, ['N', 'S'])).toBe('30°30′N');
    expect(graticuleLabel(-5, 1, ['E', 'W'])).toBe('5°W');
    expect(graticuleLabel(30 + 1.5 / 60, 1 / 120, ['N', 'S'])).toBe('30°01.5′N');
    expect(graticuleStep({ ...VIEW, scale: 100 })).toBeGreaterThan(20);
    expect(graticuleLabel(-180, 1 / 2, ['E', 'W'])).toBe('180°00′');
  });

  it('has more parallels where Mercator stretches them', () => {
    const north = { ...VIEW, latitude: 80 };
    expect(graticuleStep(north, 130, true)).toBeLessThan(graticuleStep(north) / 3);
  });

  it('shows circles whole, also across the date line', () => {
    const places = around({ latitude: 60, longitude: 179.999 }, 1000);
    const [one, other] = places;
    if (!one || !other) throw new Error('no places');
    expect((other.latitude - one.latitude) * 111195).toBeCloseTo(2000, -1);
    expect(wrapped(other.longitude - one.longitude) * 111195 * 0.5).toBeCloseTo(2000, -1);
    expect(other.longitude).toBeLessThan(0);
  });
});
