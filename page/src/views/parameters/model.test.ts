import { describe, expect, it } from 'vitest';
import { brief, isChanged, meant, problemOf, rangeWords, typing, valueWords, type ParameterRow } from './model';

const row = (unit: string, low: number, high: number, value: number): ParameterRow => ({
  component: 1,
  name: 'P',
  words: '',
  unit,
  kind: 'float32',
  low: Math.fround(low),
  high: Math.fround(high),
  default: Math.fround(value),
  value: Math.fround(value),
  since: null,
  user: null,
});

describe('parameters in the units of people', () => {
  it.each([
    [row('m3/s', 1e-9, 1e-2, 8.3632e-6), '8.3632 ml/s'],
    [row('m3', 1e-10, 1e-3, 1e-7), '0.1 ml'],
    [row('rad/s', 1e-4, 20, 0.34907), '20.00024 deg/s'],
    [row('Pa', 1e4, 3e5, 1.06e5), '106 kPa'],
    [row('m', 1e-9, 1, 1e-3), '1 mm'],
    [row('m', 0.1, 100, 2), '2 m'],
    [row('A', 0.01, 20, 8), '8 A'],
  ])('shows %o as %s', (each, words) => {
    expect(valueWords(each, each.value)).toBe(words);
  });

  it('takes what it shows as the very value', () => {
    for (let k = -40; k < 40; k += 1) {
      const each = row('rad', -1.6, 1.6, k * 0.0399);
      const typed = Number(typing(each, each.value ?? 0));
      expect(meant(each, typed)).toBe(each.value);
      expect(problemOf(each, String(typed))).toBe('');
    }
  });

  it('lets both ends of the range be typed, and nothing beyond', () => {
    const each = row('m3', -2.5e-4, 2.5e-4, 0);
    expect(rangeWords(each)).toBe('-250 to 250 ml');
    expect([problemOf(each, '-250'), problemOf(each, '250')]).toEqual(['', '']);
    expect([meant(each, -250), meant(each, 250)]).toEqual([each.low, each.high]);
    expect(problemOf(each, '250.1')).toContain('out of range');
  });

  it('writes the value that is meant', () => {
    expect(meant(row('m3/s', 1e-9, 1e-2, 8e-6), 9.5)).toBeCloseTo(9.5e-6, 15);
  });

  it('is brief in tables and true about changes', () => {
    const each = row('m3/s', 1e-9, 1e-2, 8.3632e-6);
    expect(brief(each, each.value)).toBe('8.363 ml/s');
    expect(isChanged(each)).toBe(false);
  });
});
