// The way from waypoint to waypoint, each leg once: a mission that goes in rounds lists the same legs up to thousands of times.

import type { Place } from './types';

/** A place at the resolution at which two waypoints are one. */
export function placeKey({ latitude, longitude }: Place): string {
  return `${latitude.toFixed(5)} ${longitude.toFixed(5)}`;
}

/** The places up to the end of the last leg that was not flown before, in either direction. */
export function routeOnce<P extends Place>(places: readonly P[]): P[] {
  const seen = new Set<string>();
  const keys = places.map(placeKey);
  let end = 0;
  for (let i = 1; i < keys.length; i += 1) {
    const leg = [keys[i - 1], keys[i]].sort().join(' to ');
    if (!seen.has(leg)) end = i;
    seen.add(leg);
  }
  return places.slice(0, end + 1);
}
