// What the server answers, by hand until the types come from its own OpenAPI document.

export type Role = 'viewer' | 'pilot' | 'admin';
/** A vehicle's number, or "replay:ID" for what a replay says on the live socket. */
export type VehicleKey = number | string;

export interface User {
  name: string;
  role: Role;
}

export interface StationInfo {
  name: string;
  version: string;
  now: number;
  user: User | null;
  login_required: boolean;
  demo: boolean;
}

export interface AlarmBrief {
  key: string;
  words: string;
  severity: string;
}

export interface Position {
  latitude: number;
  longitude: number;
  t: number;
  sigma_m: number | null;
}

export interface Current {
  north_m_s: number;
  east_m_s: number;
  dive?: number | null;
}

export interface VehicleSummary {
  vehicle: number;
  name: string;
  model: string;
  simulated: boolean;
  speed: number;
  now: number;
  heard: boolean;
  last_contact: number | null;
  link_reason: string | null;
  state: string | null;
  phase: string | null;
  dive: number | null;
  waypoint: number | null;
  mission: string | number | null;
  alarms: AlarmBrief[];
  position: Position | null;
  battery: { share: number | null; voltage_v: number | null; t: number } | null;
  next_surfacing: { t: number; why: string } | null;
  speed_made_good: { m_s: number; course_deg: number } | null;
  current: Current | null;
  waypoint_distance_m: number | null;
  eta: { t: number } | null;
  missing: Record<string, string>;
  holder: string | null;
}

export interface Limit {
  channel: string;
  low: number | null;
  high: number | null;
  hysteresis?: number;
  delay_s?: number;
  severity: string;
}

export interface Channel {
  key: string;
  words: string;
  unit: string;
  group: string;
  standard_name?: string | null;
  period_s: number | null;
  low: number | null;
  high: number | null;
  values?: Record<string, string> | null;
}

export interface Shape {
  length_m: number;
  diameter_m: number;
  /** Hull from bow to stern: distance from the bow or along the axis, and radius, m. */
  profile: [number, number][];
  wings?: { span_m?: number; chord_m?: number; x_m?: number; sweep_deg?: number } | null;
  rudder?: { height_m?: number; chord_m?: number; x_m?: number } | null;
  moving_mass_range_m?: [number, number] | null;
  bladder_range_ml?: [number, number] | null;
}

export interface VehicleDetail extends VehicleSummary {
  channels?: Channel[];
  limits?: Limit[];
  shape?: Shape | null;
}

export interface Latest {
  now: number;
  values: Record<string, { t: number; value: number; age_s: number; period_s: number | null; stale: boolean }>;
}

export interface SeriesAnswer {
  begin: number;
  end: number;
  channels: Record<string, { t: number[]; value: (number | null)[]; samples: number; reduced: boolean }>;
}

export interface Track {
  t: number[];
  latitude: number[];
  longitude: number[];
  sigma_m: (number | null)[];
  source?: (string | null)[] | string;
}

export interface StateMachine {
  states: (string | { name: string; words?: string })[];
  transitions: [string, string, string][];
}

export interface AlarmRow {
  id: number;
  /** Null: of the station itself. */
  vehicle: number | null;
  key: string;
  words: string;
  severity: string;
  raised: number;
  cleared: number | null;
  acknowledged: number | null;
  acknowledged_by: string | null;
  value: number | null;
  note: string | null;
}

export type EventKind =
  | 'alarm'
  | 'command'
  | 'mission'
  | 'parameter'
  | 'transfer'
  | 'log'
  | 'note'
  | 'holder'
  | 'presence'
  | 'text'
  | 'dive'
  | 'replay';

export interface StationEvent {
  kind: EventKind;
  vehicle: VehicleKey | null;
  data: Record<string, unknown>;
}

/** What the server says when it refuses: a sentence, and what would be allowed. */
export interface Refusal {
  reason: string;
  key?: string | null;
  value?: unknown;
  allowed?: string | null;
}
