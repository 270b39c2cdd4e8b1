/** Fields of a plan, read from the station's own description of it: one set of ranges, which the page does not repeat. */

export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string;
  anyOf?: Schema[];
  allOf?: Schema[];
  properties?: Record<string, Schema>;
  required?: string[];
  items?: Schema;
  enum?: (string | number)[];
  const?: string | number;
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
  default?: unknown;
  title?: string;
  description?: string;
}

export type FieldKind = 'number' | 'whole' | 'flag' | 'choice' | 'choices' | 'text';

export interface PlanField {
  /** Place in the plan, such as "dives.depth_m". */
  key: string;
  kind: FieldKind;
  label: string;
  hint: string;
  unit: string;
  low: number | null;
  high: number | null;
  /** What holds if nothing is typed; undefined where something must be. */
  preset: unknown;
  /** Whether it may be left empty. */
  optional: boolean;
  choices: string[];
}

export interface PlanSection {
  key: string;
  title: string;
  words: string;
  fields: PlanField[];
}

const UNITS: [ending: string, unit: string][] = [
  ['_mm_per_deg', 'mm/deg'],
  ['_ml_s_m', 'ml s/m'],
  ['_m_s', 'm/s'],
  ['_hours', 'h'],
  ['_minutes', 'min'],
  ['_days', 'd'],
  ['_deg', 'deg'],
  ['_kg_m3', 'kg/m³'],
  ['_kpa', 'kPa'],
  ['_mm', 'mm'],
  ['_ml', 'ml'],
  ['_km', 'km'],
  ['_m', 'm'],
  ['_s', 's'],
];

/** Unit that the ending of a key tells. */
export function unitOf(key: string): string {
  return UNITS.find(([ending]) => key.endsWith(ending))?.[1] ?? '';
}

/** The schema that a reference means. */
function resolved(schema: Schema, all: Record<string, Schema>): Schema {
  if (schema.$ref) {
    const { $ref, ...rest } = schema;
    return { ...resolved(all[$ref.split('/').at(-1) ?? ''] ?? {}, all), ...rest };
  }
  if (schema.allOf?.length === 1) {
    const { allOf, ...rest } = schema;
    return { ...resolved(allOf[0] as Schema, all), ...rest };
  }
  return schema;
}

/** One field; null for what a form does not show, such as the list of waypoints. */
export function fieldOf(key: string, schema: Schema, all: Record<string, Schema>, required: boolean): PlanField | null {
  const whole = resolved(schema, all);
  const options = (whole.anyOf ?? [whole]).map((each) => resolved(each, all));
  const optional = options.some((each) => each.type === 'null');
  const told = options.find((each) => each.type !== 'null') ?? {};
  const items = told.items ? resolved(told.items, all) : undefined;
  const kind = kindOf(told, items);
  if (kind === null) return null;
  const last = key.split('.').at(-1) ?? key;
  const words = WORDS[key];
  return {
    key,
    kind,
    label: words?.[0] ?? plainLabel(last),
    hint: words?.[1] ?? whole.description ?? '',
    unit: unitOf(last),
    low: told.minimum ?? told.exclusiveMinimum ?? null,
    high: told.maximum ?? told.exclusiveMaximum ?? null,
    preset: required ? undefined : whole.default,
    optional,
    choices: ((kind === 'choices' ? items?.enum : told.enum) ?? []).map(String),
  };
}

function kindOf(told: Schema, items: Schema | undefined): FieldKind | null {
  if (told.enum) return 'choice';
  if (told.type === 'number') return 'number';
  if (told.type === 'integer') return 'whole';
  if (told.type === 'boolean') return 'flag';
  if (told.type === 'string') return 'text';
  if (told.type === 'array' && items?.enum) return 'choices';
  return null;
}

/** The sections of a plan with their fields, in the order of `SECTIONS`, then what else there is. */
export function sectionsOf(schema: Schema, all: Record<string, Schema> = schema.$defs ?? {}): PlanSection[] {
  const plan = resolved(schema, all);
  const found: PlanSection[] = [];
  const loose = Object.entries(plan.properties ?? {})
    .filter(([key]) => !HEAD.has(key))
    .map(([key, each]) => fieldOf(key, each, all, plan.required?.includes(key) ?? false))
    .filter((field) => field !== null);
  if (loose.length > 0) found.push({ key: '', title: 'Mission', words: 'when it begins and ends', fields: loose });
  for (const [key, each] of Object.entries(plan.properties ?? {})) {
    const table = (resolved(each, all).anyOf ?? [each]).map((one) => resolved(one, all)).find((one) => one.properties);
    if (!table?.properties) continue;
    const fields = Object.entries(table.properties)
      .map(([name, one]) => fieldOf(`${key}.${name}`, one, all, table.required?.includes(name) ?? false))
      .filter((field) => field !== null);
    if (fields.length === 0) continue;
    const known = SECTIONS[key];
    found.push({ key, title: known?.[0] ?? plainLabel(key), words: known?.[1] ?? table.description ?? '', fields });
  }
  const order = Object.keys(SECTIONS);
  const place = (section: PlanSection) => (order.includes(section.key) ? order.indexOf(section.key) : order.length);
  return found.sort((a, b) => place(a) - place(b));
}

function plainLabel(key: string): string {
  let name = key;
  for (const [ending] of UNITS)
    if (name.endsWith(ending)) {
      name = name.slice(0, -ending.length);
      break;
    }
  const words = name.replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const HEAD = new Set(['format', 'name', 'vehicle']);

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
  'sampling.every_s': ['A sample every', 'time between two samples'],
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
  if (field.low === null && field.high === null) return '';
  const unit = field.unit ? ` ${field.unit}` : '';
  if (field.low === null) return `at most ${short(field.high as number)}${unit}`;
  if (field.high === null) return `at least ${short(field.low)}${unit}`;
  return `${short(field.low)} to ${short(field.high)}${unit}`;
}

/** What is wrong with what was typed, in words; empty if nothing is. */
export function problemOf(field: PlanField, text: string): string {
  const typed = text.trim().replace(',', '.');
  if (typed === '')
    return field.optional || field.preset !== undefined ? '' : `is missing; allowed is ${rangeWords(field)}`;
  const value = Number(typed);
  if (!Number.isFinite(value)) return `"${text.trim()}" is not a number`;
  if (field.kind === 'whole' && !Number.isInteger(value)) return `must be a whole number, ${rangeWords(field)}`;
  if ((field.low !== null && value < field.low) || (field.high !== null && value > field.high))
    return `must be ${rangeWords(field)}`;
  return '';
}

/** A number without needless digits. */
export function short(value: number): string {
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e7))
    return value.toExponential().replace('e+', 'e');
  return String(Number(value.toPrecision(9)));
}

/** The number that was typed; a comma is a point. */
export function numberOf(text: string): number {
  return Number(text.trim().replace(',', '.'));
}
