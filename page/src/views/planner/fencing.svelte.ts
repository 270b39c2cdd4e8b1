/** Drawing the geofence: whether the map edits it, and whether its line is still open. */

import type { MapEditing, Place } from '../../lib/map/types';
import type { Desk } from './desk.svelte';
import { withPlace, type PlanPlace } from './plan';

const LEAST_CORNERS = 3;
const FARTHEST_LATITUDE = 89;

export class Fencing {
  /** Whether the map edits the fence, and not the way. */
  isOn = $state(false);
  /** The corner that is chosen, from 0. */
  chosen = $state<number>();
  private isShut = $state(false);
  private readonly desk: Desk;

  constructor(desk: Desk) {
    this.desk = desk;
  }

  get corners(): readonly PlanPlace[] {
    return this.desk.plan?.geofence ?? [];
  }

  /** Whether a press on the map adds a corner behind the last. */
  get isOpen(): boolean {
    return this.isOn && !(this.isShut && this.corners.length >= LEAST_CORNERS);
  }

  get canClose(): boolean {
    return this.isOpen && this.corners.length >= LEAST_CORNERS;
  }

  /** Lets the map edit the fence; one that is an area already is not drawn on. */
  begin(): void {
    this.isShut = this.corners.length >= LEAST_CORNERS;
    this.isOn = true;
  }

  leave(): void {
    this.isOn = false;
    this.chosen = undefined;
  }

  /** The last corner leads back to the first. */
  close(): void {
    if (this.canClose) this.isShut = true;
  }

  clear(): void {
    this.put([]);
    this.isShut = false;
  }

  /** A rectangle around start and waypoints, with room about them. */
  around(): void {
    const plan = this.desk.plan;
    if (!plan) return;
    this.put(rectangle([plan.start, ...plan.waypoints]));
    this.isShut = true;
  }

  add(place: PlanPlace): void {
    this.insert(this.corners.length, place);
  }

  insert(number: number, place: PlanPlace): void {
    this.chosen = number;
    this.desk.insert('geofence', number, place);
  }

  move(number: number, place: PlanPlace): void {
    if (this.desk.plan) this.desk.change(withPlace(this.desk.plan, `geofence.${number}`, place), `move geofence.${number}`);
  }

  remove(number: number): void {
    this.desk.remove('geofence', number);
    this.chosen = undefined;
  }

  /** How the map lets people edit it. */
  editing(rounded: (place: Place) => PlanPlace): MapEditing {
    return {
      what: 'Corner',
      closed: !this.isOpen,
      ...(this.isOpen ? { add: (place: Place): void => this.add(rounded(place)) } : {}),
      ...(this.canClose ? { close: (): void => this.close() } : {}),
      insert: (index, place): void => this.insert(index + 1, rounded(place)),
      move: (index, place): void => this.move(index, rounded(place)),
      remove: (index): void => this.remove(index),
      choose: (index): void => {
        this.desk.rest();
        this.chosen = index;
      },
    };
  }

  private put(corners: PlanPlace[]): void {
    this.desk.enclose(corners);
    this.chosen = undefined;
  }
}

/** Corners of a rectangle around places, a quarter of their spread away and 2 km at least; across the date line too. */
export function rectangle(places: readonly PlanPlace[]): PlanPlace[] {
  const first = places[0];
  if (!first) return [];
  const turned = (longitude: number): number => ((((longitude + 180) % 360) + 360) % 360) - 180;
  const east = places.map((place) => turned(place.longitude_deg - first.longitude_deg));
  const north = places.map((place) => place.latitude_deg);
  const [south, top] = widened(Math.min(...north), Math.max(...north), 0.018);
  const narrow = Math.max(0.02, Math.cos((Math.max(Math.abs(south), Math.abs(top)) * Math.PI) / 180));
  const [west, right] = widened(Math.min(...east), Math.max(...east), 0.018 / narrow);
  const corner = (latitude: number, longitude: number): PlanPlace => ({
    latitude_deg: Number(Math.max(-FARTHEST_LATITUDE, Math.min(FARTHEST_LATITUDE, latitude)).toFixed(3)),
    longitude_deg: Number(turned(first.longitude_deg + longitude).toFixed(3)),
  });
  return [corner(south, west), corner(top, west), corner(top, right), corner(south, right)];
}

function widened(low: number, high: number, least: number): [number, number] {
  const room = Math.max(least, (high - low) / 4);
  return [low - room, high + room];
}
