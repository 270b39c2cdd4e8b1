// A vehicle as maps draw it.

import { clock } from '../clock.svelte';
import type { VehicleKey, VehicleSummary } from '../types';
import { duration } from '../units';
import type { MapVehicle } from './types';

const STALE_S = 3600;

/** Where a vehicle is; nothing where that is not known. One that was there more than an hour ago is shown as old. */
export function mapVehicles(summary: VehicleSummary | undefined, key: VehicleKey, heading_deg?: number | null): MapVehicle[] {
  if (!summary?.position) return [];
  const age = clock.age(key, summary.position.t) ?? 0;
  const stale = age > STALE_S;
  const name = stale ? `${summary.name}, ${duration(age)} ago` : summary.name;
  return [{ ...summary.position, vehicle: summary.vehicle, name, heading_deg, stale }];
}
