// What can be read off a map, point by point: when a vehicle was where and how surely, and the current of each dive.

import { dateTime, distance, latitude, longitude } from '../units';
import { sure } from './sure';
import type { MapArrow, MapTrack, Place, TrackPlace } from './types';

export interface Probe {
  id: string;
  label: string;
  places: readonly Place[];
  words: (index: number) => string;
}

export function placeWords(place: TrackPlace): string {
  const radius = sure(place.sigma_m);
  const doubt = radius === null ? '' : `, ± ${distance(radius)}`;
  const source = place.source === 'gps' ? 'fix by GPS' : 'estimate';
  return `${dateTime(place.t)} UTC, ${latitude(place.latitude)} ${longitude(place.longitude)}${doubt}, ${source}`;
}

export function isTold(place: Place): place is TrackPlace {
  return 'source' in place;
}

export function probesOf(tracks: readonly MapTrack[], arrows: readonly MapArrow[]): Probe[] {
  const found: Probe[] = [];
  for (const { id, words = 'Track', places } of tracks) {
    const told = places.filter(isTold);
    if (told.length) found.push({ id, label: words, places: told, words: (index) => (told[index] ? placeWords(told[index]) : '') });
  }
  const said = arrows.filter((arrow) => arrow.words);
  if (said.length) found.push({ id: 'currents', label: 'Currents', places: said, words: (index) => said[index]?.words ?? '' });
  return found;
}
