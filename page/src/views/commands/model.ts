/** Commands as the page shows them: what may be typed, how long it is valid, what became of it. */

import type { CommandDetail, CommandKind, CommandParameter, CommandState, GivenCommand } from '../../lib/types';

export type { CommandParameter };
export type CommandType = CommandKind;
export type CommandChange = CommandState;
export type When = GivenCommand['when'];
/** A command of a list, or alone with all that became of it. */
export type CommandRow = GivenCommand & Partial<Pick<CommandDetail, 'history'>>;

/** What a person typed for a command. */
export interface Typed {
  values: Record<string, string>;
  when: When;
  valid_for_s: number;
}

/** Classes of `.tag` in the style of the page. */
export type Tone = '' | 'accent' | 'ok' | 'caution' | 'warning';

const TONES: Record<string, Tone> = {
  received: 'accent',
  waiting: 'accent',
  'in progress': 'accent',
  done: 'ok',
  failed: 'warning',
  refused: 'warning',
  expired: 'caution',
  cancelled: '',
  'outcome unknown': 'caution',
  forgotten: 'caution',
  'not sent': 'warning',
};

/** Colour group of a state. */
export function toneOf(state: string): Tone {
  return TONES[plainState(state)] ?? '';
}

/** A state without the underscores that it may have on its way. */
export function plainState(state: string): string {
  return state.toLowerCase().replaceAll('_', ' ');
}

/** What is wrong with what was typed for a parameter, in words; empty if nothing is. */
export function problemOf(parameter: CommandParameter, text: string): string {
  const typed = text.trim().replace(',', '.');
  const allowed = allowedWords(parameter);
  if (typed === '') return `is missing; allowed is ${allowed}`;
  const value = Number(typed);
  if (!Number.isFinite(value)) return `"${text.trim()}" is not a number; allowed is ${allowed}`;
  if (value < parameter.low || value > parameter.high || (parameter.whole && !Number.isInteger(value)))
    return `${typed} is not allowed; allowed is ${allowed}`;
  return '';
}

/** The range of a parameter, in words. */
export function allowedWords(parameter: CommandParameter): string {
  const kind = parameter.whole ? 'a whole number' : 'a number';
  return `${kind} from ${plain(parameter.low)} to ${plain(parameter.high)}${parameter.unit ? ` ${parameter.unit}` : ''}`;
}

/** The number that was typed; a comma is a point. */
export function numberOf(text: string): number {
  return Number(text.trim().replace(',', '.'));
}

function plain(value: number): string {
  return value.toLocaleString('en', { maximumFractionDigits: 6, useGrouping: false });
}

export interface Validity {
  seconds: number;
  words: string;
}

export const USUAL_S = 12 * 3600;

/** How long a command may wait for its execution. */
export const VALIDITIES: Validity[] = [
  { seconds: 600, words: '10 minutes' },
  { seconds: 3600, words: '1 hour' },
  { seconds: 6 * 3600, words: '6 hours' },
  { seconds: 12 * 3600, words: '12 hours' },
  { seconds: 24 * 3600, words: '1 day' },
  { seconds: 3 * 24 * 3600, words: '3 days' },
  { seconds: 7 * 24 * 3600, words: '7 days' },
];

export const WHENS: { when: When; words: string; meaning: string }[] = [
  {
    when: 'until_expiry',
    words: 'As soon as it can',
    meaning: 'as soon as the vehicle can, until the command expires',
  },
  {
    when: 'at_next_surfacing',
    words: 'At the next surfacing',
    meaning: 'after the dive that follows, or in which it arrives',
  },
  { when: 'at_once', words: 'At once or not at all', meaning: 'as it arrives, or not at all' },
];

/** A length of time that counts down, such as "2 h 05 min" or "14 s". */
export function countdown(seconds: number): string {
  if (!(seconds > 0)) return 'over';
  const whole = Math.ceil(seconds);
  if (whole < 60) return `${whole} s`;
  const minutes = Math.floor(whole / 60);
  if (minutes < 60) return `${minutes} min ${two(whole % 60)} s`;
  const hours = Math.floor(minutes / 60);
  if (hours < 48) return `${hours} h ${two(minutes % 60)} min`;
  return `${Math.floor(hours / 24)} d ${hours % 24} h`;
}

function two(value: number): string {
  return String(value).padStart(2, '0');
}

/** What a command carries, in words: "time 600 s". */
export function parametersWords(row: CommandRow, kind: CommandType | undefined): string {
  return Object.entries(row.parameters)
    .map(([name, value]) => {
      const unit = kind?.parameters.find((parameter) => parameter.name === name)?.unit ?? '';
      return `${name} ${plain(value)}${unit ? ` ${unit}` : ''}`;
    })
    .join(', ');
}

/** Steps on the way of a command. */
export const STEPS = ['written down', 'sent', 'aboard', 'answered'];

/** How many steps it has passed. */
export function stepOf(row: CommandRow): number {
  if (row.is_last) return 4;
  const state = plainState(row.state);
  if (state === 'waiting' || state === 'in progress' || state === 'received') return 3;
  return state === 'given' || row.words.startsWith('not sent') ? 1 : 2;
}

/** Commands by what a pilot reaches for: what moves the vehicle, then upkeep. */
export const GROUPS: { title: string; names: string[] }[] = [
  { title: 'Fly', names: ['start', 'hold', 'surface', 'recall'] },
  { title: 'Mission', names: ['switch-mission', 'roll-back-mission', 'radio-time'] },
  { title: 'Upkeep', names: ['clear', 'check', 'self-test', 'restart'] },
];

/** The types in their groups; what no group names comes last, and an abort has its own button. */
export function grouped(types: CommandType[]): { title: string; types: CommandType[] }[] {
  const named = new Map(types.map((kind) => [kind.name, kind]));
  const known = new Set(GROUPS.flatMap((group) => group.names));
  const groups = GROUPS.map((group) => ({
    title: group.title,
    types: group.names.map((name) => named.get(name)).filter((kind) => kind !== undefined),
  }));
  const others = types.filter((kind) => !known.has(kind.name) && kind.name !== 'abort');
  return [...groups, { title: 'Others', types: others }].filter((group) => group.types.length > 0);
}

/** What is known of an open command, in words. */
export function stateWords(row: CommandRow): string {
  return row.words || plainState(row.state);
}

/** All that was said of a command, first to last. */
export function changesOf(row: CommandRow): CommandChange[] {
  return row.history ?? [{ t: row.changed, state: row.state, words: row.words }];
}

/** The rows with one that is new or has changed; newest first. */
export function withRow(rows: CommandRow[], row: CommandRow): CommandRow[] {
  const before = rows.find((each) => each.id === row.id);
  if (before && before.changed > row.changed) return rows;
  return [...rows.filter((each) => each.id !== row.id), { ...before, ...row }].sort((a, b) => b.given - a.given);
}
