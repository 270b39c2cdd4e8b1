// What hardly changes of a vehicle: its channels, limits and shape. Asked for once, and again when limits change.

import { api, sentence } from './api';
import { live } from './live.svelte';
import type { Channel, Limit, Shape, VehicleDetail } from './types';

export class VehicleInfo {
  readonly vehicle: number;
  channels = $state.raw<Channel[]>([]);
  limits = $state.raw<Record<string, Limit>>({});
  shape = $state.raw<Shape | null>(null);
  loaded = $state(false);
  reason = $state<string | undefined>(undefined);
  private isLoading = false;

  constructor(vehicle: number) {
    this.vehicle = vehicle;
    void this.load();
    live.onOpen(() => {
      if (!this.isLoading) void this.load();
    });
    live.on('limit', (event) => {
      if (event.vehicle === vehicle) void this.load();
    });
  }

  channel(key: string): Channel | undefined {
    return this.channels.find((channel) => channel.key === key);
  }

  async load(): Promise<void> {
    this.isLoading = true;
    try {
      const detail = await api.get<VehicleDetail>(`/vehicles/${this.vehicle}`);
      if (live.state !== 'open') live.put(detail);
      this.channels = same(this.channels, detail.channels ?? (await api.get<Channel[]>(`/vehicles/${this.vehicle}/channels`)));
      this.limits = byChannel(detail.limits ?? []);
      this.shape = same(this.shape, detail.shape ?? (await api.get<Shape>(`/vehicles/${this.vehicle}/shape`).catch(() => null)));
      this.loaded = true;
      this.reason = undefined;
    } catch (error) {
      this.reason = sentence(error);
    }
    this.isLoading = false;
  }
}

/** What was known before, where what is found is equal to it: nobody who looks at it has to look again. */
function same<T>(known: T, found: T): T {
  return JSON.stringify(known) === JSON.stringify(found) ? known : found;
}

function byChannel(limits: Limit[] | Record<string, Limit>): Record<string, Limit> {
  return Array.isArray(limits) ? Object.fromEntries(limits.map((limit) => [limit.channel, limit])) : limits;
}

const known = new Map<number, VehicleInfo>();

/** The one VehicleInfo of a vehicle. */
export function vehicleInfo(vehicle: number): VehicleInfo {
  let info = known.get(vehicle);
  if (!info) {
    info = new VehicleInfo(vehicle);
    known.set(vehicle, info);
  }
  return info;
}

/** Forgets everything, for instance since somebody else signs in. */
export function forgetVehicles(): void {
  known.clear();
}
