/** Fields of a plan as the station describes them: one set of words, units and ranges, which the page does not repeat. */

import type { PlanField as ToldField } from '../../lib/types';

/** A value of a plan, as the station tells it. */
export type { ToldField };

export type FieldKind = 'number' | 'flag' | 'choice' | 'choices' | 'text';

export interface PlanField extends ToldField {
  kind: FieldKind;
  label: string;
}

export interface PlanSection {
  key: string;
  title: string;
  words: string;
  fields: PlanField[];
}

/** Keys that have a place of their own on the desk. */
const HEAD = new Set(['format', 'name', 'vehicle', 'start']);
const UNITS: Record<string, string> = { degrees: 'deg', days: 'd', 'kg/m3': 'kg/m³' };

function fieldOf(told: ToldField): PlanField {
  const last = told.key.split('.').at(-1) ?? told.key;
  const words = WORDS[told.key];
  return {
    ...told,
    unit: UNITS[told.unit] ?? told.unit,
    words: words?.[1] ?? told.words,
    kind: kindOf(told),
    label: words?.[0] ?? plainLabel(last),
  };
}

function kindOf(told: ToldField): FieldKind {
  if (told.several) return 'choices';
  if (told.choices.length > 0) return 'choice';
  if (typeof told.default === 'boolean') return 'flag';
  return told.low === null && told.high === null ? 'text' : 'number';
}

/** The sections of a plan with their fields, in the order of `SECTIONS`, then what else there is. */
export function sectionsOf(fields: ToldField[]): PlanSection[] {
  const found = new Map<string, PlanSection>();
  for (const told of fields) {
    const [first, ...rest] = told.key.split('.') as [string, ...string[]];
    if (HEAD.has(first)) continue;
    const key = rest.length > 0 ? first : '';
    const known = SECTIONS[key];
    const section = found.get(key) ?? { key, title: known?.[0] ?? plainLabel(key), words: known?.[1] ?? '', fields: [] };
    section.fields.push(fieldOf(told));
    found.set(key, section);
  }
  const order = Object.keys(SECTIONS);
  const place = (section: PlanSection): number =>
    order.includes(section.key) ? order.indexOf(section.key) : order.length;
  return [...found.values()].sort((a, b) => place(a) - place(b));
}

const ENDINGS = /_(mm_per_deg|ml_s_m|m_s|kg_m3|hours|minutes|days|deg|kpa|mm|ml|km|m|s)$/;

