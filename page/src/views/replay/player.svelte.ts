// One replay on the station: begins, pauses, jumps and ends there; its values come over the live socket.

import { api, sentence } from '../../lib/api';
import { clock } from '../../lib/clock.svelte';
import { live } from '../../lib/live.svelte';
import type { VehicleSummary } from '../../lib/types';

/** A stretch in which nothing was received. */
export interface Silence {
  readonly begin: number;
  readonly end: number;
  /** Whether nothing more was received until the end of the replay. */
  readonly is_last: boolean;
}

export interface ReplayState {
  readonly replay: string;
  readonly vehicle: number;
  readonly begin: number;
  readonly end: number;
  readonly at: number;
  readonly speed: number;
  readonly paused: boolean;
  readonly ended?: boolean;
  /** Why nothing comes; empty while all is well. */
  readonly reason?: string;
  readonly skip_silence?: boolean;
  /** In which it is now. */
  readonly silence?: Silence | null;
  /** How the vehicle was. */
  readonly summary?: VehicleSummary;
}

export interface ReplayChange {
  speed?: number;
  paused?: boolean;
  at?: number;
  skip_silence?: boolean;
}

export class Player {
  state = $state.raw<ReplayState>();
  failure = $state<string>();
  /** Rises with each jump: what was shown before is of another time. */
  jumps = $state(0);
  #ends: (() => void)[] = [];

  constructor(readonly vehicle: number) {
    this.#ends.push(
      live.on('replay', (event) => {
        const told = event.data as Partial<ReplayState>;
        if (told.replay !== undefined && told.replay === this.state?.replay) this.#take(told);
      }),
    );
  }

  /** Name of the replay on the live socket. */
  get key(): string {
    return `replay:${this.state?.replay ?? ''}`;
  }

  async begin(begin: number, end: number, speed: number): Promise<void> {
    await this.stop();
    await this.#do(async () => {
      const made = await api.post<Partial<ReplayState>>('/replays', { vehicle: this.vehicle, begin, end, speed });
      this.state = { replay: '', vehicle: this.vehicle, begin, end, at: begin, speed, paused: false };
      this.#take(made);
    });
  }

  async change(wanted: ReplayChange): Promise<void> {
    const id = this.state?.replay;
    if (id === undefined) return;
    await this.#do(async () => {
      this.#take({ ...wanted, ...(await api.put<Partial<ReplayState>>(`/replays/${id}`, wanted)) });
      if (wanted.at !== undefined) this.jumps += 1;
    });
  }

  async stop(): Promise<void> {
    const id = this.state?.replay;
    this.state = undefined;
    // One that nobody listens to ends by itself: a failure here needs nobody.
    if (id !== undefined) await api.delete(`/replays/${id}`).catch(() => undefined);
  }

  close(): void {
    this.#ends.forEach((end) => end());
    void this.stop();
  }

  #take(told: Partial<ReplayState> | null): void {
    if (!this.state || !told) return;
    const state = { ...this.state, ...told };
    this.state = state;
    clock.tell(`replay:${state.replay}`, state.at, state.paused || state.ended ? 0 : state.speed);
  }

  async #do(action: () => Promise<void>): Promise<void> {
    try {
      this.failure = undefined;
      await action();
    } catch (error) {
      this.failure = sentence(error);
    }
  }
}
