/** What became of an uploaded mission, in words and colours. */

import { plainState, type Tone } from '../commands/model';

const WORDS: Record<string, string> = {
  waiting: 'waits for the vehicle',
  sending: 'is being sent',
  aboard: 'the vehicle has switched to it',
  replaced: 'held before',
  refused: 'refused by the vehicle',
  failed: 'failed',
  interrupted: 'interrupted',
  cancelled: 'taken back',
  superseded: 'another one came in its place',
  expired: 'its time was over',
};

/** A state of a mission as people say it. */
export function missionWords(state: string): string {
  const plain = plainState(state);
  return WORDS[plain] ?? plain;
}

export function missionTone(state: string): Tone {
  const plain = plainState(state);
  if (plain === 'aboard') return 'ok';
  if (plain === 'refused' || plain === 'failed') return 'warning';
  if (plain === 'interrupted' || plain === 'expired') return 'caution';
  return ['replaced', 'cancelled', 'superseded'].includes(plain) ? '' : 'accent';
}
