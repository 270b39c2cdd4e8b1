/** What was predicted of the mission that a vehicle holds, and what became of it, as the station tells it. */

import { api, sentence } from './api';
import { live } from './live.svelte';
import type { Place } from './map/types';
import type { Comparison } from './types';

/** The track of a preview, point by point; empty where there is none. */
export function trackOf(foretold: { track: readonly { lat: number; lon: number }[] } | null | undefined): Place[] {
  return (foretold?.track ?? []).map(({ lat, lon }) => ({ latitude: lat, longitude: lon }));
}

export class MissionComparison {
  readonly vehicle: number;
  answer = $state.raw<Comparison | null>(null);
  /** Why the last answer is not there, or not the last word; empty while all is well. */
  reason = $state('');
  private loads = 0;

  constructor(vehicle: number) {
    this.vehicle = vehicle;
  }

  /** The predicted track; empty where none is known. */
  readonly track = $derived(trackOf(this.answer?.prediction));

  /** Begins to follow; the function that comes back ends it. */
  follow(): () => void {
    void this.load();
    const mine = (event: { vehicle: unknown }): void => {
      if (event.vehicle === this.vehicle) void this.load();
    };
    const stops = [live.on('dive', mine), live.on('mission', mine), live.onOpen(() => void this.load())];
    return () => stops.forEach((stop) => stop());
  }

  async load(): Promise<void> {
    const load = ++this.loads;
    try {
      const answer = await api.get<Comparison>(`/vehicles/${this.vehicle}/mission/comparison`);
      if (load !== this.loads) return;
      this.answer = answer;
      this.reason = '';
    } catch (error) {
      if (load === this.loads) this.reason = sentence(error);
    }
  }
}
