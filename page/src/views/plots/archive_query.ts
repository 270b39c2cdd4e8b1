// Asks the archive for the window that is shown, and for that only.
//
// A new window asks again after a short rest; what is still under way for an older one is cancelled, and an answer that
// comes nevertheless is thrown away: points of two windows never stand in one plot (nasa/openmct#4777, #6831).

import type { Interval } from './window';

export interface Question extends Interval {
  readonly source: string;
  readonly channels: readonly string[];
  readonly points: number;
}

export interface Answer<T> {
  readonly question: Question;
  readonly result: T;
}

export type Ask<T> = (question: Question, signal: AbortSignal) => Promise<T>;

const REST_MS = 70;
const GREATEST_REST_MS = 250;

export class ArchiveQuery<T> {
  #under_way: AbortController | null = null;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #waiting_since: number | null = null;
  #number = 0;

  constructor(
    readonly ask: Ask<T>,
    readonly onAnswer: (answer: Answer<T>) => void,
    readonly onFailure: (reason: unknown, question: Question) => void,
    readonly onBusy: (is_busy: boolean) => void = () => undefined,
  ) {}

  /** Asks soon; a question that follows within the rest takes the place of this one. */
  soon(question: Question): void {
    const now = performance.now();
    this.#waiting_since ??= now;
    const rest = Math.max(0, Math.min(REST_MS, this.#waiting_since + GREATEST_REST_MS - now));
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.now(question), rest);
  }

  /** Asks at once. */
  async now(question: Question): Promise<void> {
    this.cancel();
    if (question.channels.length === 0) return;
    const controller = new AbortController();
    this.#under_way = controller;
    const number = (this.#number += 1);
    this.onBusy(true);
    try {
      const result = await this.ask(question, controller.signal);
      if (number === this.#number) this.onAnswer({ question, result });
    } catch (reason) {
      if (number === this.#number && !controller.signal.aborted) this.onFailure(reason, question);
    } finally {
      if (number === this.#number) {
        this.#under_way = null;
        this.onBusy(false);
      }
    }
  }

  /** Forgets what waits and what is under way. */
  cancel(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    this.#waiting_since = null;
    this.#number += 1;
    this.#under_way?.abort();
    if (this.#under_way) this.onBusy(false);
    this.#under_way = null;
  }
}
