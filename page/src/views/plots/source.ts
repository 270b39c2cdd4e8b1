// Where plots get their values from: a vehicle as it is, or a replay of what it did.

import { untrack } from 'svelte';

import { api } from '../../lib/api';
import { clock } from '../../lib/clock.svelte';
import { live } from '../../lib/live.svelte';
import type { Channel, Limit, SeriesAnswer, VehicleKey } from '../../lib/types';
import type { Traces } from './traces';

export interface Samples {
  readonly t: readonly number[];
  readonly value: readonly (number | null)[];
}

export interface LiveListener {
  onSamples(samples: ReadonlyMap<string, Samples>): void;
  /** Something was missed: the archive has to be asked again. */
  onGap(): void;
  onRefusal(reason: string): void;
}

export interface PlotSource {
  /** Tells two sources apart. */
  readonly key: string;
  /** The present of the source, UTC seconds. */
  now(): number;
  series(channels: readonly string[], begin: number, end: number, points: number, signal: AbortSignal): Promise<Traces>;
  follow(channels: readonly string[], listener: LiveListener): () => void;
  limit(channel: string): Limit | null;
  period_s(channel: string): number | null;
  /** How far behind its present a source may be heard, s of its own time: one of a person's seconds. */
  lag_s(): number;
  /** How far beyond what the page takes for the present the archive may be asked, s: it may already have more. */
  ahead_s(): number;
}

/** A clock that was told late is behind by less than this, s. */
const AHEAD_S = 10;

/** The station: the archive of a vehicle, and the live socket of it or of a replay of it. */
export class StationSource implements PlotSource {
  readonly key: string;

  constructor(
    readonly vehicle: number,
    readonly liveKey: VehicleKey,
    readonly channels: ReadonlyMap<string, Channel>,
    readonly limits: ReadonlyMap<string, Limit>,
  ) {
    this.key = String(liveKey);
  }

  now(): number {
    return untrack(() => clock.now(this.liveKey)) ?? 0;
  }

  async series(
    channels: readonly string[], begin: number, end: number, points: number, signal: AbortSignal,
  ): Promise<Traces> {
    const query = { channels: channels.join(','), begin, end, points, method: 'minmax' };
    const answer = await api.get<SeriesAnswer>(`/vehicles/${this.vehicle}/series`, query, signal);
    return new Map(Object.entries(answer.channels));
  }

  follow(channels: readonly string[], listener: LiveListener): () => void {
    const heard = {
      samples: (samples: Record<string, [number[], number[]]>): void => {
        listener.onSamples(new Map(Object.entries(samples).map(([key, [t, value]]) => [key, { t, value }])));
      },
      gap: (): void => listener.onGap(),
      error: (reason: string): void => listener.onRefusal(reason),
    };
    return live.subscribe(this.liveKey, [...channels], heard, true);
  }

  limit(channel: string): Limit | null {
    return this.limits.get(channel) ?? null;
  }

  ahead_s(): number {
    return this.liveKey === this.vehicle ? AHEAD_S * this.lag_s() : 0;
  }

  lag_s(): number {
    return untrack(() => clock.speed(this.liveKey));
  }

  period_s(channel: string): number | null {
    const known = this.channels.get(channel);
    return known ? untrack(() => live.period_s(this.liveKey, known)) : null;
  }
}
