import { describe, expect, it } from 'vitest';

import { cutOf, laidOut, readAround, within } from './turns';

const HEADING = { low: 0, turn: 360 };
const ROLL = { low: -180, turn: 360 };

describe('a value that goes around', () => {
  it('is never read as a full turn', () => {
    expect(readAround(359.97, HEADING, 1)).toBe(0);
    expect(readAround(359.94, HEADING, 1)).toBe(359.9);
    expect(readAround(360, HEADING, 1)).toBe(0);
    expect(readAround(-0.02, HEADING, 1)).toBe(0);
    expect(readAround(179.99, ROLL, 1)).toBe(-180);
    expect(readAround(12.34, { low: 0, turn: null }, 1)).toBe(12.34);
  });

  it('lies in the turn that begins where it is cut', () => {
    expect(within(350, -90, 360)).toBe(-10);
    expect(within(-170, 0, 360)).toBe(190);
  });

  it('is cut where it is not', () => {
    expect(cutOf([90, 100, 110], HEADING)).toBe(0);
    const north = cutOf([350, 0.1, 359.9, 10], HEADING);
    expect(north).toBeGreaterThan(-180.1);
    expect(north).toBeLessThan(-10);
    expect(cutOf([350, null, 10, undefined], HEADING)).toBe(north);
    expect(cutOf(Array.from({ length: 360 }, (_, degree) => degree), HEADING)).toBe(0);
    expect(cutOf([], HEADING)).toBe(0);
    expect(cutOf([null], HEADING)).toBe(0);
  });

  it('leaves at one edge and comes in at the other', () => {
    const { t, value } = laidOut({ t: [0, 10, 20], value: [350, 10, 30] }, 0, 360);
    expect(value).toEqual([350, 360, null, 0, 10, 30]);
    expect(t[2]).toBeCloseTo(5, 6);
    expect([...t].sort((a, b) => a - b)).toEqual(t);
  });

  it('goes on without a break about north', () => {
    const line = { t: [0, 2, 4, 6], value: [359.9, 0.1, 359.8, 0.2] };
    const { value } = laidOut(line, cutOf(line.value, HEADING), 360);
    expect(value).toHaveLength(4);
    expect(Math.max(...(value as number[])) - Math.min(...(value as number[]))).toBeCloseTo(0.4, 6);
  });

  it('keeps its gaps', () => {
    expect(laidOut({ t: [0, 1, 2], value: [350, null, 10] }, 0, 360).value).toEqual([350, null, 10]);
  });
});
