// One plot: options and hooks of uPlot, its colours from the style of the page.

import uPlot from 'uplot';

import { token } from '../../lib/theme.svelte';
import { tickWords } from '../../lib/times';
import { BESIDE_S, readAround, type Around } from '../../lib/turns';
import type { Interval } from './window';

export interface Ink {
  readonly text: string;
  readonly grid: string;
  readonly traces: readonly string[];
  readonly warning: string;
  readonly font: string;
}

export interface Limit {
  readonly low: number | null;
  readonly high: number | null;
}

export interface ChartSettings {
  readonly width: number;
  readonly height: number;
  readonly traces: number;
  readonly isDepth: boolean;
  readonly syncKey: string;
  readonly stepped: readonly boolean[];
  /** What is asked for, not what is: a dashed line. */
  readonly dashed: readonly boolean[];
  /** What the values mean, where they stand for words. */
  readonly words: ReadonlyMap<number, string> | null;
  ink(): Ink;
  limits(): readonly Limit[];
  /** Of values that go around: labels are of their turn. */
  readonly around: Around | null;
  shown(): Interval;
  onSelect(begin: number, end: number): void;
  /** Where the cursor is, and whether the pointer has moved it there: a window that moves does so too. */
  onCursor(t: number | null, isMoved: boolean): void;
  onDoubleClick(): void;
}

const AXIS_WIDTH = 58;
const AXIS_HEIGHT = 26;
const HEADROOM = 0.06;
const LIMIT_SHADE = 0.09;
const WIDTH = 1.5;
/** Half of what is left free where a line goes around. */
const CUT_WIDTH = 1.25;
/** Between leaving at one edge and coming in at the other: real gaps last longer. */
const LONGEST_CUT_S = 3 * BESIDE_S;
const DEGREES = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180];
/** That a trace goes up and down, in heights of its plot. */
const MANY_HEIGHTS = 20;

/** The colours of the page as they are now. */
export function readInk(element: HTMLElement): Ink {
  return {
    text: token('ink-2'),
    grid: token('grid'),
    traces: [1, 2, 3, 4, 5, 6, 7, 8].map((number) => token(`series-${number}`)),
    warning: token('warning'),
    font: `11px ${getComputedStyle(element).fontFamily}`,
  };
}

/** A range with headroom that takes a limit in when it is near enough to matter. */
export function valueRange(low: number | null, high: number | null, limits: readonly Limit[], isDepth: boolean): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return isDepth ? [0, 10] : [0, 1];
  const span = high - low || Math.max(Math.abs(high) * 0.02, 1e-6);
  let bottom = low;
  let top = high;
  for (const limit of limits) {
    if (limit.low !== null && limit.low < low && low - limit.low < span / 2) bottom = Math.min(bottom, limit.low);
    if (limit.high !== null && limit.high > high && limit.high - high < span / 2) top = Math.max(top, limit.high);
  }
  const room = (top - bottom || span) * HEADROOM;
  if (isDepth && bottom >= -0.5) return [Math.min(0, bottom), Math.max(top + room, 2)];
  return [bottom - room, top + room];
}

/** Whole numbers that stand for words, with half a step around them. */
function namedRange(low: number | null, high: number | null): [number, number] {
  return [Math.floor(low ?? 0) - 0.3, Math.ceil(high ?? 1) + 0.3];
}

export function chart(settings: ChartSettings, data: uPlot.AlignedData, place: HTMLElement): uPlot {
  return new uPlot(options(settings), data, place);
}

function options(settings: ChartSettings): uPlot.Options {
  return {
    width: settings.width,
    height: settings.height,
    padding: [8, 10, 0, 0],
    legend: { show: false },
    tzDate: (t) => uPlot.tzDate(new Date(t * 1000), 'UTC'),
    cursor: {
      y: false,
      drag: { x: true, y: false, setScale: false, dist: 4 },
      sync: {
        key: settings.syncKey,
        setSeries: false,
        scales: ['x', null],
        filters: { pub: (type) => type === 'mousemove' || type === 'mouseleave' },
      },
      points: { size: 7, width: 1.5 },
      bind: { dblclick: () => () => { settings.onDoubleClick(); return null; } },
    },
    select: { show: true, left: 0, top: 0, width: 0, height: 0 },
    scales: {
      x: { time: true, range: () => { const { begin, end } = settings.shown(); return [begin, end]; } },
      y: {
        dir: settings.isDepth ? -1 : 1,
        range: (_plot, low, high) => (settings.words ? namedRange(low, high) : valueRange(low, high, settings.limits(), settings.isDepth)),
      },
    },
    series: [{}, ...Array.from({ length: settings.traces }, (_, index) => series(settings, index))],
    axes: [timeAxis(settings), valueAxis(settings)],
    hooks: {
      drawClear: [setWidths, (plot) => drawLimits(plot, settings)],
      setSelect: [(plot) => takeSelection(plot, settings)],
      setCursor: [cursorTaker(settings)],
    },
  };
}

function series(settings: ChartSettings, index: number): uPlot.Series {
  const paths = settings.stepped[index] ? uPlot.paths.stepped?.({ align: 1 }) : undefined;
  return {
    stroke: () => settings.ink().traces[index % 8] ?? 'gray',
    width: WIDTH,
    spanGaps: false,
    gaps: withCuts,
    ...(settings.dashed[index] ? { dash: [6, 4] } : {}),
    points: { show: (_plot, _series, first, last) => last - first < 40, size: 4 },
    ...(paths ? { paths } : {}),
  };
}

/**
 * A gap that is narrower than a column of pixels is drawn as a line from one edge to the other, and so would be the place
 * where a heading passes north: there a column and a half are left free.
 */
