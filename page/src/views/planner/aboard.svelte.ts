/** What the vehicle flies, and the missions that were uploaded. */

import { api, sentence } from '../../lib/api';
import { live } from '../../lib/live.svelte';
import type { Place } from '../../lib/map/types';
import { tidy, type Plan } from './plan';

export interface MissionRow {
  id: number;
  t: number;
  user: string | null;
  name: string;
  sha256: string;
  state: string;
  words?: string | null;
  plan?: unknown;
  share?: number | null;
  history?: { t: number; state: string; words: string | null; user?: string | null }[];
}

interface MissionAboard {
  name: string | null;
  number?: number | null;
  sha256?: string | null;
  waypoints?: (Place & { radius_m?: number | null })[];
  missing?: string | null;
}

export class Aboard {
  readonly vehicle: number;
  mission = $state.raw<MissionAboard | null>(null);
  /** The plan of the mission that was sent last, as it was made or as its orders tell. */
  plan = $state.raw<Plan | null>(null);
  rows = $state.raw<MissionRow[]>([]);
  reason = $state('');

  constructor(vehicle: number) {
    this.vehicle = vehicle;
  }

  /** Waypoints of what is flown, for the map. */
  get places(): Place[] {
    return this.mission?.waypoints ?? [];
  }

  /** The mission that was uploaded last. */
  get latest(): MissionRow | null {
    return this.rows[0] ?? null;
  }

  /** Begins to follow; the function that comes back ends it. */
  start(): () => void {
    void this.load();
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stops = [
      live.on('mission', (event) => {
        if (event.vehicle !== this.vehicle) return;
        clearTimeout(timer);
        timer = setTimeout(() => void this.load(), 200);
      }),
      live.onOpen(() => void this.load()),
    ];
    return () => {
      clearTimeout(timer);
      stops.forEach((stop) => stop());
    };
  }

  async load(): Promise<void> {
    try {
      const [mission, rows] = await Promise.all([
        api.get<MissionAboard>(`/vehicles/${this.vehicle}/mission`),
        api.get<MissionRow[]>(`/vehicles/${this.vehicle}/missions`),
      ]);
      this.mission = mission;
      this.rows = [...rows].sort((a, b) => b.t - a.t);
      this.reason = '';
    } catch (error) {
      this.reason = sentence(error);
    }
    try {
      this.plan = tidy((await api.get<{ plan: Plan }>(`/vehicles/${this.vehicle}/mission/plan`)).plan);
    } catch {
      this.plan = null; // nothing was sent from here yet
    }
  }
}
