// Where a map looks: centre and scale, moved by people, fitted to what is there. Pure functions.

import { geoMercator, type GeoProjection } from 'd3-geo';
import type { Place } from './types';

export interface MapView extends Place {
  /** Pixels to a radian of longitude. */
  scale: number;
}

export interface Size {
  width: number;
  height: number;
}

export const EARTH_M = 6371008.8;
const LEAST_SCALE = 40;
const GREATEST_SCALE = 4e7;
const FARTHEST_LATITUDE = 84;
const RADIANS = Math.PI / 180;

export function wrapped(longitude: number): number {
  return ((((longitude + 180) % 360) + 360) % 360) - 180;
}

function kept(view: MapView): MapView {
  return {
    latitude: Math.max(-FARTHEST_LATITUDE, Math.min(FARTHEST_LATITUDE, view.latitude)),
    longitude: wrapped(view.longitude),
    scale: Math.max(LEAST_SCALE, Math.min(GREATEST_SCALE, view.scale)),
  };
}

export function projection(view: MapView, size: Size, margin = 60): GeoProjection {
  return geoMercator()
    .rotate([-view.longitude, 0])
    .center([0, view.latitude])
    .scale(view.scale)
    .translate([size.width / 2, size.height / 2])
    .precision(0)
    .clipExtent([
      [-margin, -margin],
      [size.width + margin, size.height + margin],
    ]);
}

/** The place below a pixel. */
export function placeAt(view: MapView, size: Size, x: number, y: number): Place {
  const found = projection(view, size).invert?.([x, y]) ?? [view.longitude, view.latitude];
  return { longitude: wrapped(found[0]), latitude: found[1] };
}

export function moved(view: MapView, size: Size, dx: number, dy: number): MapView {
  return kept({ ...placeAt(view, size, size.width / 2 - dx, size.height / 2 - dy), scale: view.scale });
}

/** Nearer by a factor, while the place below a pixel stays there. */
export function zoomed(view: MapView, size: Size, factor: number, x = size.width / 2, y = size.height / 2): MapView {
  const fixed = placeAt(view, size, x, y);
  const nearer = kept({ ...view, scale: view.scale * factor });
  const there = projection(nearer, size)([fixed.longitude, fixed.latitude]) ?? [x, y];
  return moved(nearer, size, x - there[0], y - there[1]);
}

/** The view that shows all places with room around them; at least `least_m` across. */
export function fitted(places: readonly Place[], size: Size, least_m = 4000, padding = 48): MapView | undefined {
  const first = places[0];
  if (!first || size.width < 20 || size.height < 20) return undefined;
  const mercator = (latitude: number): number => Math.asinh(Math.tan(latitude * RADIANS));
  const east = places.map((place) => wrapped(place.longitude - first.longitude) * RADIANS);
  const north = places.map((place) => mercator(Math.max(-FARTHEST_LATITUDE, Math.min(FARTHEST_LATITUDE, place.latitude))));
  const [west, right] = [Math.min(...east), Math.max(...east)];
  const [south, top] = [Math.min(...north), Math.max(...north)];
  const latitude = Math.atan(Math.sinh((south + top) / 2)) / RADIANS;
  const least = least_m / EARTH_M / Math.cos(latitude * RADIANS);
  const across = Math.max(right - west, least);
  const up = Math.max(top - south, least);
  const scale = Math.min(
    Math.max(20, size.width - 2 * padding) / across,
    Math.max(20, size.height - 2 * padding) / up,
  );
  return kept({ latitude, longitude: first.longitude + (west + right) / 2 / RADIANS, scale });
}

/** Places as far from one as a radius, so that a map that shows them shows its circle. */
export function around(place: Place, radius_m: number): Place[] {
  const north = radius_m / EARTH_M / RADIANS;
  const east = north / Math.max(0.05, Math.cos(place.latitude * RADIANS));
  return [
    { latitude: place.latitude - north, longitude: wrapped(place.longitude - east) },
    { latitude: place.latitude + north, longitude: wrapped(place.longitude + east) },
  ];
}

export function pixelsPerMetre(view: MapView, latitude = view.latitude): number {
  return view.scale / EARTH_M / Math.cos(latitude * RADIANS);
}

/** The round length whose bar is at most this many pixels long. */
export function scaleBar(view: MapView, most = 120): { metres: number; pixels: number } {
  const ratio = pixelsPerMetre(view);
  const longest = most / ratio;
  const power = 10 ** Math.floor(Math.log10(longest));
  const metres = ([5, 2, 1].find((step) => step * power <= longest) ?? 1) * power;
  return { metres, pixels: metres * ratio };
}

const STEPS = [30, 20, 10, 5, 2, 1, 1 / 2, 1 / 3, 1 / 6, 1 / 12, 1 / 30, 1 / 60, 1 / 120, 1 / 300, 1 / 600, 1 / 1200, 1 / 6000];

/** Degrees between meridians of the graticule (or, stretched, parallels), about `apart` pixels from each other. */
export function graticuleStep(view: MapView, apart = 130, stretched = false): number {
  const degrees = (apart / (view.scale * RADIANS)) * (stretched ? Math.cos(view.latitude * RADIANS) : 1);
  return STEPS.find((step) => step <= degrees) ?? 1 / 6000;
}

/** A value on the graticule in degrees and minutes, as short as its step allows. */
export function graticuleLabel(value: number, step: number, letters: [string, string]): string {
  const isNeither = Math.abs(value) < 1e-9 || Math.abs(Math.abs(value) - 180) < 1e-9;
  const letter = isNeither ? '' : value < 0 ? letters[1] : letters[0];
  const digits = step >= 1 / 60 - 1e-9 ? 0 : step >= 1 / 600 - 1e-9 ? 1 : 2;
  const unit = 60 * 10 ** digits;
  const whole = Math.round(Math.abs(value) * unit);
  const degrees = Math.floor(whole / unit);
  const minutes = (whole % unit) / 10 ** digits;
  if (step >= 1) return `${degrees}°${letter}`;
  return `${degrees}°${minutes.toFixed(digits).padStart(digits ? 3 + digits : 2, '0')}′${letter}`;
}
