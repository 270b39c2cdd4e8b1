// What all plots of a view share: window, traces, cursor, and the way back.

import { Cursor } from '../../lib/cursor.svelte';
import { ArchiveQuery, type Question } from './archive_query';
import type { LiveListener, PlotSource, Samples } from './source';
import { extended, gapAfter, type Trace, type Traces } from './traces';
import { fixed, interval, isSame, live, panned, spanOf, type Interval, type TimeWindow, zoomed } from './window';

const TICK_MS = 100;
const ASK_AGAIN_MS = 30_000;
/** After so long a new subscription is heard for certain. */
const SETTLED_MS = 1500;
const WAYS_BACK = 50;
const PENDING_LIMIT = 20_000;
/** Where the cursor stands after the window has gone on beneath it, as a share of the width from where it came. */
const GONE_ON = 0.25;

export class Desk {
  window = $state.raw<TimeWindow>(live(3600));
  shown = $state.raw<Interval>({ begin: 0, end: 1 });
  traces = $state.raw<Traces>(new Map());
  isBusy = $state(false);
  failure = $state<string | null>(null);
  /** The question whose answer is drawn. */
  answered = $state.raw<Question | null>(null);
  /** Of all panels: a time. */
  readonly cursor = new Cursor<number>();

  #channels: readonly string[] = [];
  #points = 2000;
  #query: ArchiveQuery<Traces>;
  #unfollow: (() => void) | null = null;
  #pending: ReadonlyMap<string, Samples>[] = [];
  #pendingCount = 0;
  #isWhole = false;
  #isFirst = false;
  #settles: number | null = null;
  #asked = 0;
  #timer: ReturnType<typeof setInterval>;
  #back = $state.raw<readonly TimeWindow[]>([]);

