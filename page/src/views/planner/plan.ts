/** The plan as the page edits it; what may stand in it, the station says. */

import { short, withValue, type PlanSection } from './fields';

export interface PlanPlace {
  latitude_deg: number;
  longitude_deg: number;
}

/** A place of the map as a plan has it: five digits are a metre. */
export function rounded(place: { latitude: number; longitude: number }): PlanPlace {
  return { latitude_deg: Number(place.latitude.toFixed(5)), longitude_deg: Number(place.longitude.toFixed(5)) };
}

/** A place of a plan as the map has it. */
export function plain(place: PlanPlace): { latitude: number; longitude: number } {
  return { latitude: place.latitude_deg, longitude: place.longitude_deg };
}

export interface Plan {
  format: 1;
  name: string;
  vehicle: string;
  start: PlanPlace;
  waypoints: PlanPlace[];
  geofence?: PlanPlace[];
  dives: Record<string, unknown>;
  [section: string]: unknown;
}

export interface PlanProblem {
  key: string;
  value: string;
  reason: string;
  allowed: string;
}

/** A place of a plan in a table. */
export interface PlaceRow {
  /** Where it stands in the plan: "start", "waypoints.2", "geofence.0". */
  key: string;
  label: string;
  /** What its fields are called. */
  name: string;
  kind: 'start' | 'waypoint' | 'corner';
  place: PlanPlace;
}

/** The lists of places of a plan. */
export type PlaceList = 'waypoints' | 'geofence';

/** Waypoints, or corners of the geofence, at most. */
export const MOST_PLACES = 200;

/** Whether a value has what the page needs to show it as a plan; the rest, the station checks. */
export function isPlan(value: unknown): value is Plan {
  if (typeof value !== 'object' || value === null) return false;
  const plan = value as Partial<Plan>;
  return (
    typeof plan.name === 'string' &&
    typeof plan.vehicle === 'string' &&
    isPlace(plan.start) &&
    Array.isArray(plan.waypoints ?? []) &&
    (plan.waypoints ?? []).every(isPlace) &&
    (plan.geofence ?? []).every(isPlace) &&
    typeof plan.dives === 'object' &&
    plan.dives !== null
  );
}

function isPlace(value: unknown): value is PlanPlace {
  const place = value as Partial<PlanPlace> | null | undefined;
  return Number.isFinite(place?.latitude_deg) && Number.isFinite(place?.longitude_deg);
}

/** A plan without the values that hold anyway. */
export function tidy(plan: Plan): Plan {
  const kept = Object.entries(plan).filter(([, value]) => value !== null);
  const tables = kept.map(([key, value]) => [key, isTable(value) ? withoutNulls(value) : value]);
  const told = Object.fromEntries(tables) as Plan;
  return { ...told, waypoints: told.waypoints ?? [] };
}

