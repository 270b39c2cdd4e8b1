// What a vehicle can be drawn by: its channels, and the limits that people have set on them.

import { api } from '../../lib/api';
import type { Channel, Limit } from '../../lib/types';

export interface Catalogue {
  readonly channels: ReadonlyMap<string, Channel>;
  readonly limits: ReadonlyMap<string, Limit>;
}

export async function loadCatalogue(vehicle: number, signal?: AbortSignal): Promise<Catalogue> {
  const [channels, limits] = await Promise.all([
    api.get<Channel[]>(`/vehicles/${vehicle}/channels`, {}, signal),
    api.get<Limit[]>(`/vehicles/${vehicle}/limits`, {}, signal),
  ]);
  return {
    channels: new Map(channels.map((channel) => [channel.key, channel])),
    limits: new Map(limits.map((limit) => [limit.channel, limit])),
  };
}