function plainLabel(key: string): string {
  const words = key.replace(ENDINGS, '').replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Sections that most plans leave alone. */
export const RARE = new Set(['pitch_control', 'heading_control', 'drift_control']);

const SECTIONS: Record<string, [title: string, words: string]> = {
  dives: ['Dives', 'how deep, how steep and how fast'],
  sampling: ['Sampling', 'when the CTD measures'],
  surfacing: ['At the surface', 'how often it comes up and how long it stays'],
  surface: ['At the surface', 'how often it comes up and how long it stays'],
  guidance: ['Way', 'how waypoints are sought and when they count as reached'],
  abort: ['Limits', 'when a dive or the mission is broken off'],
  aborts: ['Limits', 'when a dive or the mission is broken off'],
  '': ['Mission', 'when it begins and ends'],
  water: ['Expected water', 'its density sets the ballast, its current moves the predicted track'],
  pitch_control: ['Pitch control', 'feedback of the moving mass on pitch'],
  heading_control: ['Heading control', 'feedback of rudder or rolling mass on heading'],
  drift_control: ['Drift control', 'feedback on depth while it hangs in the water'],
};

const WORDS: Record<string, [label: string, hint: string]> = {
  start_time: ['Begins', 'with its time zone, such as 2026-07-01T00:00:00Z; now if left empty'],
  duration_days: ['Expires after', 'the mission is over so long after its start'],
  neutral_density_kg_m3: [
    'Neutral in water of',
    'density in which the vehicle is neutral without ballast volume; by the water of the plan if left empty',
  ],
  'water.ocean': ['Ocean', 'an analytic ocean, such as east_china_sea'],
  'water.current': ['Current', 'of the ocean, none, given here, or what the last dive found'],
  'water.north_m_s': ['Current to the north', 'where the current is given here'],
  'water.east_m_s': ['Current to the east', 'where the current is given here'],
  'dives.depth_m': ['Depth', 'greatest depth of a dive; it turns a little earlier, since it goes on sinking'],
  'dives.pitch_deg': ['Pitch', 'how steep it glides, down and up'],
  'dives.speed_m_s': ['Speed', 'mean speed along the path through the water; the ballast follows from it'],
  'dives.least_speed_m_s': ['Least speed', 'how slow a dive may become where the water drives least'],
  'dives.ballast_ml': ['Ballast', 'ballast volume beyond neutral, instead of a speed'],
  'dives.per_surfacing': ['Dives per surfacing', 'from one stay at the surface to the next'],
  'dives.turn_depth_m': ['Upper turn', 'depth at which dives turn that do not surface'],
  'dives.least_altitude_m': [
    'Height above ground',
    'turns so high above the sea floor, if the altimeter hears it; 0 for never',
  ],
  'dives.drift_hours': ['Drift', 'time for which it hangs at depth before it climbs'],
  'surface.session_s': ['Time for radio', 'for position and radio at each surfacing'],
  'surface.longest_s': ['Longest stay', 'how long it waits for a position before it dives without'],
  'surface.every_hours': ['Surface every', 'surfaces after this time whatever the number of dives'],
  'surface.pitch_deg': ['Pitch at the surface', 'raises the antenna'],
  'surface.ballast_ml': ['Ballast at the surface', 'raises the antenna; the greatest if left empty'],
  'surface.depth_m': ['Counts as surfaced', 'when it is no deeper than this'],
  'guidance.acceptance_radius_m': ['Reached within', 'a waypoint counts as reached within this distance'],
  'guidance.lookahead_m': ['Aims ahead', 'how far ahead on the line between waypoints it aims'],
  'guidance.repeat': ['Repeat', 'begins again with the first waypoint after the last'],
  'abort.depth_m': ['Too deep', 'breaks off deeper than this; 10 % beyond the dive depth if left empty'],
  'abort.dive_hours': ['Too long', 'breaks off a dive that lasts longer'],
  'abort.battery_share': [
    'Battery reserve',
    'the mission ends when no more than this share of the energy is left (0 to 1)',
  ],
  'abort.leak': ['Leak', 'the mission ends when a detector finds water'],
  'abort.internal_pressure_kpa': ['Pressure in the hull', 'the mission ends above it: the vacuum is lost'],
  'sampling.every_s': ['A sample every', 'time between two samples of the CTD; as the vehicle is configured if left empty'],
  'sampling.phases': ['In the phases', 'of the dive in which the CTD is on'],
};

/** The value at a place of a plan; undefined if there is none. */
export function valueAt(plan: unknown, key: string): unknown {
  let found: unknown = plan;
  for (const part of key.split('.')) {
    if (typeof found !== 'object' || found === null) return undefined;
    found = (found as Record<string, unknown>)[part];
  }
  return found;
}

/** The plan with another value at a place; undefined takes it out. */
export function withValue<T extends object>(plan: T, key: string, value: unknown): T {
  const [first, ...rest] = key.split('.') as [string, ...string[]];
  const own = plan as Record<string, unknown>;
  const inner = rest.length > 0 ? withValue((own[first] as object | undefined) ?? {}, rest.join('.'), value) : value;
  const others = Object.entries(own).filter(([name]) => name !== first);
  if (inner === undefined) return Object.fromEntries(others) as T;
  return { ...own, [first]: inner } as T;
}

/** The range of a field in words; empty where there is none. */
export function rangeWords(field: PlanField): string {
  if (field.low === null || field.high === null) return '';
  const zero = field.or_zero ? '0, or ' : '';
  return `${zero}${short(field.low)} to ${short(field.high)}${field.unit ? ` ${field.unit}` : ''}`;
}

/** What is wrong with what was typed, in words; empty if nothing is. */
export function problemOf(field: PlanField, text: string): string {
  if (field.kind !== 'number') return '';
  const typed = text.trim().replace(',', '.');
  if (typed === '') return field.required ? `is missing; allowed is ${rangeWords(field)}` : '';
  const value = Number(typed);
  if (!Number.isFinite(value)) return `"${text.trim()}" is not a number; allowed is ${rangeWords(field)}`;
  if (field.or_zero && value === 0) return '';
  const { low, high } = field;
  if ((low !== null && value < low) || (high !== null && value > high)) return `must be ${rangeWords(field)}`;
  return '';
}

/** A number without needless digits. */
export function short(value: number): string {
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e7))
    return value.toExponential().replace('e+', 'e');
  return String(Number(value.toPrecision(8)));
}

/** The number that was typed; a comma is a point. */
export function numberOf(text: string): number {
  return Number(text.trim().replace(',', '.'));
}
