// What a map can show, and what can be edited on it. Angles in degrees, distances in m, speeds in m/s.

export interface Place {
  latitude: number;
  longitude: number;
}

/** Where a vehicle was, when, how surely, and from what that is known. */
export interface TrackPlace extends Place {
  /** s since 1970. */
  t: number;
  /** Standard deviation along one direction. */
  sigma_m: number | null;
  /** `gps` or `estimate`. */
  source: string;
}

export interface MapVehicle extends Place {
  vehicle: number;
  name: string;
  heading_deg?: number | null | undefined;
  /** Standard deviation of the position. */
  sigma_m?: number | null | undefined;
  stale?: boolean;
}

/** The area that a vehicle may not leave. */
export interface MapFence {
  places: readonly Place[];
  /** Whose it is, where there are several. */
  label?: string | undefined;
  /** A name of tokens.css. */
  colour?: string | undefined;
}

export interface MapTrack {
  id: string;
  /** Where it is known when and how surely, it can be read off. */
  places: readonly (Place | TrackPlace)[];
  kind: 'flown' | 'planned' | 'predicted' | 'aboard';
  /** What it is, for those who read it off. */
  words?: string;
  /** A name of tokens.css; that of its kind if left out. */
  colour?: string | undefined;
}

export interface MapWaypoint extends Place {
  radius_m?: number | null;
  label?: string;
  /** Its numbers in the mission, from 1: a mission that goes in rounds passes it more than once. */
  numbers?: readonly number[];
  /** A name of tokens.css, where it is one of several vehicles. */
  colour?: string | undefined;
  /** The one that is aimed at now. */
  active?: boolean;
  /** Something is wrong with it. */
  wrong?: boolean;
}

export interface MapArrow extends Place {
  north_m_s: number;
  east_m_s: number;
  words?: string;
  /** The present or last one; earlier ones are drawn fainter. */
  strong?: boolean;
}

export interface MapLayer {
  id: number | string;
  name: string;
  /** GeoJSON of lines, areas and points ... */
  geojson?: GeoJSON.GeoJsonObject;
  /** ... or an image between these bounds: west, south, east, north. */
  image?: string;
  bounds?: [number, number, number, number];
}

/** A place that is only shown, such as where a track leaves the fence. */
export interface MapMark extends Place {
  label: string;
  kind: 'waypoint' | 'warning';
}

/** Hooks of whoever lets people edit the waypoints. Without a hook that deed is not possible. */
export interface MapEditing {
  /** What a place is called for people who do not see it; "Waypoint" if left out. */
  what?: string;
  /** Whether the last place leads back to the first. */
  closed?: boolean;
  /** The first place was pressed, which closes the line. */
  close?: () => void;
  add?: (place: Place) => void;
  /** Between waypoint `index` and the next. */
  insert?: (index: number, place: Place) => void;
  move?: (index: number, place: Place) => void;
  remove?: (index: number) => void;
  choose?: (index: number | undefined) => void;
}
