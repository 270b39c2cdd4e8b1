// Tells the last word of what somebody gave: of every abort, of one's own commands and missions.

import { api } from './api';
import { live } from './live.svelte';
import { notices } from './notices.svelte';
import { session } from './session.svelte';
import type { GivenCommand, Mission, MissionAboard } from './types';

const GOING = ['waiting', 'sending'];
const WELL = ['done', 'cancelled', 'aboard'];

class LastWords {
  /** Aborts without a last word, by vehicle. */
  private aborts = new Map<number, string>();
  /** One's own missions that the vehicle does not have yet. */
  private missions = new Set<number>();
  private told = new Set<string>();
  private stops: (() => void)[] = [];

  start(): void {
    if (this.stops.length) return;
    this.stops = [
      live.on('command', (event) => this.hearCommand(event.data)),
      live.on('mission', (event) => {
        if ('id' in event.data) this.hearMission(event.data);
      }),
      live.onOpen(() => void this.askMissions()),
      $effect.root(() => {
        $effect(() => this.look());
      }),
    ];
  }

  stop(): void {
    this.stops.forEach((stop) => stop());
    this.stops = [];
  }

  /** An abort that has gone from the summary has had its last word, also while the page was away. */
  private look(): void {
    for (const { vehicle, waiting } of Object.values(live.summaries)) {
      const before = this.aborts.get(vehicle);
      const now = waiting.abort?.id;
      if (before !== undefined && before !== now) void this.askCommand(vehicle, before);
      if (now === undefined) this.aborts.delete(vehicle);
      else this.aborts.set(vehicle, now);
    }
  }

  private async askCommand(vehicle: number, id: string): Promise<void> {
    const row = await api.get<GivenCommand>(`/vehicles/${vehicle}/commands/${id}`).catch(() => undefined);
    if (row) this.hearCommand(row);
  }

  private async askMissions(): Promise<void> {
    for (const { vehicle, waiting } of Object.values(live.summaries)) {
      if (!waiting.missions) continue;
      const aboard = await api.get<MissionAboard>(`/vehicles/${vehicle}/mission`).catch(() => undefined);
      if (aboard?.upload) this.hearMission(aboard.upload);
    }
  }

  private hearCommand(row: GivenCommand): void {
    const isAbort = row.name === 'abort';
    if (!row.is_last || this.told.has(row.id) || !(isAbort || row.user === session.user?.name)) return;
    this.told.add(row.id);
    const what = isAbort ? `Abort of ${nameOf(row.vehicle)}` : `“${row.name}” for ${nameOf(row.vehicle)}`;
    say(what, row.state, row.words, isAbort);
  }

  private hearMission(row: Mission): void {
    if (row.user === session.user?.name && GOING.includes(row.state)) this.missions.add(row.id);
    else if (this.missions.delete(row.id) && row.state !== 'cancelled' && row.state !== 'superseded')
      say(`Mission “${row.name}” for ${nameOf(row.vehicle)}`, row.state, row.words);
  }
}

function nameOf(vehicle: number): string {
  return live.summaries[vehicle]?.name ?? `vehicle ${vehicle}`;
}

function say(what: string, state: string, words: string, lasts = false): void {
  const plain = state.replaceAll('_', ' ');
  const isWell = WELL.includes(state);
  const more = words && words !== plain ? `; ${words}` : '';
  notices.add(isWell ? 'done' : 'problem', `${what}: ${plain}${more}.`, lasts || !isWell);
}

export const lastWords = new LastWords();
