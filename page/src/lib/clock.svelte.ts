// Time of each vehicle's world, as the server tells it; the browser's own clock is asked for nothing.

import type { VehicleKey } from './types';

/** Whose clock tells the times of what belongs to no vehicle. */
export const STATION = 'station';

/** A value older than the one before it by more than this [s] says that the vehicle's clock was set back. */
const SET_BACK_S = 60;

/** How many values stay, by their times, when one of time t comes: where the clock was set back, those before t. */
export function staying(times: readonly number[], t: number): number {
  const last = times.at(-1);
  return last !== undefined && t < last - SET_BACK_S ? times.findIndex((one) => one >= t) : times.length;
}

interface Told {
  now: number;
  speed: number;
  at: number;
}

class Clock {
  /** Rises twice a second, so that what shows an age is drawn anew. */
  beat = $state(0);
  private told = new Map<VehicleKey, Told>();
  private timer: ReturnType<typeof setInterval> | undefined;

  start(): void {
    this.timer ??= setInterval(() => (this.beat += 1), 500);
  }

  stop(): void {
    clearInterval(this.timer);
    this.timer = undefined;
  }

  /** The server says what time it is for a vehicle. An answer that was long under way does not set the clock back. */
  tell(vehicle: VehicleKey, now: number, speed?: number): void {
    const before = this.told.get(vehicle);
    const rate = speed ?? before?.speed ?? 1;
    const at = performance.now();
    if (before && speed === undefined) {
      const expected = before.now + ((at - before.at) / 1000) * before.speed;
      if (now < expected && expected - now < 2 * rate) return;
    }
    this.told.set(vehicle, { now, speed: rate, at });
  }

  /** UTC of the vehicle's world, s since 1970; undefined before the server has said it. */
  now(vehicle: VehicleKey): number | undefined {
    void this.beat;
    const told = this.told.get(vehicle);
    return told && told.now + ((performance.now() - told.at) / 1000) * told.speed;
  }

  /** Seconds of the vehicle's world since t. */
  age(vehicle: VehicleKey, t: number | null | undefined): number | undefined {
    const now = this.now(vehicle);
    return now === undefined || t === null || t === undefined ? undefined : Math.max(0, now - t);
  }

  speed(vehicle: VehicleKey): number {
    return this.told.get(vehicle)?.speed ?? 1;
  }
}

export const clock = new Clock();
