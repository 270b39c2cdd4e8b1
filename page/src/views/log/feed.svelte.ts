// The log book of a vehicle, the newest first, page by page; what happens meanwhile comes in at the top, in a replay what
// had happened by then.

import { api, sentence } from '../../lib/api';
import { live } from '../../lib/live.svelte';
import type { EventKind, LogEntry, LogPage } from '../../lib/types';

export type { LogEntry };

const PAGE = 100;
const REST_MS = 250;
const KINDS: readonly EventKind[] = ['note', 'dive', 'command', 'mission', 'alarm', 'parameter', 'holder', 'limit', 'text', 'log'];
const NOTICE = 5;

export class Feed {
  entries = $state.raw<readonly LogEntry[]>();
  next = $state<string | null>(null);
  failure = $state<string>();
  /** Whether older entries are asked for. */
  isBusy = $state(false);
  #kinds: readonly string[] = [];
  #search = '';
  #number = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #ends: (() => void)[];

  constructor(
    readonly vehicle: number,
    /** Of a replay: until when [s since 1970]. */
    private until?: number,
  ) {
    if (until !== undefined) {
      this.#ends = [];
      return;
    }
    const again = (): void => this.#again();
    this.#ends = KINDS.map((kind) => live.on(kind, (event) => (event.vehicle ?? vehicle) === vehicle && again()));
    this.#ends.push(live.onOpen(again));
    const states = new Map<number, string>();
    const transfer = live.on('transfer', ({ vehicle: of, data }) => {
      // how far a transfer is stands in another view; here only what becomes of it
      if (of !== vehicle || states.get(data.id) === data.state) return;
      states.set(data.id, data.state);
      again();
    });
    this.#ends.push(transfer);
  }

  /** Shows entries of some kinds that have some words. If none is named: all kinds, but of what the vehicle said no mere information. */
  find(kinds: readonly string[], search: string): void {
    this.#kinds = kinds;
    this.#search = search.trim();
    this.#number += 1;
    this.#soon(() => void this.#begin());
  }

  /** A replay is at another time; what is shown of a later one is forgotten. */
  goTo(until: number | undefined): void {
    const before = this.until;
    if (until === undefined || before === undefined || until === before) return;
    this.until = until;
    if (until < before) {
      this.#number += 1;
      this.#soon(() => void this.#begin());
    } else this.#again();
  }

  async older(): Promise<void> {
    if (this.next === null || this.isBusy) return;
    this.isBusy = true;
    await this.#ask(this.next, (page) => {
      this.entries = [...(this.entries ?? []), ...page.entries];
      this.next = page.next;
    });
    this.isBusy = false;
  }

  close(): void {
    clearTimeout(this.#timer);
    this.#number += 1;
    this.#ends.forEach((end) => end());
  }

  /** Looks for news; what is to be looked for is not put off by it, and often is often enough. */
  #again(): void {
    if (this.#timer === undefined) this.#soon(() => void this.#refresh());
  }

  #soon(action: () => void): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#timer = undefined;
      action();
    }, this.entries === undefined ? 0 : REST_MS);
  }

  #begin(): Promise<void> {
    return this.#ask(null, (page) => {
      this.entries = page.entries;
      this.next = page.next;
    });
  }

  /** The newest page again; older ones that were read stay. */
  #refresh(): Promise<void> {
    return this.#ask(null, (page) => {
      const last = page.entries.at(-1);
      const fresh = new Set(page.entries.map(keyOf));
      const older = last === undefined ? [] : (this.entries ?? []).filter((one) => one.t <= last.t && !fresh.has(keyOf(one)));
      this.entries = [...page.entries, ...older];
      if (older.length === 0) this.next = page.next;
    });
  }

  async #ask(before: string | null, take: (page: LogPage) => void): Promise<void> {
    const number = this.#number;
    const query = new URLSearchParams(this.#kinds.map((kind) => ['kinds', kind]));
    query.set('limit', String(PAGE));
    if (!this.#kinds.includes('text')) query.set('severity', String(NOTICE));
    if (this.#search) query.set('search', this.#search);
    if (before !== null) query.set('before', before);
    if (this.until !== undefined) query.set('until', String(this.until));
    try {
      const page = await api.get<LogPage>(`/vehicles/${this.vehicle}/log?${query.toString()}`);
      if (number !== this.#number) return;
      take(page);
      this.failure = undefined;
    } catch (error) {
      if (number === this.#number) this.failure = sentence(error);
    }
  }
}

export function keyOf(entry: LogEntry): string {
  return `${entry.kind}/${entry.id}`;
}

export interface LogDay {
  readonly day: string;
  readonly entries: LogEntry[];
}

/** Entries by their days, UTC. */
export function byDay(entries: readonly LogEntry[], dayOf: (t: number) => string): LogDay[] {
  const days: LogDay[] = [];
  for (const entry of entries) {
    const day = dayOf(entry.t);
    const last = days.at(-1);
    if (last?.day === day) last.entries.push(entry);
    else days.push({ day, entries: [entry] });
  }
  return days;
}
