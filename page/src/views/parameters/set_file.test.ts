import { describe, expect, it } from 'vitest';
import type { ComponentRow, ParameterRow } from './model';
import { compared, written } from './set_file';

const base = { component: 25, words: '', since: null, user: null };
const row = (name: string, kind: string, value: number | null, low: number, high: number, unit = ''): ParameterRow => ({
  ...base, name, kind, unit, low: Math.fround(low), high: Math.fround(high), default: 1, value: value === null ? null : Math.fround(value),
});
const ROWS = [row('GAIN', 'real32', 0.1, 0, 2, 'm'), row('COUNT', 'int32', 7, 0, 10), row('LAST', 'real32', null, 0, 1)];
const NODE: ComponentRow[] = [{ component: 25, name: 'motion node', state: 'known', whole: true, reason: '', parameters: ROWS }];
const line = (...cells: (string | number)[]): string => cells.join('\t');

describe('a set of parameters as a file', () => {
  it('comes back as what it was', () => {
    const text = written(1, 'Kelp', NODE, '2026-05-01T12:00:00Z');
    expect(text.split('\n').filter((each) => !each.startsWith('#') && each)).toEqual([
      line(1, 25, 'GAIN', '0.100000001', 9),
      line(1, 25, 'COUNT', 7, 6),
    ]);
    expect(compared(1, text, NODE)).toEqual({ differences: [], same: 2, absent: 1, other: null, problems: [] });
  });

  it('tells what it would change, also as QGroundControl writes it', () => {
    const text = `# Onboard parameters for Vehicle 2\r\n#\r\n${line(2, 25, 'GAIN', '0.250000000000000000', 9)}\r\n${line(2, 25, 'LAST', 1, 9)}\r\n`;
    const found = compared(1, text, NODE);
    expect(found.differences.map((each) => [each.owner, each.row.name, each.row.value, each.value])).toEqual([
      ['motion node', 'GAIN', Math.fround(0.1), 0.25],
      ['motion node', 'LAST', null, 1],
    ]);
    expect([found.same, found.absent, found.other, found.problems]).toEqual([0, 1, 2, []]);
  });

  it.each([
    [line(1, 25, 'GAIN', 'much', 9), 'Line 1: GAIN = much: is no number; allowed is 0 to 2 m.'],
    [line(1, 25, 'GAIN', '', 9), 'Line 1: GAIN = : is no number; allowed is 0 to 2 m.'],
    [line(1, 25, 'GAIN', '0x1', 9), 'Line 1: GAIN = 0x1: is no number; allowed is 0 to 2 m.'],
    [line(1, 25, 'GAIN', 'Infinity', 9), 'Line 1: GAIN = Infinity: is no number; allowed is 0 to 2 m.'],
    [line(1, 25, 'GAIN', 2.1, 9), 'Line 1: GAIN = 2.1: is out of range; allowed is 0 to 2 m.'],
    [line(1, 25, 'COUNT', 1.5, 6), 'Line 1: COUNT = 1.5: is not whole; allowed is whole, 0 to 10.'],
    [line(1, 26, 'GAIN', 1, 9), 'Line 1: component 26 has told of no parameter GAIN.'],
    [`\n${line(1, 25, 'COUNT', 7, 6)}\n${line(1, 25, 'COUNT', 8, 6)}`, 'Line 3: COUNT of component 25 stands in line 2 already.'],
    ['GAIN=1', 'Line 1: "GAIN=1" has 1 columns; a line has 5: vehicle, component, name, value, type, with tabs between them.'],
    ['# nothing\n', 'The file has no parameter; a line has vehicle, component, name, value, type, with tabs between them.'],
  ])('says of %j what is wrong', (text, words) => {
    expect(compared(1, text, NODE).problems).toEqual([words]);
  });

  it('says no more than a person reads', () => {
    expect(compared(1, 'x\n'.repeat(1000), NODE).problems).toHaveLength(20);
  });
});
