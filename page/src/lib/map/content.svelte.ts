// What the station knows of a vehicle for a map: track, mission aboard, currents of its dives, chart layers.

import { api } from '../api';
import { live } from '../live.svelte';
import type { DiveRow, LayerRow, MissionAboard, Track } from '../types';
import type { MapArrow, MapLayer, MapWaypoint, Place } from './types';

const NEWEST_ARROWS = 60;

export class MapContent {
  track = $state.raw<Place[]>([]);
  waypoints = $state.raw<MapWaypoint[]>([]);
  /** From waypoint to waypoint, once around. */
  route = $state.raw<Place[]>([]);
  fence = $state.raw<Place[]>([]);
  arrows = $state.raw<MapArrow[]>([]);
  readonly vehicle: number;

  constructor(vehicle: number) {
    this.vehicle = vehicle;
  }

  /** Fetches everything and keeps it up to date until the function that comes back is called. */
  follow(): () => void {
    const reload = (): void => void Promise.all([this.loadTrack(), this.loadMission(), this.loadDives()]);
    const mine = (load: () => Promise<void>) => (event: { vehicle: unknown }) => {
      if (event.vehicle === this.vehicle) void load();
    };
    const ends = [
      live.onOpen(reload),
      live.on('mission', mine(() => this.loadMission())),
      live.on('dive', mine(() => this.loadDives())),
      this.append(),
    ];
    reload();
    return () => ends.forEach((end) => end());
  }

  private append(): () => void {
    return live.subscribe(this.vehicle, ['latitude_deg', 'longitude_deg'], {
      values: (values) => {
        const [latitude, longitude] = [values['latitude_deg']?.[1], values['longitude_deg']?.[1]];
        if (latitude === undefined || longitude === undefined) return;
        const last = this.track.at(-1);
        const far = !last || Math.abs(last.latitude - latitude) + Math.abs(last.longitude - longitude) > 2e-4;
        if (far && this.track.length) this.track = [...this.track.slice(-4000), { latitude, longitude }];
      },
    });
  }

  private async loadTrack(): Promise<void> {
    const track = await api.get<Track>(`/vehicles/${this.vehicle}/track`, { points: 1500 }).catch(() => undefined);
    if (!track) return;
    this.track = track.latitude
      .map((latitude, index) => ({ latitude, longitude: track.longitude[index] ?? NaN }))
      .filter((place) => Number.isFinite(place.latitude) && Number.isFinite(place.longitude));
  }

  private async loadMission(): Promise<void> {
    const mission = await api.get<MissionAboard>(`/vehicles/${this.vehicle}/mission`).catch(() => undefined);
    if (!mission) return;
    this.waypoints = together(mission.waypoints);
    const repeats = this.waypoints.some((one) => (one.numbers?.length ?? 0) > 1);
    this.route = repeats && this.waypoints[0] ? [...this.waypoints, this.waypoints[0]] : this.waypoints;
    this.fence = mission.geofence;
  }

  private async loadDives(): Promise<void> {
    const rows = await api.get<DiveRow[]>(`/vehicles/${this.vehicle}/dives`).catch(() => undefined);
    if (!Array.isArray(rows)) return;
    const newest = [...rows].sort((a, b) => a.t_begin - b.t_begin).slice(-NEWEST_ARROWS);
    this.arrows = newest.flatMap((row, index) => arrow(row, index === newest.length - 1));
  }
}

/** Waypoints at one place become one, with all its numbers. */
export function together(waypoints: readonly MapWaypoint[]): MapWaypoint[] {
  const found = new Map<string, MapWaypoint & { numbers: number[] }>();
  waypoints.forEach((waypoint, index) => {
    const key = `${waypoint.latitude.toFixed(5)} ${waypoint.longitude.toFixed(5)}`;
    const known = found.get(key);
    if (known) known.numbers.push(index + 1);
    else found.set(key, { ...waypoint, label: String(index + 1), numbers: [index + 1] });
  });
  return [...found.values()];
}

function arrow(row: DiveRow, strong: boolean): MapArrow[] {
  const { latitude_begin, longitude_begin, latitude_end, longitude_end, current_north_m_s, current_east_m_s } = row;
  if (latitude_begin === null || longitude_begin === null || current_north_m_s === null || current_east_m_s === null) return [];
  return [
    {
      latitude: (latitude_begin + (latitude_end ?? latitude_begin)) / 2,
      longitude: (longitude_begin + (longitude_end ?? longitude_begin)) / 2,
      north_m_s: current_north_m_s,
      east_m_s: current_east_m_s,
      words: `current of dive ${row.dive}`,
      strong,
    },
  ];
}

/** The station's own chart layers; none where they cannot be had. */
export async function chartLayers(): Promise<MapLayer[]> {
  const rows = await api.get<LayerRow[]>('/layers').catch(() => []);
  if (!Array.isArray(rows)) return [];
  return rows.map((row) => {
    const layer: MapLayer = { id: row.id, name: row.name };
    if (row.bounds) layer.bounds = row.bounds;
    if (row.kind === 'geojson') layer.geojson = row.content as unknown as GeoJSON.GeoJsonObject;
    else layer.image = `./api/layers/${row.id}/image`;
    return layer;
  });
}
