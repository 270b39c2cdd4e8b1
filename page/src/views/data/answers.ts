// What the server answers about dives and what was sampled on them.

export interface DiveRow {
  readonly dive: number;
  readonly begin: number;
  readonly end: number | null;
  readonly latitude_begin?: number | null;
  readonly longitude_begin?: number | null;
  readonly latitude_end?: number | null;
  readonly longitude_end?: number | null;
  readonly greatest_depth_m: number | null;
  readonly current_north_m_s: number | null;
  readonly current_east_m_s: number | null;
  readonly energy_j: number | null;
}
