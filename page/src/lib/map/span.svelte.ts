// Over which stretch of time maps show the track; a choice of whoever looks, for all maps.

import { keptChoice } from '../choice';
import { dateTime, duration } from '../units';

export type TrackSpan = 'day' | 'mission' | 'all';

export const SPANS: readonly { readonly id: TrackSpan; readonly words: string; readonly title: string }[] = [
  { id: 'day', words: '1 d', title: 'The last day of which positions are known' },
  { id: 'mission', words: 'Mission', title: 'Since the vehicle switched to the mission aboard, at least a day' },
  { id: 'all', words: 'All', title: 'Everything that is known of it' },
];

const kept = keptChoice('stommel-track-span');
const STALE_S = 3600;

class SpanChoice {
  chosen = $state<TrackSpan>(SPANS.find((one) => one.id === kept.read())?.id ?? 'mission');

  choose(span: TrackSpan): void {
    this.chosen = span;
    kept.keep(span);
  }
}

export const trackSpan = new SpanChoice();

/** From when to when a track goes, in words; its end is only told if it lies back. */
export function spanWords(begin: number, end: number, now: number | undefined): string {
  const old = now !== undefined && now - end > STALE_S;
  const from = `${dateTime(begin, false)}${old ? ` to ${dateTime(end, false)}` : ''} UTC`;
  return `track ${old ? 'of' : 'since'} ${from} (${duration(end - begin)})`;
}
