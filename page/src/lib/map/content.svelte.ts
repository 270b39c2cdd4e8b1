// What the station knows of a vehicle for a map: track, mission aboard, currents of its dives, chart layers.

import { untrack } from 'svelte';
import { api } from '../api';
import { clock, staying } from '../clock.svelte';
import { live } from '../live.svelte';
import type { DiveRow, LayerRow, MissionAboard, Position, Track, VehicleKey } from '../types';
import { course, quantity, velocity } from '../units';
import { placeKey, routeOnce } from './route';
import { spanWords, trackSpan } from './span.svelte';
import type { MapArrow, MapLayer, MapWaypoint, Place, TrackPlace } from './types';

const NEWEST_ARROWS = 60;
const POINTS = 1500;
/** With more the track is asked for anew, thinned. */
const MOST_POINTS = 4000;
const NEAR_DEG = 2e-4;

export class MapContent {
  track = $state.raw<TrackPlace[]>([]);
  /** From when to when the track goes, s since 1970; undefined where nothing is known. */
  span = $state.raw<readonly [number, number] | undefined>(undefined);
  /** Positions at which the vehicle cannot have been, which the station has left out. */
  leftOut = $state(0);
  waypoints = $state.raw<MapWaypoint[]>([]);
  /** From waypoint to waypoint, each leg once. */
  route = $state.raw<Place[]>([]);
  fence = $state.raw<Place[]>([]);
  arrows = $state.raw<MapArrow[]>([]);
  readonly vehicle: number;
  /** Of the live socket: the vehicle, or a replay of it, of which nothing is shown that had not happened. */
  private readonly key: VehicleKey;
  private loads = 0;

  constructor(vehicle: number, key: VehicleKey = vehicle) {
    this.vehicle = vehicle;
    this.key = key;
  }

  /** Fetches everything and keeps it up to date until the function that comes back is called. */
  follow(): () => void {
    const mine = (load: () => Promise<void>) => (event: { vehicle: unknown }) => {
      if (event.vehicle === this.key) void load();
    };
    const ends = [
      live.onOpen(() => void this.load()),
      live.on('mission', mine(() => this.load())),
      live.on('dive', mine(() => this.loadDives())),
      $effect.root(() => {
        let first = true;
        $effect(() => {
          void trackSpan.chosen;
          if (!first) untrack(() => void this.load());
          first = false;
        });
      }),
    ];
    untrack(() => void this.load());
    return () => ends.forEach((end) => end());
  }

  /** Fetches everything again, for instance since a replay has jumped. */
  async load(): Promise<void> {
    this.loads += 1;
    await Promise.all([this.loadTrack(), this.loadMission(), this.loadDives()]);
  }

  /** The present of a replay; undefined for the vehicle as it is. */
  private get until(): number | undefined {
    return this.key === this.vehicle ? undefined : clock.now(this.key);
  }

  /** Goes on with a position that the station has just told, which has sifted it. */
  take(position: Position | null | undefined): void {
    if (!position || !this.span) return;
    const end = staying(this.track.map((one) => one.t), position.t);
    if (end < this.track.length) {
      this.track = this.track.slice(0, end);
      void this.load();
    }
    const last = this.track.at(-1);
    if (!last || position.t <= last.t) return;
    this.span = [this.span[0], position.t];
    if (Math.abs(last.latitude - position.latitude) + Math.abs(last.longitude - position.longitude) <= NEAR_DEG) return;
    const { latitude, longitude, t, sigma_m, source } = position;
    this.track = [...this.track, { latitude, longitude, t, sigma_m, source }];
    if (this.track.length > MOST_POINTS) void this.load();
  }

  /** From when to when the track goes, in words; empty where there is none. */
  get words(): string {
    if (!this.span || this.track.length < 2) return '';
    const out = this.leftOut ? `, ${this.leftOut} impossible ${this.leftOut === 1 ? 'position' : 'positions'} left out` : '';
    return spanWords(...this.span, clock.now(this.key)) + out;
  }

  private async loadTrack(): Promise<void> {
    const [end, load] = [this.until, this.loads];
    const query = { points: POINTS, end, span: trackSpan.chosen };
    const track = await api.get<Track>(`/vehicles/${this.vehicle}/track`, query).catch(() => undefined);
    if (!track || load !== this.loads) return;
    this.track = track.t.flatMap((t, index): TrackPlace[] => {
      const [latitude, longitude] = [track.latitude[index], track.longitude[index]];
      if (latitude === undefined || longitude === undefined) return [];
      return [{ latitude, longitude, t, sigma_m: track.sigma_m[index] ?? null, source: track.source[index] ?? 'estimate' }];
    });
    this.span = [track.begin, track.end];
    this.leftOut = track.left_out;
  }

  private async loadMission(): Promise<void> {
    const load = this.loads;
    const query = { at: this.until };
    const mission = await api.get<MissionAboard>(`/vehicles/${this.vehicle}/mission`, query).catch(() => undefined);
    if (!mission || load !== this.loads) return;
    this.waypoints = together(mission.waypoints);
    this.route = routeOnce(mission.waypoints);
    this.fence = mission.geofence;
  }

  private async loadDives(): Promise<void> {
    const [end, load] = [this.until ?? Infinity, this.loads];
    const rows = await api.get<DiveRow[]>(`/vehicles/${this.vehicle}/dives`).catch(() => undefined);
    if (!Array.isArray(rows) || load !== this.loads) return;
    const newest = rows.filter((row) => (row.t_end ?? row.t_begin) <= end).sort((a, b) => a.t_begin - b.t_begin).slice(-NEWEST_ARROWS);
    this.arrows = newest.flatMap((row, index) => arrow(row, index === newest.length - 1));
  }
}

/** Waypoints at one place become one, with all its numbers. */
export function together(waypoints: readonly MapWaypoint[]): MapWaypoint[] {
  const found = new Map<string, MapWaypoint & { numbers: number[] }>();
  waypoints.forEach((waypoint, index) => {
    const key = placeKey(waypoint);
    const known = found.get(key);
    if (known) known.numbers.push(index + 1);
    else found.set(key, { ...waypoint, label: String(index + 1), numbers: [index + 1] });
  });
  return [...found.values()];
}

function arrow(row: DiveRow, strong: boolean): MapArrow[] {
  const { latitude_begin, longitude_begin, latitude_end, longitude_end, current_north_m_s, current_east_m_s } = row;
  if (latitude_begin === null || longitude_begin === null || current_north_m_s === null || current_east_m_s === null) return [];
  const flow = velocity(current_north_m_s, current_east_m_s);
  return [
    {
      latitude: (latitude_begin + (latitude_end ?? latitude_begin)) / 2,
      longitude: (longitude_begin + (longitude_end ?? longitude_begin)) / 2,
      north_m_s: current_north_m_s,
      east_m_s: current_east_m_s,
      words: `Current of dive ${row.dive}: ${quantity(flow.speed, 'm/s', 2)} ${course(flow.course)}`,
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
