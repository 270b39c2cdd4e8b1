// Draws what does not move by hand: land, graticule, chart layers, tracks, fence, arrows. On a canvas, as fast as dragging.

import { geoPath, type GeoProjection } from 'd3-geo';
import { token } from '../theme.svelte';
import { landWithin, type LandPart } from './land';
import { isTold } from './probes';
import type { MapArrow, MapFence, MapLayer, MapMark, MapTrack, Place } from './types';
import { graticuleLabel, graticuleStep, pixelsPerMetre, placeAt, projection, wrapped, type MapView, type Size } from './view';

export interface Scene {
  land: LandPart[];
  layers: readonly MapLayer[];
  images: ReadonlyMap<string, HTMLImageElement>;
  tracks: readonly MapTrack[];
  fences: readonly MapFence[];
  /** Whether the fence is still being drawn: its last side is not there yet. */
  fenceOpen: boolean;
  marks: readonly MapMark[];
  arrows: readonly MapArrow[];
  circles: readonly (Place & { radius_m: number; kind: 'waypoint' | 'uncertainty' })[];
}

/** Pixels of an arrow to 1 m/s. */
export const ARROW_PX = 150;

type Context = CanvasRenderingContext2D;

export function draw(context: Context, view: MapView, size: Size, scene: Scene): void {
  const project = projection(view, size);
  context.clearRect(0, 0, size.width, size.height);
  context.fillStyle = token('sea');
  context.fillRect(0, 0, size.width, size.height);
  context.lineJoin = 'round';
  drawLand(context, project, view, size, scene.land);
  for (const layer of scene.layers) drawLayer(context, project, layer, scene.images);
  const labels = drawGraticule(context, project, view, size);
  for (const fence of scene.fences) drawFence(context, project, fence, scene.fenceOpen);
  for (const circle of scene.circles) drawCircle(context, project, view, circle);
  for (const track of scene.tracks) drawTrack(context, project, track);
  drawArrows(context, project, scene.arrows);
  for (const mark of scene.marks) drawMark(context, project, mark);
  context.fillStyle = token('ink-2');
  context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = 'left';
  for (const label of labels) haloed(context, ...label);
}

type Label = [words: string, x: number, y: number];

/** Words that can be read on whatever lies below. */
function haloed(context: Context, words: string, x: number, y: number): void {
  context.lineWidth = 3;
  context.strokeStyle = token('sea');
  context.strokeText(words, x, y);
  context.fillText(words, x, y);
}

function bounds(view: MapView, size: Size): [number, number, number, number] {
  const half = (size.width / 2 / view.scale) * (180 / Math.PI);
  const top = placeAt(view, size, size.width / 2, 0).latitude;
  const bottom = placeAt(view, size, size.width / 2, size.height).latitude;
  return [view.longitude - half, view.longitude + half, bottom, top];
}

function drawLand(context: Context, project: GeoProjection, view: MapView, size: Size, parts: LandPart[]): void {
  const [west, east, south, north] = bounds(view, size);
  context.beginPath();
  geoPath(project, context)(landWithin(parts, west, east, south, north));
  context.fillStyle = token('land');
  context.fill();
  context.strokeStyle = token('coast');
  context.lineWidth = 1;
  context.stroke();
}

function drawLayer(context: Context, project: GeoProjection, layer: MapLayer, images: Scene['images']): void {
  const image = layer.image === undefined ? undefined : images.get(layer.image);
  if (image && layer.bounds) drawImage(context, project, image, layer.bounds);
  if (!layer.geojson) return;
  context.beginPath();
  geoPath(project, context).pointRadius(3)(layer.geojson as Parameters<ReturnType<typeof geoPath>>[0]);
  context.strokeStyle = token('ink-3');
  context.lineWidth = 1;
  context.stroke();
}

/** An image whose rows are evenly spaced in latitude, strip by strip, as Mercator's are not. */
function drawImage(context: Context, project: GeoProjection, image: HTMLImageElement, bounds: NonNullable<MapLayer['bounds']>): void {
  const [west, south, east, north] = bounds;
  const strips = Math.min(96, Math.max(1, Math.ceil((north - south) * 4)));
  const rows = image.naturalHeight / strips;
  for (let i = 0; i < strips; i += 1) {
    const upper = project([west, north - ((north - south) * i) / strips]);
    const lower = project([east, north - ((north - south) * (i + 1)) / strips]);
    if (!upper || !lower) continue;
    const [width, height] = [lower[0] - upper[0], lower[1] - upper[1]];
    context.drawImage(image, 0, i * rows, image.naturalWidth, rows, upper[0], upper[1], width, height + (i + 1 < strips ? 0.5 : 0));
  }
}

