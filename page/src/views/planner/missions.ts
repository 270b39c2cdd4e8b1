/** What became of an uploaded mission, in words and colours. */

import { plainState, type Tone } from '../commands/model';

const WORDS: Record<string, string> = {
  waiting: 'waits for the link',
  sending: 'is being sent',
  aboard: 'the vehicle has switched to it',
  replaced: 'held before',
  refused: 'refused by the vehicle',
  failed: 'failed',
  interrupted: 'interrupted',
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
  if (plain === 'interrupted') return 'caution';
  return plain === 'replaced' ? '' : 'accent';
}
