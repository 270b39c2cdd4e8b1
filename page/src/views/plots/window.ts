// The stretch of time that all plots show together: either one that follows the vehicle or one that stands still.

export interface LiveWindow {
  readonly kind: 'live';
  readonly span_s: number;
}

export interface FixedWindow {
  readonly kind: 'fixed';
  readonly begin: number;
  readonly end: number;
}

export type TimeWindow = LiveWindow | FixedWindow;

export interface Interval {
  readonly begin: number;
  readonly end: number;
}

export const LEAST_SPAN_S = 1;
export const GREATEST_SPAN_S = 20 * 366 * 86400;
const EARLIEST = 0;
const LATEST = 4102444800; // 2100-01-01

export const SPANS: readonly { readonly words: string; readonly span_s: number }[] = [
  { words: '10 min', span_s: 600 },
  { words: '1 h', span_s: 3600 },
  { words: '6 h', span_s: 6 * 3600 },
  { words: '1 d', span_s: 86400 },
  { words: '7 d', span_s: 7 * 86400 },
  { words: '30 d', span_s: 30 * 86400 },
];

/** A live window of a span within the limits. */
export function live(span_s: number): LiveWindow {
  return { kind: 'live', span_s: Math.min(Math.max(span_s, LEAST_SPAN_S), GREATEST_SPAN_S) };
}

/** A window that stands still, made valid: ordered, neither shorter nor longer than the limits, on the calendar. */
export function fixed(begin: number, end: number): FixedWindow {
  if (!Number.isFinite(begin) || !Number.isFinite(end)) throw new RangeError('A window needs two times.');
  const low = Math.min(begin, end);
  const high = Math.max(begin, end);
  const span = Math.min(Math.max(high - low, LEAST_SPAN_S), GREATEST_SPAN_S);
  const middle = (low + high) / 2;
  const first = Math.min(Math.max(middle - span / 2, EARLIEST), LATEST - span);
  return { kind: 'fixed', begin: first, end: first + span };
}

/** The times that a window shows at the vehicle's present. */
export function interval(window: TimeWindow, now: number): Interval {
  if (window.kind === 'live') return { begin: now - window.span_s, end: now };
  return { begin: window.begin, end: window.end };
}

export function spanOf(window: TimeWindow): number {
  return window.kind === 'live' ? window.span_s : window.end - window.begin;
}

/** Moved by a share of its span; a live window stops to follow. */
export function panned(window: TimeWindow, share: number, now: number): FixedWindow {
  const { begin, end } = interval(window, now);
  const step = share * (end - begin);
  return fixed(begin + step, end + step);
}

/** Zoomed by a factor (below 1: closer) about a time; a live window goes on to follow unless a time is named. */
export function zoomed(window: TimeWindow, factor: number, now: number, about?: number): TimeWindow {
  if (window.kind === 'live' && about === undefined) return live(window.span_s * factor);
  const { begin, end } = interval(window, now);
  const centre = about ?? (begin + end) / 2;
  const span = Math.min(Math.max((end - begin) * factor, LEAST_SPAN_S), GREATEST_SPAN_S);
  const share = end > begin ? (centre - begin) / (end - begin) : 0.5;
  return fixed(centre - share * span, centre + (1 - share) * span);
}

export function isSame(a: TimeWindow, b: TimeWindow): boolean {
  if (a.kind === 'live') return b.kind === 'live' && a.span_s === b.span_s;
  return b.kind === 'fixed' && a.begin === b.begin && a.end === b.end;
}

/** As it stands in the address of a view, so that a window can be sent to somebody. */
export function toWords(window: TimeWindow): string {
  if (window.kind === 'live') return `live-${Math.round(window.span_s)}`;
  return `${window.begin.toFixed(3)}-${window.end.toFixed(3)}`;
}

/** The opposite of toWords; null for words that are none. */
export function fromWords(words: string): TimeWindow | null {
  const followed = /^live-(\d{1,10})$/.exec(words);
  if (followed) return live(Number(followed[1]));
  const still = /^(\d{1,11}(?:\.\d{1,6})?)-(\d{1,11}(?:\.\d{1,6})?)$/.exec(words);
  return still ? fixed(Number(still[1]), Number(still[2])) : null;
}
