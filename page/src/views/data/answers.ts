// What the server answers about dives and what was sampled on them.

export interface DiveRow {
  readonly dive: number;
  readonly t_begin: number;
  readonly t_end: number | null;
  readonly latitude_begin: number | null;
  readonly longitude_begin: number | null;
  readonly latitude_end: number | null;
  readonly longitude_end: number | null;
  readonly greatest_depth_m: number | null;
  readonly current_north_m_s: number | null;
  readonly current_east_m_s: number | null;
  readonly energy_j: number | null;
}

export interface ProfileRow {
  readonly number: number;
  /** 1 down, -1 up. */
  readonly direction: number;
  readonly begin: number;
  readonly end: number;
  readonly samples: number;
  readonly dive: number | null;
  readonly latitude: number | null;
  readonly longitude: number | null;
  readonly least_depth_m: number | null;
  readonly greatest_depth_m: number | null;
}

export interface ProfileAnswer {
  readonly about: ProfileRow;
  readonly units: Record<string, string>;
  readonly values: Record<string, (number | null)[]>;
}

export interface SectionAnswer {
  readonly variable: string;
  readonly words: string;
  readonly unit: string;
  readonly cell_m: number;
  readonly depth_m: number[];
  readonly profiles: { readonly profile_number: number; readonly profile_direction: number; readonly time: number }[];
  /** By profile, then depth. */
  readonly values: (number | null)[][];
}

export interface DensityLine {
  readonly level: number;
  readonly absolute_salinity: number[];
  readonly conservative_temperature: number[];
}

export interface DiagramAnswer {
  readonly samples: number;
  readonly absolute_salinity: number[];
  readonly conservative_temperature: number[];
  readonly depth_m: number[];
  readonly t: number[];
  readonly profile: number[];
  readonly lines: DensityLine[];
}
