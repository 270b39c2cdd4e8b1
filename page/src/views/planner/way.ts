/** How the map lets people edit start and waypoints: place 0 is the start, place k waypoint k - 1. */

import type { MapEditing, Place } from '../../lib/map/types';
import type { Desk } from './desk.svelte';
import { withPlace, type PlanPlace } from './plan';

/** Key in the plan of a place of the map. */
export function keyOf(index: number | undefined): string {
  return index === undefined ? '' : index === 0 ? 'start' : `waypoints.${index - 1}`;
}

/** The opposite of keyOf. */
export function indexOf(key: string): number | undefined {
  return key === 'start' ? 0 : key.startsWith('waypoints.') ? Number(key.slice(10)) + 1 : undefined;
}

export function wayEditing(desk: Desk, choose: (key: string) => void, rounded: (place: Place) => PlanPlace): MapEditing {
  const insert = (number: number, place: Place): void => {
    choose(`waypoints.${number}`);
    desk.insert('waypoints', number, rounded(place));
  };
  return {
    add: (place) => insert(desk.plan?.waypoints.length ?? 0, place),
    insert,
    move: (index, place) => {
      if (desk.plan) desk.change(withPlace(desk.plan, keyOf(index), rounded(place)), `move ${keyOf(index)}`);
    },
    remove: (index) => {
      if (index > 0) desk.remove('waypoints', index - 1);
    },
    choose: (index) => {
      desk.rest();
      choose(keyOf(index));
    },
  };
}
