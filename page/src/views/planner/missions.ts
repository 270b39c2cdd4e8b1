/** What became of an uploaded mission, in words and colours. */

import { plainState, type Tone } from '../commands/model';

const WORDS: Record<string, string> = {
  given: 'waits for the link',
  queued: 'waits for the link',
  waiting: 'waits for the link',
  sending: 'is being sent',
  uploading: 'is being sent',
  sent: 'sent',
  arrived: 'whole aboard',
  checked: 'taken by the vehicle',
  switched: 'flown by the vehicle',
  done: 'flown by the vehicle',
  refused: 'refused by the vehicle',
  failed: 'failed',
  cancelled: 'cancelled',
  replaced: 'flown before',
  superseded: 'flown before',
};

/** A state of a mission as people say it. */
export function missionWords(state: string): string {
  const plain = plainState(state);
  return WORDS[plain] ?? plain;
}

export function missionTone(state: string): Tone {
  const plain = plainState(state);
  if (/switched|done|aboard|flown/.test(plain)) return 'ok';
  if (/refused|failed/.test(plain)) return 'warning';
  if (/cancelled|replaced|superseded/.test(plain)) return '';
  return 'accent';
}