function isTable(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function withoutNulls(table: Record<string, unknown>): Record<string, unknown> {
  return Object.fromEntries(Object.entries(table).filter(([, value]) => value !== null));
}

/** The plan with another place: "start", "waypoints.2" or "geofence.0". */
export function withPlace(plan: Plan, key: string, place: PlanPlace): Plan {
  const [list, number] = key.split('.');
  if (list === 'start') return { ...plan, start: place };
  const places = list === 'geofence' ? (plan.geofence ?? []) : plan.waypoints;
  const moved = places.map((each, index) => (index === Number(number) ? place : each));
  return list === 'geofence' ? { ...plan, geofence: moved } : { ...plan, waypoints: moved };
}

/** The plan with one waypoint (or corner) more, before the one of that number. */
export function inserted(plan: Plan, number: number, place: PlanPlace, list: PlaceList = 'waypoints'): Plan {
  const places = plan[list] ?? [];
  if (places.length >= MOST_PLACES) return plan;
  return { ...plan, [list]: places.toSpliced(number, 0, place) };
}

/** The plan without a waypoint (or corner). */
export function without(plan: Plan, number: number, list: PlaceList = 'waypoints'): Plan {
  return { ...plan, [list]: (plan[list] ?? []).filter((_, index) => index !== number) };
}

/** The plan with a waypoint at another number of the order. */
export function reordered(plan: Plan, from: number, to: number): Plan {
  const place = plan.waypoints[from];
  if (!place || to < 0 || to >= plan.waypoints.length) return plan;
  return { ...plan, waypoints: plan.waypoints.toSpliced(from, 1).toSpliced(to, 0, place) };
}

/** Of speed, least speed and ballast, which one drives the dives. */
export type Drive = 'speed_m_s' | 'least_speed_m_s' | 'ballast_ml';

export function driveOf(plan: Plan): Drive {
  if (plan.dives.ballast_ml !== undefined && plan.dives.ballast_ml !== null) return 'ballast_ml';
  return plan.dives.speed_m_s !== undefined && plan.dives.speed_m_s !== null ? 'speed_m_s' : 'least_speed_m_s';
}

/** The plan with a number for what drives the dives, and none for what cannot stand beside it. */
export function withDrive(plan: Plan, drive: Drive, value: number): Plan {
  const others = drive === 'ballast_ml' ? ['speed_m_s', 'least_speed_m_s'] : ['ballast_ml'];
  const alone = others.reduce((told, key) => withValue(told, `dives.${key}`, undefined), plan);
  return withValue(alone, `dives.${drive}`, value);
}

export interface Difference {
  key: string;
  here: string;
  there: string;
}

/** Keys that the station fills in when it takes a plan that leaves them open. */
const FILLED_IN = new Set(['start_time', 'neutral_density_kg_m3', 'water.current', 'water.north_m_s', 'water.east_m_s']);

/** What is not the same in two plans, key by key; what is left out is what holds anyway. */
export function differences(here: Plan, there: Plan, sections: PlanSection[]): Difference[] {
  const usual: Record<string, string> = {};
  for (const field of sections.flatMap((section) => section.fields)) flat(field.default, field.key, usual);
  const one = { ...usual, ...flat(here) };
  const other = { ...usual, ...flat(there) };
  const keys = [...new Set([...Object.keys(one), ...Object.keys(other)])];
  const told = flat(here);
  const rows = keys
    .filter((key) => !key.startsWith('geofence.'))
    .map((key) => ({ key, here: one[key] ?? '', there: other[key] ?? '' }))
    .filter((row) => !isSame(row.here, row.there) && !(FILLED_IN.has(row.key) && told[row.key] === undefined));
  return [...rows, ...fences(here.geofence ?? [], there.geofence ?? [])];
}

/** Orders hold numbers in few bits: what differs by less was told as the same. */
const ROUNDING = 2e-3;

function isSame(here: string, there: string): boolean {
  if (here === there) return true;
  const [one, other] = [Number(here), Number(there)];
  if (here === '' || there === '' || !Number.isFinite(one) || !Number.isFinite(other)) return false;
  return Math.abs(one - other) <= ROUNDING * Math.max(Math.abs(one), Math.abs(other));
}

/** One row for a geofence that is another one. */
function fences(here: PlanPlace[], there: PlanPlace[]): Difference[] {
  if (JSON.stringify(here) === JSON.stringify(there)) return [];
  const words = (corners: PlanPlace[]): string => (corners.length ? `${corners.length} corners` : '');
  const isLike = here.length === there.length;
  return [{ key: 'geofence', here: words(here) + (isLike ? ', elsewhere' : ''), there: words(there) }];
}

function flat(value: unknown, before = '', found: Record<string, string> = {}): Record<string, string> {
  if (value === null || value === undefined) return found;
  if (isPlace(value)) {
    found[before] = `${value.latitude_deg.toFixed(5)}, ${value.longitude_deg.toFixed(5)}`;
  } else if (Array.isArray(value) && value.every((each) => typeof each === 'string')) {
    found[before] = value.join(', ');
  } else if (typeof value === 'object') {
    for (const [key, each] of Object.entries(value)) flat(each, before ? `${before}.${key}` : key, found);
  } else {
    found[before] = typeof value === 'number' ? short(value) : String(value);
  }
  return found;
}
