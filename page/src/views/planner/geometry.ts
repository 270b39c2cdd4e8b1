/** Distances and directions on the sphere, for a chart and a table; the station computes what is flown. */

export interface Place {
  latitude: number;
  longitude: number;
}

const RADIUS_M = 6_371_008.8;
const RAD = Math.PI / 180;

/** Great-circle distance [m]. */
export function distance(a: Place, b: Place): number {
  const north = (b.latitude - a.latitude) * RAD;
  const east = (b.longitude - a.longitude) * RAD;
  const h =
    Math.sin(north / 2) ** 2 + Math.cos(a.latitude * RAD) * Math.cos(b.latitude * RAD) * Math.sin(east / 2) ** 2;
  return 2 * RADIUS_M * Math.asin(Math.min(1, Math.sqrt(h)));
}

/** Direction from one place to another, clockwise from north [deg], 0 up to 360. */
export function course(a: Place, b: Place): number {
  const east = (b.longitude - a.longitude) * RAD;
  const y = Math.sin(east) * Math.cos(b.latitude * RAD);
  const x =
    Math.cos(a.latitude * RAD) * Math.sin(b.latitude * RAD) -
    Math.sin(a.latitude * RAD) * Math.cos(b.latitude * RAD) * Math.cos(east);
  return (Math.atan2(y, x) / RAD + 360) % 360;
}

/** Lengths of the legs [m]: to each place from the one before. */
export function legs(places: Place[]): number[] {
  return places.slice(1).map((place, index) => distance(places[index] as Place, place));
}

/** The place half-way, for the handle by which a leg is split. */
export function middle(a: Place, b: Place): Place {
  const east = wrapped(b.longitude - a.longitude);
  return { latitude: (a.latitude + b.latitude) / 2, longitude: wrapped(a.longitude + east / 2) };
}

/** A longitude above -180 and up to 180. */
export function wrapped(longitude: number): number {
  const turned = ((((longitude + 180) % 360) + 360) % 360) - 180;
  return turned === -180 ? 180 : turned;
}

/** Read a latitude or longitude as people write it: 29.5, -122.3, 29.5N, 29 30.5 N, 122° 18' 30" W; NaN if it is none. */
export function degreesOf(text: string, axis: 'latitude' | 'longitude'): number {
  const tidy = text.trim().toUpperCase().replaceAll(',', '.');
  const letters = axis === 'latitude' ? 'NS' : 'EW';
  const match = /^([+-]?)(\d+(?:\.\d+)?)(?:[°\s]+(\d+(?:\.\d+)?))?(?:['′\s]+(\d+(?:\.\d+)?))?["″'′°\s]*([NSEW]?)$/.exec(
    tidy,
  );
  if (!match) return Number.NaN;
  const [, sign, degrees, minutes, seconds, letter] = match;
  if (letter && !letters.includes(letter)) return Number.NaN;
  if (sign && letter) return Number.NaN;
  if (Number(minutes ?? 0) >= 60 || Number(seconds ?? 0) >= 60) return Number.NaN;
  const value = Number(degrees) + Number(minutes ?? 0) / 60 + Number(seconds ?? 0) / 3600;
  const signed = sign === '-' || letter === 'S' || letter === 'W' ? -value : value;
  if (axis === 'latitude') return Math.abs(signed) <= 90 ? signed : Number.NaN;
  return signed >= -180 && signed <= 360 ? wrapped(signed) : Number.NaN;
}

/** Energy in words [J in]. */
export function energyWords(joules: number): string {
  if (!Number.isFinite(joules)) return '—';
  const wh = joules / 3600;
  return wh < 10 ? `${wh.toFixed(2)} Wh` : wh < 1000 ? `${wh.toFixed(0)} Wh` : `${(wh / 1000).toFixed(2)} kWh`;
}
