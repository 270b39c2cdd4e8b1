// Oracles: numbers and words worked out by hand.
import { describe, expect, it } from 'vitest';
import { clockTime, course, distance, duration, latitude, longitude, number, quantity, velocity } from './units';

describe('units', () => {
  it('writes a real minus sign, and none before a zero', () => {
    expect(number(-3.24, 1)).toBe('−3.2');
    expect(number(-0.04, 1)).toBe('0.0');
    expect(number(Number.NaN)).toBe('–');
    expect(number(null)).toBe('–');
  });

  it('carries minutes over into degrees', () => {
    expect(latitude(30.99999999)).toBe('31°00.000′N');
    expect(longitude(-122.76)).toBe('122°45.600′W');
    expect(longitude(5.5)).toBe('005°30.000′E');
  });

  it('chooses the unit of a stretch of time', () => {
    expect(duration(4)).toBe('4\u202fs');
    expect(duration(600)).toBe('10\u202fmin');
    expect(duration(7500)).toBe('2\u202fh 05\u202fmin');
    expect(duration(273600)).toBe('3\u202fd 4\u202fh');
  });

  it('tells distances in m and km', () => {
    expect(distance(999)).toBe('999\u202fm');
    expect(distance(12345)).toBe('12.3\u202fkm');
  });

  it('points where a current goes', () => {
    expect(velocity(0, 1).course).toBeCloseTo(90);
    expect(velocity(-1, 0).course).toBeCloseTo(180);
    expect(velocity(3, 4).speed).toBeCloseTo(5);
    expect(course(359.7)).toBe('000°');
    expect(course(-10)).toBe('350°');
  });

  it('writes times as UTC', () => {
    expect(clockTime(0)).toBe('00:00:00');
    expect(clockTime(86399)).toBe('23:59:59');
    expect(clockTime(Infinity)).toBe('–');
  });

  it('keeps °C apart from its number and ° at it', () => {
    expect(quantity(11.25, 'degC', 1)).toBe('11.3\u202f°C');
    expect(quantity(-30, 'deg', 0)).toBe('−30°');
  });
});