  constructor(readonly source: PlotSource, window: TimeWindow) {
    this.#query = new ArchiveQuery<Traces>(
      (question, signal) => source.series(question.channels, question.begin, question.end, question.points, signal),
      ({ question, result }) => this.#take(question, result),
      (reason) => this.#fail(reason),
      (is_busy) => { this.isBusy = is_busy; },
    );
    this.window = window;
    this.shown = interval(window, source.now());
    this.#timer = setInterval(() => this.#tick(), TICK_MS);
  }

  /** Which channels are drawn, and with how many points each. */
  choose(channels: readonly string[], points: number): void {
    const isNew = channels.join() !== this.#channels.join();
    if (!isNew && Math.abs(points - this.#points) < 0.2 * this.#points) return;
    this.#channels = channels;
    this.#points = points;
    if (isNew) {
      this.#drop();
      this.#follow();
    }
    this.#ask();
  }

  show(window: TimeWindow, isStep = true): void {
    if (isSame(window, this.window)) return;
    if (isStep) this.#back = [...this.#back.slice(1 - WAYS_BACK), this.window];
    const isSwitch = window.kind !== this.window.kind;
    this.window = window;
    this.shown = interval(window, this.source.now());
    this.#drop();
    if (isSwitch) this.#follow();
    this.#query.soon(this.#question());
    this.#asked = performance.now();
  }

  pan(share: number): void {
    this.show(panned(this.window, share, this.source.now()), this.window.kind === 'live');
  }

  zoom(factor: number, shareOfWidth?: number): void {
    const { begin, end } = this.shown;
    // The right edge of a window that follows is the present: zooming there goes on to follow.
    const isAtPresent = this.window.kind === 'live' && (shareOfWidth === undefined || shareOfWidth > 0.9);
    const about = isAtPresent ? undefined : begin + (shareOfWidth ?? 0.5) * (end - begin);
    this.show(zoomed(this.window, factor, this.source.now(), about), this.window.kind === 'live');
  }

  /** Goes on beneath a time that has come to an edge: earlier (-1), or later (1) unless it follows. */
  goOn(t: number, by: 1 | -1): void {
    if (by > 0 && this.window.kind === 'live') return;
    const { begin, end } = this.shown;
    const share = (t - begin) / (end - begin) - (by > 0 ? GONE_ON : 1 - GONE_ON);
    if (share * by > 0.01) this.pan(share);
  }

  select(begin: number, end: number): void {
    this.show(fixed(begin, end));
  }

  get hasBack(): boolean {
    return this.#back.length > 0;
  }

  follow(span_s: number = Math.min(spanOf(this.window), 30 * 86400)): void {
    this.show(live(span_s));
  }

  hold(): void {
    const { begin, end } = this.shown;
    this.show(fixed(begin, end));
  }

  back(): void {
    const before = this.#back.at(-1);
    if (!before) return;
    this.#back = this.#back.slice(0, -1);
    this.show(before, false);
  }

  /** Begins anew at the present of the source, for instance since a replay has jumped. */
  restart(): void {
    this.#drop();
    this.traces = new Map();
    this.shown = interval(this.window, this.source.now());
    this.#ask();
  }

  /** Ends everything: nothing is asked, heard or drawn any more. */
  close(): void {
    clearInterval(this.#timer);
    this.#query.cancel();
    this.#unfollow?.();
    this.#unfollow = null;
    this.#drop();
  }

  #question(): Question {
    const { begin } = this.shown;
    const end = this.shown.end + (this.window.kind === 'live' ? this.source.ahead_s() : 0);
    return { source: this.source.key, channels: this.#channels, begin, end, points: this.#points };
  }

  /** Until the answer is there, what comes waits: it is joined to the answer, not to what the answer replaces. */
  #ask(): void {
    this.#isWhole = false;
    this.#asked = performance.now();
    void this.#query.now(this.#question());
  }

  #fail(reason: unknown): void {
    this.failure = reason instanceof Error ? reason.message : String(reason);
    this.#isWhole = this.answered !== null && this.answered.channels === this.#channels;
  }

  #drop(): void {
    this.#pending = [];
    this.#pendingCount = 0;
    this.#isWhole = false;
  }

  #take(question: Question, answer: Traces): void {
    this.failure = null;
    this.answered = question;
    this.traces = answer;
    this.#isWhole = true;
    if (this.window.kind === 'live') this.#join();
  }

  #follow(): void {
    this.#unfollow?.();
    this.#unfollow = null;
    if (this.window.kind !== 'live' || this.#channels.length === 0) return;
    const listener: LiveListener = {
      onSamples: (samples) => this.#hear(samples),
      onGap: () => {
        this.#begins();
        this.#ask();
      },
      onRefusal: (reason) => { this.failure = reason; },
    };
    this.#begins();
    this.#unfollow = this.source.follow(this.#channels, listener);
  }

  /** What comes between a question and the begin of a subscription is asked for after it has begun. */
  #begins(): void {
    this.#isFirst = true;
    this.#settles = performance.now() + SETTLED_MS;
  }

  #hear(samples: ReadonlyMap<string, Samples>): void {
    for (const part of samples.values()) this.#pendingCount += part.t.length;
    this.#pending.push(samples);
    if (this.#isFirst) this.#ask();
    this.#isFirst = false;
    if (this.#pendingCount <= PENDING_LIMIT) return;
    this.#drop();
    this.#ask();
  }

  #join(): void {
    if (this.#pending.length === 0 || !this.#isWhole) return;
    const traces = new Map<string, Trace>(this.traces);
    for (const samples of this.#pending) {
      for (const [key, part] of samples) {
        const gap_s = gapAfter(this.source.period_s(key));
        traces.set(key, extended(traces.get(key), part.t, part.value, this.shown.begin, gap_s));
      }
    }
    this.#pending = [];
    this.#pendingCount = 0;
    this.traces = traces;
  }

  #tick(): void {
    if (this.window.kind !== 'live') return;
    const next = interval(this.window, this.source.now());
    // While a replay is paused the window stands still, and what was under way still comes.
    if (next.end !== this.shown.end) this.shown = next;
    this.#join();
    const now = performance.now();
    const isSettled = this.#settles !== null && now > this.#settles;
    if (isSettled) this.#settles = null;
    // Points pile up: from time to time the archive reduces them again.
    if (isSettled || now - this.#asked > ASK_AGAIN_MS) this.#ask();
  }
}
