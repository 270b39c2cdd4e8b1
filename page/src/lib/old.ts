// Whether what is shown is older than it should be.

import { clock } from './clock.svelte';
import { live } from './live.svelte';
import type { Channel, VehicleKey } from './types';

/** One value may just be on its way, and a second for the way. */
export function isOld(age_s: number | undefined, period_s: number | null | undefined): boolean {
  return age_s !== undefined && period_s !== null && period_s !== undefined && age_s > 2 * period_s + 1;
}

/** Age of a value of a channel, s, if it is old; a value may be under way for lag_s. */
export function oldBy(
  vehicle: VehicleKey, channel: Channel | undefined, t: number | undefined, lag_s: number,
): number | undefined {
  const age = clock.age(vehicle, t);
  return channel && isOld(age, live.period_s(vehicle, channel) + lag_s) ? age : undefined;
}
