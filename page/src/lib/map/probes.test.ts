// Oracle: reckoned by hand; of an error that is normal along both directions 95 % lie within 2.448 standard deviations.
import { expect, it } from 'vitest';
import { probesOf } from './probes';
import { sure } from './sure';

it('tells when and how surely a vehicle was at a place, and from what that is known', () => {
  const place = { latitude: 30, longitude: 123, t: 1_700_000_000, sigma_m: 100, source: 'gps' };
  const arrow = { latitude: 30, longitude: 123, north_m_s: 0, east_m_s: 0.1 };
  const plan = { id: 'plan', places: [{ latitude: 30, longitude: 123 }], kind: 'planned' as const };
  const flown = { id: 'flown', places: [place, { ...place, sigma_m: null, source: 'estimate' }], kind: 'flown' as const };
  const found = probesOf([plan, flown], [arrow, { ...arrow, words: 'Current of dive 3' }]);
  expect(found.map((probe) => [probe.label, probe.places.length])).toEqual([['Track', 2], ['Currents', 1]]);
  const words = found.map((probe) => [0, 1].map((index) => probe.words(index).replaceAll('\u202f', ' ')));
  expect(words[0]).toEqual([
    '2023-11-14 22:13:20 UTC, 30°00.000′N 123°00.000′E, ± 245 m, fix by GPS',
    '2023-11-14 22:13:20 UTC, 30°00.000′N 123°00.000′E, estimate',
  ]);
  expect(words[1]).toEqual(['Current of dive 3', '']);
});

it('is unknown where nobody told how sure a position is', () => {
  expect(sure(null)).toBeNull();
  expect(sure(10)).toBeCloseTo(24.48, 2);
});
