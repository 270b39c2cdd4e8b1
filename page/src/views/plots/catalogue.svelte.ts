// What a vehicle can be drawn by: its channels, and the limits that people have set on them, now.

import { SvelteMap } from 'svelte/reactivity';

import { api, sentence } from '../../lib/api';
import { live } from '../../lib/live.svelte';
import type { Channel, Limit } from '../../lib/types';

export interface Catalogue {
  readonly channels: ReadonlyMap<string, Channel>;
  readonly limits: SvelteMap<string, Limit>;
}

export async function loadCatalogue(vehicle: number, signal?: AbortSignal): Promise<Catalogue> {
  const [channels, limits] = await Promise.all([
    api.get<Channel[]>(`/vehicles/${vehicle}/channels`, {}, signal),
    api.get<Limit[]>(`/vehicles/${vehicle}/limits`, {}, signal),
  ]);
  return {
    channels: new Map(channels.map((channel) => [channel.key, channel])),
    limits: new SvelteMap(limits.map((limit) => [limit.channel, limit])),
  };
}

/** The catalogue of a vehicle while a view shows it: asked for when the vehicle changes, its limits as people change them. */
export class Cataloguing {
  found = $state.raw<Catalogue>();
  failure = $state<string>();

  /** To be made while a view is made. */
  constructor(vehicle: () => number) {
    $effect(() => this.follow(vehicle()));
  }

  private follow(vehicle: number): () => void {
    const controller = new AbortController();
    this.found = undefined;
    this.failure = undefined;
    loadCatalogue(vehicle, controller.signal)
      .then((found) => (this.found = found))
      .catch((error: unknown) => {
        if (!controller.signal.aborted) this.failure = sentence(error);
      });
    const deaf = live.on('limit', (event) => {
      if (event.vehicle !== vehicle) return;
      const { channel, limit } = event.data;
      if (limit) this.found?.limits.set(channel, limit);
      else this.found?.limits.delete(channel);
    });
    return () => {
      controller.abort();
      deaf();
    };
  }
}