function drawGraticule(context: Context, project: GeoProjection, view: MapView, size: Size): Label[] {
  const [west, east, south, north] = bounds(view, size);
  const [step, rowStep] = [graticuleStep(view), graticuleStep(view, 130, true)];
  context.strokeStyle = token('ink');
  context.lineWidth = 1;
  context.globalAlpha = 0.13;
  context.beginPath();
  const columns: [number, number][] = [];
  const rows: [number, number][] = [];
  for (let i = Math.ceil(west / step); i * step <= east; i += 1) {
    const x = Math.round(project([i * step, view.latitude])?.[0] ?? 0) + 0.5;
    columns.push([wrapped(i * step), x]);
    context.moveTo(x, 0);
    context.lineTo(x, size.height);
  }
  for (let i = Math.ceil(south / rowStep); i * rowStep <= north; i += 1) {
    const y = Math.round(project([view.longitude, i * rowStep])?.[1] ?? 0) + 0.5;
    rows.push([i * rowStep, y]);
    context.moveTo(0, y);
    context.lineTo(size.width, y);
  }
  context.stroke();
  context.globalAlpha = 1;
  return [
    ...columns.filter(([, x]) => x > 60).map(([value, x]): Label => [graticuleLabel(value, step, ['E', 'W']), x + 3, 12]),
    ...rows.filter(([, y]) => y > 30).map(([value, y]): Label => [graticuleLabel(value, rowStep, ['N', 'S']), 4, y - 3]),
  ];
}

function drawFence(context: Context, project: GeoProjection, { places: fence, colour = 'warning' }: MapFence, open: boolean): void {
  const [first, last] = [fence[0], fence.at(-1)];
  if (!first || !last || fence.length < 2) return;
  const isArea = fence.length > 2;
  context.strokeStyle = token(colour);
  if (isArea) {
    context.beginPath();
    line(context, project, [...fence, first]);
    context.fillStyle = token(colour);
    context.globalAlpha = 0.04;
    context.fill();
    context.globalAlpha = 1;
  }
  context.beginPath();
  line(context, project, open || !isArea ? fence : [...fence, first]);
  context.lineWidth = 1.75;
  context.setLineDash(open ? [] : [7, 3, 1.5, 3]);
  context.stroke();
  if (open && isArea) {
    context.beginPath();
    line(context, project, [last, first]);
    context.lineWidth = 1;
    context.setLineDash([2, 5]);
    context.stroke();
  }
  context.setLineDash([]);
}

