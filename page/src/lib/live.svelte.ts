// The live socket: comes back by itself, and takes its subscriptions with it.

import { clock, STATION } from './clock.svelte';
import type { Channel, EventKind, LiveMessage, LiveRequest, StationEvent, VehicleKey, VehicleSummary } from './types';

export type LinkState = 'connecting' | 'open' | 'lost';
export type Values = Extract<LiveMessage, { type: 'values' }>['values'];
export type Samples = Extract<LiveMessage, { type: 'samples' }>['samples'];

export interface Listener {
  values?: (values: Values, now: number) => void;
  samples?: (samples: Samples, now: number) => void;
  /** The reader was too slow, or the socket was away: what lies after `from` has to be asked for again. */
  gap?: (from: number | undefined) => void;
  error?: (reason: string) => void;
}

interface Subscription {
  id: string;
  vehicle: VehicleKey;
  channels: string[];
  every: boolean;
  listener: Listener;
  began: boolean;
}

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 8000;
const SILENCE_MS = 40000;

class Live {
  state = $state<LinkState>('connecting');
  /** performance.now() of the moment in which the socket was lost. */
  lostAt = $state<number | undefined>(undefined);
  summaries = $state.raw<Record<string, VehicleSummary>>({});
  /** Usual time between two values, s, by vehicle or replay and by channel. */
  private periods = $state.raw<Record<string, Record<string, number>>>({});
  private socket: WebSocket | undefined;
  private subscriptions = new Map<string, Subscription>();
  private handlers = new Map<string, Set<(event: StationEvent) => void>>();
  private whenOpen = new Set<() => void>();
  private count = 0;
  private wait = FIRST_WAIT_MS;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private silence: ReturnType<typeof setTimeout> | undefined;
  private wanted = false;

  start(): void {
    if (this.wanted) return;
    this.wanted = true;
    window.addEventListener('online', this.now);
    document.addEventListener('visibilitychange', this.now);
    this.open();
  }

  stop(): void {
    this.wanted = false;
    window.removeEventListener('online', this.now);
    document.removeEventListener('visibilitychange', this.now);
    clearTimeout(this.retry);
    clearTimeout(this.silence);
    this.socket?.close();
    this.socket = undefined;
  }

  /** Tries at once, for instance since the network is back or a person asks for it. */
  now = (): void => {
    if (this.state === 'open' || !this.wanted || document.hidden) return;
    this.wait = FIRST_WAIT_MS;
    clearTimeout(this.retry);
    if (this.socket?.readyState !== WebSocket.CONNECTING) this.open();
  };

  /** Latest values (or with `every` all samples) of some channels, until the function that comes back is called. */
  subscribe(vehicle: VehicleKey, channels: string[], listener: Listener, every = false): () => void {
    this.count += 1;
    const subscription = { id: `s${this.count}`, vehicle, channels, every, listener, began: false };
    this.subscriptions.set(subscription.id, subscription);
    this.ask(subscription);
    return () => {
      if (this.subscriptions.delete(subscription.id)) this.send({ type: 'unsubscribe', id: subscription.id });
    };
  }

  /** Calls back on each event of a kind. */
  on<Kind extends EventKind>(kind: Kind, handler: (event: Extract<StationEvent, { kind: Kind }>) => void): () => void {
    const set = this.handlers.get(kind) ?? new Set();
    const known = handler as (event: StationEvent) => void;
    set.add(known);
    this.handlers.set(kind, set);
    return () => set.delete(known);
  }

  /**
   * Calls back whenever the station greets, also after a loss, and when it says that events were lost: the clock is known
   * then, and lists that grow by events are to be asked for again.
   */
  onOpen(handler: () => void): () => void {
    this.whenOpen.add(handler);
    return () => this.whenOpen.delete(handler);
  }

  /** Usual time between two values of a channel, s: as they come, or as the table of channels says. */
  period_s(vehicle: VehicleKey, channel: Channel): number {
    return this.periods[vehicle]?.[channel.key] ?? channel.period_s;
  }

  /** Takes over a summary that came another way. */
  put(summary: VehicleSummary): void {
    clock.tell(summary.vehicle, summary.now, summary.speed);
    this.summaries = { ...this.summaries, [summary.vehicle]: summary };
  }

