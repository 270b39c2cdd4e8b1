// The last stretch of one channel, for a small curve: from the archive, then on by itself.

import { api } from './api';
import { clock, staying } from './clock.svelte';
import { live } from './live.svelte';
import type { SeriesAnswer, VehicleKey } from './types';

export interface Points {
  t: number[];
  value: (number | null)[];
}

const POINTS = 240;
const RELOAD_MS = 120_000;

export class Trend {
  points = $state.raw<Points>({ t: [], value: [] });
  readonly span: number;
  private readonly vehicle: number;
  private readonly channel: string;
  /** Of the live socket: the vehicle, or a replay of it. */
  private readonly key: VehicleKey;

  constructor(vehicle: number, channel: string, span_s: number, key: VehicleKey = vehicle) {
    this.vehicle = vehicle;
    this.key = key;
    this.channel = channel;
    this.span = span_s;
  }

  /** Keeps it up to date until the function that comes back is called. */
  follow(): () => void {
    const timer = setInterval(() => void this.load(), RELOAD_MS);
    const opened = live.onOpen(() => void this.load());
    const ended = live.subscribe(this.key, [this.channel], {
      values: (values) => {
        const told = values[this.channel];
        if (told) this.add(told[0], told[1]);
      },
    });
    void this.load();
    return () => {
      clearInterval(timer);
      opened();
      ended();
    };
  }

  private add(t: number, value: number): void {
    if (this.points.t.length === 0) return;
    const end = staying(this.points.t, t);
    const last = this.points.t[end - 1];
    if (last !== undefined && t < last + this.span / POINTS) return;
    const first = Math.max(0, this.points.t.findIndex((one) => one > t - this.span));
    this.points = { t: [...this.points.t.slice(first, end), t], value: [...this.points.value.slice(first, end), value] };
  }

  /** Asks the archive again, for instance since a replay has jumped. */
  async load(): Promise<void> {
    const end = clock.now(this.key);
    if (end === undefined) return;
    const query = { channels: this.channel, begin: end - this.span, end, points: POINTS };
    const answer = await api.get<SeriesAnswer>(`/vehicles/${this.vehicle}/series`, query).catch(() => undefined);
    const found = answer?.channels[this.channel];
    if (found) this.points = { t: found.t, value: found.value };
  }
}