/** A place that is only shown: a small disc with its label beside it. */
function drawMark(context: Context, project: GeoProjection, mark: MapMark): void {
  const at = project([mark.longitude, mark.latitude]);
  if (!at) return;
  const colour = token(mark.kind === 'warning' ? 'warning' : 'ink-2');
  context.beginPath();
  context.arc(at[0], at[1], mark.kind === 'warning' ? 5 : 3.5, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
  context.font = `600 11px ${getComputedStyle(document.body).fontFamily}`;
  context.textAlign = 'left';
  haloed(context, mark.label, at[0] + 8, at[1] + 4);
}

function line(context: Context, project: GeoProjection, places: readonly Place[]): void {
  geoPath(project, context)(lineOf(places));
}

function lineOf(places: readonly Place[]): GeoJSON.LineString {
  return { type: 'LineString', coordinates: places.map((place) => [place.longitude, place.latitude]) };
}

function drawCircle(context: Context, project: GeoProjection, view: MapView, circle: Scene['circles'][number]): void {
  const at = project([circle.longitude, circle.latitude]);
  const radius = circle.radius_m * pixelsPerMetre(view, circle.latitude);
  if (!at || radius < 3 || radius > 20000) return;
  context.beginPath();
  context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
  const colour = token(circle.kind === 'waypoint' ? 'ink-3' : 'hull');
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = 1;
  context.globalAlpha = circle.kind === 'waypoint' ? 0.06 : 0.16;
  context.fill();
  context.globalAlpha = 0.8;
  if (circle.kind === 'waypoint') context.setLineDash([3, 3]);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/** Colour, width and dashes of each kind of track. */
const TRACKS: Record<MapTrack['kind'], [string, number, number[]]> = {
  flown: ['track', 2, []],
  planned: ['ink-3', 1.25, [6, 4]],
  predicted: ['series-2', 2, [2, 3]],
  aboard: ['series-3', 1.5, [10, 4]],
};

function drawTrack(context: Context, project: GeoProjection, track: MapTrack): void {
  const { places } = track;
  const [colour, width, dash] = TRACKS[track.kind];
  context.strokeStyle = token(track.colour ?? colour);
  if (places.length > 1) {
    for (const [stretch, isFixed] of stretches(places)) {
      context.beginPath();
      line(context, project, stretch);
      context.lineWidth = isFixed === undefined ? width : isFixed ? 3 : 1.5;
      context.setLineDash(dashes(isFixed === false ? [5, 3] : dash, project, stretch));
      context.stroke();
    }
    context.setLineDash([]);
  }
  drawFixes(context, project, places);
}

/** More in one line take a browser seconds to draw. So many within a map lie upon each other. */
const MOST_DASHES = 2000;

/** The dashes of a line, or none where what is seen of it would have too many: it is drawn through then. */
function dashes(wanted: number[], project: GeoProjection, places: Places): number[] {
  if (wanted.length === 0) return wanted;
  const period = wanted.reduce((sum, length) => sum + length, 0);
  return geoPath(project).measure(lineOf(places)) > MOST_DASHES * period ? [] : wanted; // clipped, as it is drawn
}

type Places = MapTrack['places'];

/** The track where it was seen by GPS from one position to the next, and where it was not; undefined: that is not told. */
function stretches(places: Places): [Places, boolean | undefined][] {
  const found: [Place[], boolean | undefined][] = [];
  for (let i = 1; i < places.length; i += 1) {
    const [from, to] = [places[i - 1], places[i]];
    if (!from || !to) continue;
    const isFixed = isTold(from) && isTold(to) ? from.source === 'gps' && to.source === 'gps' : undefined;
    const last = found.at(-1);
    if (last && last[1] === isFixed) last[0].push(to);
    else found.push([[from, to], isFixed]);
  }
  return found;
}

/** A dot at each fix; those that would cover each other are left out. */
function drawFixes(context: Context, project: GeoProjection, places: Places): void {
  let last: [number, number] | undefined;
  context.fillStyle = context.strokeStyle;
  for (const place of places) {
    const at = isTold(place) && place.source === 'gps' ? project([place.longitude, place.latitude]) : null;
    if (!at || (last && Math.hypot(at[0] - last[0], at[1] - last[1]) < 8)) continue;
    last = at;
    context.beginPath();
    context.arc(at[0], at[1], 2.5, 0, 2 * Math.PI);
    context.fill();
  }
}

/** The newest last; earlier ones that would cover each other are left out. */
function drawArrows(context: Context, project: GeoProjection, arrows: readonly MapArrow[]): void {
  const taken: [number, number][] = [];
  for (const arrow of [...arrows].reverse()) {
    const at = project([arrow.longitude, arrow.latitude]);
    if (!at || taken.some((other) => Math.hypot(at[0] - other[0], at[1] - other[1]) < 24)) continue;
    taken.push(at);
    drawArrow(context, project, arrow);
  }
}

function drawArrow(context: Context, project: GeoProjection, arrow: MapArrow): void {
  const at = project([arrow.longitude, arrow.latitude]);
  const speed = Math.hypot(arrow.north_m_s, arrow.east_m_s);
  if (!at || speed < 0.005 || !Number.isFinite(speed)) return;
  const length = Math.min(speed * ARROW_PX, 160);
  context.globalAlpha = arrow.strong === false ? 0.45 : 1;
  stroked(context, at, [arrow.east_m_s / speed, -arrow.north_m_s / speed], length);
  context.globalAlpha = 1;
}

function stroked(context: Context, at: [number, number], way: [number, number], length: number): void {
  const [x, y] = [at[0] + way[0] * length, at[1] + way[1] * length];
  const head = Math.min(7, length / 2);
  const side = (turn: number): [number, number] => [
    x - head * (way[0] * Math.cos(turn) - way[1] * Math.sin(turn)),
    y - head * (way[0] * Math.sin(turn) + way[1] * Math.cos(turn)),
  ];
  context.beginPath();
  context.moveTo(...at);
  context.lineTo(x, y);
  context.moveTo(...side(0.45));
  context.lineTo(x, y);
  context.lineTo(...side(-0.45));
  context.strokeStyle = token('current');
  context.lineWidth = 1.75;
  context.stroke();
}