  private open(): void {
    const page = new URL('./api/live', location.href);
    page.protocol = page.protocol === 'https:' ? 'wss:' : 'ws:';
    page.hash = '';
    if (this.state !== 'lost') this.state = 'connecting';
    const socket = new WebSocket(page);
    this.socket = socket;
    socket.onopen = () => this.opened();
    socket.onmessage = (message) => this.take(message.data as string);
    socket.onclose = () => this.closed(socket);
  }

  private opened(): void {
    this.state = 'open';
    this.lostAt = undefined;
    this.wait = FIRST_WAIT_MS;
    this.listen();
    for (const subscription of this.subscriptions.values()) {
      if (subscription.began) subscription.listener.gap?.(undefined);
      this.ask(subscription);
    }
  }

  private closed(socket: WebSocket): void {
    if (socket !== this.socket) return;
    clearTimeout(this.silence);
    if (!this.wanted) return;
    if (this.state !== 'lost') this.lostAt = performance.now();
    this.state = 'lost';
    this.retry = setTimeout(() => this.open(), this.wait * (0.75 + Math.random() / 2));
    this.wait = Math.min(this.wait * 2, LONGEST_WAIT_MS);
  }

  /** A socket that is silent although the station pings each 15 s is dead, whatever the browser believes. */
  private listen(): void {
    clearTimeout(this.silence);
    const socket = this.socket;
    this.silence = setTimeout(() => {
      socket?.close();
      if (socket) this.closed(socket);
    }, SILENCE_MS);
  }

  private ask(subscription: Subscription): void {
    const { id, vehicle, channels, every } = subscription;
    subscription.began = this.send({ type: 'subscribe', id, vehicle, channels, every }) || subscription.began;
  }

  private send(message: LiveRequest): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private take(text: string): void {
    this.listen();
    const message = JSON.parse(text) as LiveMessage;
    if ('vehicle' in message && message.vehicle !== null && 'now' in message) clock.tell(message.vehicle, message.now);
    if ('periods' in message) this.learn(message.vehicle, message.periods);
    const listener = 'id' in message ? this.subscriptions.get(message.id)?.listener : undefined;
    if (message.type === 'values') listener?.values?.(message.values, message.now);
    else if (message.type === 'samples') listener?.samples?.(message.samples, message.now);
    else if (message.type === 'gap') {
      if ('from' in message) listener?.gap?.(message.from);
      else this.whenOpen.forEach((handler) => handler());
    }
    else if (message.type === 'error') this.refused(message.id, message.reason);
    else if (message.type === 'hello') this.greet(message);
    else if (message.type === 'summary') this.put(message.summary);
    else if (message.type === 'event') this.handlers.get(message.kind)?.forEach((handler) => handler(message));
  }

  private learn(vehicle: VehicleKey, periods: Record<string, number>): void {
    if (Object.keys(periods).length === 0) return;
    this.periods = { ...this.periods, [vehicle]: { ...this.periods[vehicle], ...periods } };
  }

  private refused(id: string, reason: string): void {
    const listener = this.subscriptions.get(id)?.listener;
    this.subscriptions.delete(id);
    listener?.error?.(reason);
  }

  private greet({ now, vehicles }: Extract<LiveMessage, { type: 'hello' }>): void {
    clock.tell(STATION, now, 1);
    const summaries: Record<string, VehicleSummary> = {};
    for (const summary of vehicles) {
      clock.tell(summary.vehicle, summary.now, summary.speed);
      summaries[summary.vehicle] = summary;
    }
    this.summaries = summaries;
    this.whenOpen.forEach((handler) => handler());
  }
}

export const live = new Live();

/** The latest values of some channels as reactive state; `stop` ends it. For a component: in an $effect. */
export class Watch {
  values = $state.raw<Values>({});
  reason = $state<string | undefined>(undefined);
  stop: () => void;

  constructor(vehicle: VehicleKey, channels: string[]) {
    this.stop = live.subscribe(vehicle, channels, {
      values: (values) => (this.values = { ...this.values, ...values }),
      error: (reason) => (this.reason = reason),
    });
  }
}
