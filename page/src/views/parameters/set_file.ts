/**
 * A set of parameters as a file, and a file against what is aboard.
 *
 * The format is that of QGroundControl (.params): a line a parameter, with tabs between vehicle, component, name, value
 * and MAV_PARAM_TYPE; values as the vehicle has them, in SI units.
 */

import { digits, isWhole, type ComponentRow, type ParameterRow } from './model';

/** Characters of the largest file that is read: a hundred times what a vehicle has. */
export const LARGEST = 1_000_000;
export const ENDING = '.params';
const MOST_PROBLEMS = 20;
const COLUMNS = 'vehicle, component, name, value, type';
const TYPES: Record<string, number> = { uint8: 1, int8: 2, uint16: 3, int16: 4, uint32: 5, int32: 6, real32: 9 };

export interface Difference {
  readonly row: ParameterRow;
  readonly owner: string;
  readonly value: number;
}

export interface Comparison {
  readonly differences: readonly Difference[];
  /** How many are aboard as in the file. */
  readonly same: number;
  /** How many are aboard and not in the file. */
  readonly absent: number;
  /** Another vehicle, of which the file says that it is. */
  readonly other: number | null;
  /** What is wrong with the file, line by line; nothing is written while there is any. */
  readonly problems: readonly string[];
}

/** The file of what is known; what the vehicle has not told is left out. */
export function written(vehicle: number, name: string, components: readonly ComponentRow[], when: string): string {
  const lines = components.flatMap((each) =>
    each.parameters.flatMap((row) =>
      row.value === null ? [] : [[vehicle, row.component, row.name, digits9(row, row.value), TYPES[row.kind] ?? 9].join('\t')],
    ),
  );
  const head = [`# Onboard parameters for ${name.replaceAll(/\s+/g, ' ')}`, `# ${when}, values in SI units`, '#', `# ${COLUMNS}`];
  return [...head, ...lines, ''].join('\n');
}

/** Nine digits hold each value of 32 bits exactly. */
function digits9(row: ParameterRow, value: number): string {
  return isWhole(row) ? String(value) : String(Number(value.toPrecision(9)));
}

/** What a file would change aboard. */
export function compared(vehicle: number, text: string, components: readonly ComponentRow[]): Comparison {
  const rows = new Map(components.flatMap((each) => each.parameters.map((row) => [`${row.component}/${row.name}`, { row, owner: each.name }])));
  const seen = new Map<string, number>();
  const found: { differences: Difference[]; same: number; other: number | null; problems: string[] } = {
    differences: [],
    same: 0,
    other: null,
    problems: [],
  };
  for (const [index, line] of text.split(/\r?\n/).entries()) {
    if (line.trim() === '' || line.trim().startsWith('#')) continue;
    const wrong = takeLine(line, index + 1);
    if (wrong) found.problems.push(`Line ${index + 1}: ${wrong}`);
    if (found.problems.length >= MOST_PROBLEMS) break;
  }
  if (seen.size === 0 && found.problems.length === 0) found.problems.push(`The file has no parameter; a line has ${COLUMNS}, with tabs between them.`);
  return { ...found, absent: [...rows.keys()].filter((key) => !seen.has(key)).length };

  function takeLine(line: string, number: number): string {
    const cells = line.trim().split('\t');
    const [of = '', component = '', name = '', told = ''] = cells;
    if (cells.length !== 5) return `"${short(line)}" has ${cells.length} columns; a line has 5: ${COLUMNS}, with tabs between them.`;
    const key = `${component}/${name}`;
    const known = rows.get(key);
    if (!known) return `component ${short(component)} has told of no parameter ${short(name)}.`;
    const before = seen.get(key);
    if (before !== undefined) return `${name} of component ${component} stands in line ${before} already.`;
    seen.set(key, number);
    const value = told.trim() === '' ? NaN : Number(told);
    const wrong = problem(known.row, told, value);
    if (wrong) return `${name} = ${short(told)}: ${wrong}`;
    if (of !== String(vehicle)) found.other = Number(of);
    if (known.row.value !== null && Math.fround(known.row.value) === Math.fround(value)) found.same += 1;
    else found.differences.push({ ...known, value });
    return '';
  }
}

function problem(row: ParameterRow, told: string, value: number): string {
  const range = `${isWhole(row) ? 'whole, ' : ''}${digits(row.low)} to ${digits(row.high)}${row.unit ? ` ${row.unit}` : ''}`;
  if (!Number.isFinite(value) || /^0x/i.test(told.trim())) return `is no number; allowed is ${range}.`;
  if (isWhole(row) && !Number.isInteger(value)) return `is not whole; allowed is ${range}.`;
  const held = isWhole(row) ? value : Math.fround(value);
  return held < Math.fround(row.low) || held > Math.fround(row.high) ? `is out of range; allowed is ${range}.` : '';
}

function short(text: string): string {
  const plain = text.replaceAll('\t', ' ').trim();
  return plain.length > 40 ? `${plain.slice(0, 37)}...` : plain;
}