function withCuts(plot: uPlot, index: number, first: number, last: number, gaps: uPlot.Series.Gaps): uPlot.Series.Gaps {
  const times = plot.data[0];
  const values = plot.data[index] ?? [];
  const half = CUT_WIDTH * uPlot.pxRatio;
  const cuts: uPlot.Series.Gaps = [];
  for (let place = Math.max(1, first); place < last; place += 1) {
    if (values[place] !== null || times[place + 1]! - times[place - 1]! > LONGEST_CUT_S) continue;
    const x = plot.valToPos(times[place]!, 'x', true);
    cuts.push([x - half, x + half]);
  }
  return cuts.length ? [...gaps, ...cuts].sort((a, b) => a[0] - b[0]) : gaps;
}

function timeAxis(settings: ChartSettings): uPlot.Axis {
  return {
    ...line(settings),
    size: AXIS_HEIGHT,
    space: 74,
    values: (_plot, ticks, _axis, _space, increment) => tickWords(ticks, increment),
  };
}

function valueAxis(settings: ChartSettings): uPlot.Axis {
  const { words, around } = settings;
  const said = (ticks: number[]): string[] => (words ? ticks.map((tick) => words.get(tick) ?? '') : numbers(ticks, around));
  return {
    ...line(settings),
    size: AXIS_WIDTH,
    space: 30,
    values: (_plot, ticks) => said(ticks),
    ...(words ? { incrs: [1, 2, 5, 10] } : around ? { incrs: DEGREES } : {}),
  };
}

function numbers(ticks: (number | null)[], around: Around | null): string[] {
  const [first, second] = ticks;
  const step = typeof first === 'number' && typeof second === 'number' ? Math.abs(second - first) : 1;
  const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  const read = (tick: number): number => (around ? readAround(tick, around, digits) : tick);
  return ticks.map((tick) => (tick === null ? '' : read(tick).toFixed(digits).replace('-', '\u2212')));
}

function line(settings: ChartSettings): uPlot.Axis {
  return {
    stroke: () => settings.ink().text,
    font: settings.ink().font,
    gap: 6,
    grid: { stroke: () => settings.ink().grid, width: 1 },
    ticks: { stroke: () => settings.ink().grid, width: 1, size: 4 },
  };
}

function takeSelection(plot: uPlot, settings: ChartSettings): void {
  const { left, width } = plot.select;
  if (width < 4) return;
  const begin = plot.posToVal(left, 'x');
  const end = plot.posToVal(left + width, 'x');
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  settings.onSelect(begin, end);
}

function cursorTaker(settings: ChartSettings): (plot: uPlot) => void {
  let before: MouseEvent | null | undefined;
  return (plot) => {
    const { left, event } = plot.cursor;
    settings.onCursor(left === undefined || left < 0 ? null : plot.posToVal(left, 'x'), Boolean(event) && event !== before);
    before = event;
  };
}

/** The line at a time, or none, on this plot alone. */
export function showCursor(plot: uPlot, t: number | null, { begin, end }: Interval): void {
  const isShown = t !== null && t >= begin && t <= end;
  if (!isShown && (plot.cursor.left ?? -1) < 0) return;
  const left = isShown ? ((t - begin) / (end - begin)) * plot.over.clientWidth : -10;
  plot.setCursor({ left, top: isShown ? 0 : -10 }, false);
}

/**
 * A trace that goes up and down many times is drawn in hairlines, which are quick: a window that moves is drawn anew in
 * each frame.
 */
function setWidths(plot: uPlot): void {
  const { min, max } = plot.scales['y'] ?? {};
  const height = Math.abs((max ?? 1) - (min ?? 0)) || 1;
  plot.series.slice(1).forEach((one, index) => {
    const [first, last] = plot.series[0]?.idxs ?? [0, 0];
    const far = travel(plot.data[index + 1] ?? [], first, last) / height;
    one.width = far > MANY_HEIGHTS ? 1 / uPlot.pxRatio : WIDTH;
  });
}

/** How far a trace goes up and down between two places. */
function travel(values: ArrayLike<number | null | undefined>, first: number, last: number): number {
  let far = 0;
  let before: number | undefined;
  for (let place = first; place <= last; place += 1) {
    const value = values[place];
    if (typeof value !== 'number') continue;
    if (before !== undefined) far += Math.abs(value - before);
    before = value;
  }
  return far;
}

/** What lies beyond a limit is shaded, the limit itself is a line. */
function drawLimits(plot: uPlot, settings: ChartSettings): void {
  const limits = settings.limits();
  if (limits.length === 0 || typeof plot.scales['y']?.min !== 'number') return;
  const { left, top, width, height } = plot.bbox;
  const context = plot.ctx;
  const ink = settings.ink();
  const inside = (y: number): number => Math.min(Math.max(y, top), top + height);
  context.save();
  context.fillStyle = ink.warning;
  context.strokeStyle = ink.warning;
  context.lineWidth = uPlot.pxRatio;
  context.setLineDash([4 * uPlot.pxRatio, 3 * uPlot.pxRatio]);
  for (const limit of limits) {
    for (const [value, isHigh] of [[limit.low, false], [limit.high, true]] as const) {
      if (value === null) continue;
      const y = plot.valToPos(value, 'y', true);
      const isTowardsTop = isHigh !== settings.isDepth;
      const edge = inside(y);
      const far = isTowardsTop ? top : top + height;
      context.globalAlpha = LIMIT_SHADE;
      context.fillRect(left, Math.min(edge, far), width, Math.abs(far - edge));
      context.globalAlpha = 1;
      if (y < top || y > top + height) continue;
      context.beginPath();
      context.moveTo(left, y);
      context.lineTo(left + width, y);
      context.stroke();
    }
  }
  context.restore();
}
