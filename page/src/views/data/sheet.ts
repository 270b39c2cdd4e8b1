// A sheet of chart paper on a canvas: axes, ticks, and the way from values to pixels.

import { ticks as niceTicks } from 'd3-array';

import { token } from '../../lib/theme.svelte';
import { tickWords } from '../../lib/times';

export interface Axis {
  readonly low: number;
  readonly high: number;
  readonly label: string;
  /** UTC seconds instead of a number. */
  readonly isTime?: boolean;
  /** Grows to the left or downwards, as depth does. */
  readonly isReversed?: boolean;
}

export interface SheetInk {
  readonly text: string;
  readonly faint: string;
  readonly grid: string;
  readonly ground: string;
  readonly font: string;
}

export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** What one draws with: the context in CSS pixels, the paper, and the places of values on it. */
export interface Pen {
  readonly context: CanvasRenderingContext2D;
  readonly box: Box;
  readonly ink: SheetInk;
  x(value: number): number;
  y(value: number): number;
}

const MARGIN = { left: 54, top: 10, right: 14, bottom: 40 };
const TIME_STEPS = [
  1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 10800, 21600, 43200, 86400, 172800, 432000, 864000,
  1728000, 2592000, 5184000, 7776000, 15552000, 31536000,
];

export function readSheetInk(element: HTMLElement): SheetInk {
  return {
    text: token('ink-2'),
    faint: token('ink-3'),
    grid: token('grid'),
    ground: token('panel'),
    font: `11px ${getComputedStyle(element).fontFamily}`,
  };
}

export function boxOf(width: number, height: number): Box {
  return {
    left: MARGIN.left,
    top: MARGIN.top,
    width: Math.max(10, width - MARGIN.left - MARGIN.right),
    height: Math.max(10, height - MARGIN.top - MARGIN.bottom),
  };
}

/** The place of a value between the ends of an axis, 0 to 1 from left or from the top. */
function share(axis: Axis, value: number, isVertical: boolean): number {
  const part = (value - axis.low) / (axis.high - axis.low || 1);
  return Boolean(axis.isReversed) === isVertical ? part : 1 - part;
}

/** The value at a place between the ends of an axis. */
export function valueAt(axis: Axis, place: number, isVertical: boolean): number {
  const part = Boolean(axis.isReversed) === isVertical ? place : 1 - place;
  return axis.low + part * (axis.high - axis.low);
}

/** Where values lie on the paper, px. */
export function placing(box: Box, x: Axis, y: Axis): Pick<Pen, 'x' | 'y'> {
  return {
    x: (value) => box.left + share(x, value, false) * box.width,
    y: (value) => box.top + share(y, value, true) * box.height,
  };
}

export function pen(context: CanvasRenderingContext2D, box: Box, x: Axis, y: Axis, ink: SheetInk): Pen {
  return { context, box, ink, ...placing(box, x, y) };
}

export interface Tick {
  readonly value: number;
  readonly words: string;
}

/** Round values along an axis, as many as there is room for. */
export function ticksOf(axis: Axis, pixels: number, pixelsEach: number): Tick[] {
  const count = Math.max(2, Math.floor(pixels / pixelsEach));
  if (axis.isTime) return timeTicks(axis, count);
  const values = niceTicks(axis.low, axis.high, count);
  const [first = 0, second = first + 1] = values;
  const step = Math.abs(second - first);
  const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  return values.map((value) => ({ value, words: value.toFixed(digits).replace('-', '\u2212') }));
}

function timeTicks(axis: Axis, count: number): Tick[] {
  const rough = (axis.high - axis.low) / count;
  const step = TIME_STEPS.find((size) => size >= rough) ?? 31536000;
  const first = Math.ceil(axis.low / step);
  const last = Math.floor(axis.high / step);
  const values = Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => (first + index) * step);
  const words = tickWords(values, step);
  return values.map((value, index) => ({ value, words: words[index] ?? '' }));
}

/** Grid, ticks and labels; what is drawn on the paper comes between `ground` and `frame`. */
export function ground(it: Pen, x: Axis, y: Axis): void {
  const { context, box, ink } = it;
  context.strokeStyle = ink.grid;
  context.fillStyle = ink.text;
  context.font = ink.font;
  context.lineWidth = 1;
  context.textAlign = 'center';
  context.textBaseline = 'top';
  for (const tick of ticksOf(x, box.width, x.isTime ? 80 : 72)) {
    const place = Math.round(it.x(tick.value)) + 0.5;
    line(context, place, box.top, place, box.top + box.height + 4);
    context.fillText(tick.words, place, box.top + box.height + 7);
  }
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const tick of ticksOf(y, box.height, 44)) {
    const place = Math.round(it.y(tick.value)) + 0.5;
    line(context, box.left - 4, place, box.left + box.width, place);
    context.fillText(tick.words, box.left - 7, place);
  }
  labels(it, x, y);
}

function labels({ context, box, ink }: Pen, x: Axis, y: Axis): void {
  context.fillStyle = ink.faint;
  context.textAlign = 'center';
  context.textBaseline = 'bottom';
  if (x.label) context.fillText(x.label, box.left + box.width / 2, box.top + box.height + MARGIN.bottom - 3);
  context.save();
  context.translate(11, box.top + box.height / 2);
  context.rotate(-Math.PI / 2);
  context.textBaseline = 'middle';
  context.fillText(y.label, 0, 0);
  context.restore();
}

export function frame({ context, box, ink }: Pen): void {
  context.strokeStyle = ink.faint;
  context.globalAlpha = 0.5;
  context.strokeRect(box.left + 0.5, box.top + 0.5, box.width, box.height);
  context.globalAlpha = 1;
}

export function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

/** Least and greatest of values with a little room around them; what is not a number does not count. */
export function extent(values: Iterable<number | null>, room = 0.04): [number, number] | null {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value === null || !Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return null;
  const margin = (high - low) * room || Math.max(Math.abs(high) * 0.01, 0.01);
  return [low - margin, high + margin];
}
