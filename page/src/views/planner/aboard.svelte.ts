/** What the vehicle flies, and the missions that were uploaded. */

import { api, sentence } from '../../lib/api';
import { live } from '../../lib/live.svelte';
import type { Place } from '../../lib/map/types';
import type { MissionAboard, Mission as MissionRow } from '../../lib/types';
import { tidy, type Plan } from './plan';

export type { MissionRow };

/** The station gives no more at once. */
export const MOST_MISSIONS = 500;

export class Aboard {
  readonly vehicle: number;
  mission = $state.raw<MissionAboard | null>(null);
  /** The plan of the mission that was sent last, as it was made or as its orders tell. */
  plan = $state.raw<Plan | null>(null);
  rows = $state.raw<MissionRow[]>([]);
  reason = $state('');
  /** How many missions are asked for. */
  most = $state(100);
  /** Which missions the plan was asked for. */
  private planOf = '';

  constructor(vehicle: number) {
    this.vehicle = vehicle;
  }

  /** Waypoints of what is flown, for the map. */
  get places(): Place[] {
    return this.mission?.waypoints ?? [];
  }

  /** How much of the mission on its way has arrived, 0 to 1; null where none is. */
  get share(): number | null {
    const progress = this.mission?.upload?.progress;
    return progress ? progress.done / Math.max(1, progress.of) : null;
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
    const again = setInterval(() => {
      if (this.mission?.upload?.progress) void this.load();
    }, 1500);
    return () => {
      clearTimeout(timer);
      clearInterval(again);
      stops.forEach((stop) => stop());
    };
  }

  /** Asks for older missions too. */
  older(): void {
    this.most = MOST_MISSIONS;
    void this.load();
  }

  async load(): Promise<void> {
    try {
      const [mission, rows] = await Promise.all([
        api.get<MissionAboard>(`/vehicles/${this.vehicle}/mission`),
        api.get<MissionRow[]>(`/vehicles/${this.vehicle}/missions`, { limit: this.most }),
      ]);
      this.mission = mission;
      this.rows = rows;
      this.reason = '';
    } catch (error) {
      this.reason = sentence(error);
    }
    const sent = `${this.mission?.sha256 ?? ''} ${this.rows[0]?.id ?? ''}`;
    if (sent === this.planOf) return;
    this.planOf = sent;
    try {
      this.plan = tidy((await api.get<{ plan: Plan }>(`/vehicles/${this.vehicle}/mission/plan`)).plan);
    } catch {
      this.plan = null; // nothing was sent from here yet
    }
  }
}
