// Natural Earth's land at 1:50 million, fetched once when the first map is opened.

import { feature } from 'topojson-client';
import type { GeometryCollection, Topology } from 'topojson-specification';
import address from 'world-atlas/land-50m.json?url';

type Polygon = GeoJSON.Position[][];

export interface LandPart {
  polygon: Polygon;
  west: number;
  east: number;
  south: number;
  north: number;
}

let asked: Promise<LandPart[]> | undefined;

function boxed(polygon: Polygon): LandPart {
  let [west, east, south, north] = [180, -180, 90, -90];
  for (const point of polygon[0] ?? []) {
    const [longitude = 0, latitude = 0] = point;
    west = Math.min(west, longitude);
    east = Math.max(east, longitude);
    south = Math.min(south, latitude);
    north = Math.max(north, latitude);
  }
  return { polygon, west, east, south, north };
}

async function fetched(): Promise<LandPart[]> {
  const topology = (await (await fetch(address)).json()) as Topology<{ land: GeometryCollection }>;
  return feature(topology, topology.objects.land).features.flatMap(({ geometry }) => {
    if (geometry.type === 'Polygon') return [boxed(geometry.coordinates)];
    return geometry.type === 'MultiPolygon' ? geometry.coordinates.map(boxed) : [];
  });
}

/** All land as polygons with their boxes. A failure is not remembered: the next map tries again. */
export function land(): Promise<LandPart[]> {
  asked ??= fetched().catch((error: unknown) => {
    asked = undefined;
    throw error;
  });
  return asked;
}

/** The land that can be seen between these bounds, degrees; the whole of it where the view is wide. */
export function landWithin(parts: LandPart[], west: number, east: number, south: number, north: number): GeoJSON.MultiPolygon {
  const wide = east - west > 180;
  const seen = parts.filter((part) => {
    if (part.north < south || part.south > north) return false;
    return wide || [-360, 0, 360].some((turn) => part.east + turn >= west && part.west + turn <= east);
  });
  return { type: 'MultiPolygon', coordinates: seen.map((part) => part.polygon) };
}
