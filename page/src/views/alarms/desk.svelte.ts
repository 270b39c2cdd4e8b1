// Alarms of a vehicle and the station, or of all: those that need somebody, and page by page those that are history.

import { api, sentence } from '../../lib/api';
import { live } from '../../lib/live.svelte';
import { byUrgency, identityOf } from '../../lib/severity';
import type { AlarmRow } from '../../lib/types';

const PAGE = 100;
/** As many as the station tells at once. */
const MOST = 1000;

export class AlarmDesk {
  /** Open, or over and not acknowledged; undefined before they are known. */
  needing = $state.raw<readonly AlarmRow[]>();
  past = $state.raw<readonly AlarmRow[]>([]);
  hasOlder = $state(false);
  isBusy = $state(false);
  failure = $state<string>();
  /** Events that came while the lists were asked for. */
  #meanwhile: AlarmRow[] | undefined;
  #number = 0;
  #ends: (() => void)[];

  constructor(readonly vehicle: number | undefined) {
    void this.load();
    this.#ends = [live.on('alarm', (event) => this.take(event.data)), live.onOpen(() => void this.load())];
  }

  close(): void {
    this.#number += 1;
    this.#ends.forEach((end) => end());
  }

  async load(): Promise<void> {
    const number = (this.#number += 1);
    this.#meanwhile = [];
    try {
      const [open, over, past] = await Promise.all([
        this.#rows({ open: true, limit: MOST }),
        this.#rows({ open: false, acknowledged: false, limit: MOST }),
        this.#rows({ open: false, acknowledged: true, limit: PAGE }),
      ]);
      if (number !== this.#number) return;
      this.needing = [...open, ...over].sort(byUrgency);
      this.past = past;
      this.hasOlder = past.length === PAGE;
      this.failure = undefined;
      const news = this.#meanwhile;
      this.#meanwhile = undefined;
      news.forEach((row) => this.take(row));
    } catch (error) {
      if (number === this.#number) this.failure = sentence(error);
    }
  }

  async older(): Promise<void> {
    const last = this.past.at(-1)?.id;
    if (last == null || this.isBusy) return;
    const number = this.#number;
    this.isBusy = true;
    try {
      const found = await this.#rows({ open: false, acknowledged: true, limit: PAGE, before: last });
      if (number !== this.#number) return;
      const known = new Set(this.past.map(identityOf));
      this.past = [...this.past, ...found.filter((row) => !known.has(identityOf(row)))];
      this.hasOlder = found.length === PAGE;
      this.failure = undefined;
    } catch (error) {
      if (number === this.#number) this.failure = sentence(error);
    } finally {
      this.isBusy = false;
    }
  }

  /** Takes an alarm as it is now. */
  take(row: AlarmRow): void {
    // the station's own alarms are everybody's
    if (this.vehicle !== undefined && row.vehicle !== this.vehicle && row.vehicle !== null) return;
    this.#meanwhile?.push(row);
    if (!this.needing) return;
    const others = (rows: readonly AlarmRow[]): AlarmRow[] => rows.filter((other) => identityOf(other) !== identityOf(row));
    const isPast = row.cleared !== null && row.acknowledged !== null;
    this.needing = isPast ? others(this.needing) : [...others(this.needing), row].sort(byUrgency);
    const last = this.past.at(-1);
    const isShown = isPast && (!this.hasOlder || last === undefined || row.raised >= last.raised);
    this.past = isShown ? [...others(this.past), row].sort((a, b) => b.raised - a.raised) : others(this.past);
  }

  #rows(query: Record<string, string | number | boolean>): Promise<AlarmRow[]> {
    return api.get<AlarmRow[]>('/alarms', { ...query, vehicle: this.vehicle });
  }
}
