// The track that was predicted of the mission aboard, on maps: whether they show it is a choice of whoever looks.

import { untrack } from 'svelte';
import { keptChoice } from '../choice';
import { MissionComparison } from '../comparison.svelte';
import type { MapTrack } from './types';

const kept = keptChoice('stommel-predicted');
const SHOWN = 'shown';

class PredictedChoice {
  isShown = $state(kept.read() === SHOWN);

  toggle(): void {
    this.isShown = !this.isShown;
    kept.keep(this.isShown ? SHOWN : null);
  }
}

export const predictedChoice = new PredictedChoice();

/** In the colour of a mission aboard, or of its vehicle where there are several. */
export function comparisonTrack({ vehicle, track }: MissionComparison, colour = 'series-3'): MapTrack[] {
  return track.length > 1 ? [{ id: `predicted ${vehicle}`, kind: 'predicted', places: track, colour }] : [];
}

/** Those of some vehicles, followed while maps show them; it is made where a component is set up. */
export class PredictedTracks {
  private comparisons = $state.raw<MissionComparison[]>([]);

  constructor(vehicles: () => readonly number[]) {
    $effect(() => {
      const all = predictedChoice.isShown ? vehicles().map((vehicle) => new MissionComparison(vehicle)) : [];
      this.comparisons = all;
      const ends = untrack(() => all.map((one) => one.follow()));
      return () => ends.forEach((end) => end());
    });
  }

  track(vehicle: number, colour?: string): MapTrack[] {
    const found = this.comparisons.find((one) => one.vehicle === vehicle);
    return found ? comparisonTrack(found, colour) : [];
  }

  /** What the lines are, or that there are none; empty where they are not shown or not known yet. */
  get words(): string {
    if (this.comparisons.some((one) => one.track.length > 1)) return 'dotted: predicted before the upload';
    const isKnown = this.comparisons.length > 0 && this.comparisons.every((one) => one.answer !== null);
    return isKnown ? 'no predicted track is kept of the mission aboard' : '';
  }
}
