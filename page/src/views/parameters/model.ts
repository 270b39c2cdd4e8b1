/** Parameters of a vehicle, by component, as the page shows them. */

import type { ComponentParameters, Parameter, ParameterAnswer, ParameterWrite } from '../../lib/types';

export type { ParameterAnswer };
export type Write = ParameterWrite;
export type ParameterRow = Parameter & { component: number };
export type ComponentRow = Omit<ComponentParameters, 'parameters'> & { parameters: ParameterRow[] };

/** The components of an answer, each parameter with its component. */
export function componentsOf(answer: ParameterAnswer): ComponentRow[] {
  return answer.components.map((each) => ({
    ...each,
    parameters: each.parameters.map((one) => ({ ...one, component: each.component })),
  }));
}

/** Whether a parameter has another value than its default; 32 bits hold both. */
export function isChanged(row: ParameterRow): boolean {
  return row.value !== null && Math.fround(row.value) !== Math.fround(row.default);
}

/** Whether only whole numbers are allowed. */
export function isWhole(row: ParameterRow): boolean {
  return /int/i.test(row.kind);
}

/** Whether it is a truth: 0 or 1. */
export function isTruth(row: ParameterRow): boolean {
  return isWhole(row) && row.low === 0 && row.high === 1;
}

/** Units as people speak them, and how many of them one SI unit is. */
const SPOKEN: Record<string, readonly [string, number]> = {
  m3: ['ml', 1e6],
  'm3/s': ['ml/s', 1e6],
  rad: ['deg', 180 / Math.PI],
  'rad/s': ['deg/s', 180 / Math.PI],
  Pa: ['kPa', 1e-3],
};

/** What lies within a metre is told in millimetres, as the moving mass is. */
function spoken(row: ParameterRow): readonly [string, number] {
  const isShort = Math.max(Math.abs(row.low), Math.abs(row.high)) <= 1;
  if (row.unit === 'm' && isShort) return ['mm', 1e3];
  if (row.unit === 'm/s' && isShort) return ['mm/s', 1e3];
  return SPOKEN[row.unit] ?? [row.unit, 1];
}

/** Unit in which a parameter is shown and typed. */
export function unitOf(row: ParameterRow): string {
  return spoken(row)[0];
}

/** A value of the vehicle in the unit that is shown; 32 bits hold seven digits of it. */
export function shown(row: ParameterRow, value: number): number {
  const factor = spoken(row)[1];
  return factor === 1 ? value : Number((value * factor).toPrecision(7));
}

/** A value that is typed in the unit shown, as the vehicle has it; an end of the range stays that end. */
export function meant(row: ParameterRow, typed: number): number {
  const near = (end: number): boolean => shown(row, end) === Number(typed.toPrecision(7));
  if (near(row.low)) return row.low;
  if (near(row.high)) return row.high;
  if (row.value !== null && near(row.value)) return row.value;
  return typed / spoken(row)[1];
}

/** What may be typed, in words. */
export function rangeWords(row: ParameterRow): string {
  const unit = unitOf(row);
  const span = `${typing(row, row.low)} to ${typing(row, row.high)}${unit ? ` ${unit}` : ''}`;
  return isTruth(row) ? 'yes or no' : isWhole(row) ? `whole, ${span}` : span;
}

/** What is wrong with a typed value, in words; empty if nothing is. */
export function problemOf(row: ParameterRow, text: string): string {
  const typed = text.trim().replace(',', '.');
  if (typed === '') return `is missing; allowed is ${rangeWords(row)}`;
  const value = Number(typed);
  if (!Number.isFinite(value)) return `"${text.trim()}" is not a number; allowed is ${rangeWords(row)}`;
  if (isWhole(row) && !Number.isInteger(value)) return `${typed} is not a whole number; allowed is ${rangeWords(row)}`;
  const si = meant(row, value);
  if (si < row.low || si > row.high) return `${typed} is out of range; allowed is ${rangeWords(row)}`;
  return '';
}

/** A value of the vehicle as it is typed. */
export function typing(row: ParameterRow, value: number): string {
  return digits(shown(row, value));
}

/** As many digits as 32 bits hold, without needless zeros. */
export function digits(value: number): string {
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return String(value);
  const short = Number(value.toPrecision(7));
  return short !== 0 && (Math.abs(short) < 1e-4 || Math.abs(short) >= 1e9) ? short.toExponential() : String(short);
}

/** A value with its unit. */
export function valueWords(row: ParameterRow, value: number | null): string {
  if (value === null) return 'not known';
  if (isTruth(row)) return value ? 'yes' : 'no';
  const unit = unitOf(row);
  return unit ? `${typing(row, value)} ${unit}` : digits(value);
}

/** A value in a table: four digits tell enough. */
export function brief(row: ParameterRow, value: number | null): string {
  return valueWords(row, value === null ? null : Number(value.toPrecision(4)));
}

/** Where a value lies in its range, 0 to 1; null without one. */
export function share(row: ParameterRow, value: number | null): number | null {
  if (value === null || !(row.high > row.low)) return null;
  return Math.min(1, Math.max(0, (value - row.low) / (row.high - row.low)));
}

/** Parameters that have all the words of a search in name, words or unit. */
export function found(rows: ParameterRow[], search: string, changedOnly: boolean): ParameterRow[] {
  const wanted = search.toLowerCase().split(/\s+/).filter(Boolean);
  return rows.filter((row) => {
    if (changedOnly && !isChanged(row)) return false;
    const text = `${row.name} ${row.words} ${row.unit} ${unitOf(row)}`.toLowerCase();
    return wanted.every((word) => text.includes(word));
  });
}

/** The newest writing of each parameter that waits or was not taken, by component and name. */
export function unsettled(writes: readonly Write[]): ReadonlyMap<string, Write> {
  const newest = new Map<string, Write>();
  for (const each of writes) {
    const key = `${each.component}/${each.name}`;
    if (!newest.has(key)) newest.set(key, each);
  }
  return new Map([...newest].filter(([, each]) => each.state !== 'done'));
}

/** How many writings wait, and how many were not taken, in words; empty if there are none. */
export function unsettledWords(open: ReadonlyMap<string, Write>): string {
  const waiting = [...open.values()].filter((each) => each.state === 'waiting').length;
  const parts = [
    waiting === 0 ? '' : `${waiting} ${waiting === 1 ? 'waits' : 'wait'}`,
    waiting === open.size ? '' : `${open.size - waiting} not taken`,
  ];
  return parts.filter(Boolean).join(', ');
}

/** How much of a component is known, 0 to 1. */
export function knownShare(component: ComponentRow): number {
  const total = component.parameters.length;
  return total > 0 ? component.parameters.filter((row) => row.value !== null).length / total : 0;
}
