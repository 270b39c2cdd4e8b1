// The alarms that are open, of all vehicles and of the station, each once; the summaries bring them, also after a loss.

import { live } from './live.svelte';
import { byUrgency, identityOf } from './severity';
import type { AlarmBrief } from './types';

export interface OpenAlarm extends AlarmBrief {
  /** Whose it is, in words. */
  whose: string;
}

/** Worst first, then the newest. To be called where it may be asked again: in $derived or an $effect. */
export function openAlarms(): OpenAlarm[] {
  const found = new Map<string, OpenAlarm>();
  for (const summary of Object.values(live.summaries)) {
    for (const alarm of summary.alarms) {
      const known = found.get(identityOf(alarm));
      // the station's own stand in every summary, and one may be older than another
      if (known && (known.acknowledged !== null || alarm.acknowledged === null)) continue;
      found.set(identityOf(alarm), { ...alarm, whose: alarm.vehicle === null ? 'the station' : summary.name });
    }
  }
  return [...found.values()].sort(byUrgency);
}

/** Those of a summary that are the vehicle's, not the station's. */
export function ownAlarms(summary: { alarms: readonly AlarmBrief[] }): AlarmBrief[] {
  return summary.alarms.filter((alarm) => alarm.vehicle !== null);
}
