// Oracle: the keys that the help names, places counted by hand.
import { describe, expect, it } from 'vitest';

import { onColumns, onLine, stepOf, type Columns, type Spot, type Step } from './steps';

const NONE = { shiftKey: false, ctrlKey: false, altKey: false, metaKey: false };

function step(key: string, shiftKey = false): Step {
  const found = stepOf({ ...NONE, key, shiftKey });
  if (!found) throw new Error(`${key} is no step`);
  return found;
}

describe('on a line', () => {
  const after = (at: number, key: string, shift = false): number => onLine(at, 400, step(key, shift));

  it('goes from place to place, up being onwards', () => {
    expect(['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown'].map((key) => after(7, key))).toEqual([6, 8, 8, 6]);
  });

  it('goes over a twentieth with Shift and by pages', () => {
    expect([after(100, 'ArrowRight', true), after(100, 'PageUp'), after(100, 'PageDown')]).toEqual([120, 120, 80]);
  });

  it('goes over five at least where there are few', () => {
    expect(onLine(1, 12, step('PageUp'))).toBe(6);
  });

  it('ends at both ends', () => {
    expect([after(7, 'Home'), after(7, 'End'), after(0, 'ArrowLeft'), after(399, 'PageUp')]).toEqual([0, 399, 0, 399]);
  });
});

describe('over columns', () => {
  const COLUMNS: Columns = [[1, 10, 20, 30], [2, 29], [5]];
  const after = (at: Spot, key: string): Spot => onColumns(at, COLUMNS, step(key));

  it('goes down and up in a column', () => {
    expect(after({ column: 0, row: 1 }, 'ArrowDown')).toEqual({ column: 0, row: 2 });
    expect(after({ column: 0, row: 1 }, 'ArrowUp')).toEqual({ column: 0, row: 0 });
    expect(after({ column: 1, row: 1 }, 'ArrowDown')).toEqual({ column: 1, row: 1 });
  });

  it('stays at its depth in another column', () => {
    expect(after({ column: 0, row: 2 }, 'ArrowRight')).toEqual({ column: 1, row: 1 });
    expect(after({ column: 1, row: 1 }, 'ArrowLeft')).toEqual({ column: 0, row: 3 });
  });

  it('goes to the first and to the last column', () => {
    expect(after({ column: 1, row: 1 }, 'End')).toEqual({ column: 2, row: 0 });
    expect(after({ column: 2, row: 0 }, 'Home')).toEqual({ column: 0, row: 0 });
  });
});

it('leaves keys of the browser alone', () => {
  expect(stepOf({ ...NONE, key: 'ArrowLeft', altKey: true })).toBeUndefined();
  expect(stepOf({ ...NONE, key: 'a' })).toBeUndefined();
});
