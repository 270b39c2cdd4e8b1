import { describe, expect, it } from 'vitest';
import { counted } from '../../lib/units';
import { logWords } from './model';

const taken = { state: 'taken' as const, words: 'whole, 16349 records', share: 1, samples: 12345, dives: 3, texts: 40, left_out: 0 };

describe('what is told of a log', () => {
  it('counts what is in the archive', () => {
    expect(logWords(taken)).toBe('in the archive: 12\u202f345 samples, 3 dives, 40 status texts');
    expect(logWords({ ...taken, samples: 1, dives: 1, texts: 1, left_out: 2 })).toBe(
      'in the archive: 1 sample, 1 dive, 1 status text, 2 rows left out, which no archive takes',
    );
  });

  it('says what is wrong', () => {
    expect(logWords({ ...taken, words: 'truncated after record 7 at byte 99' })).toContain('40 status texts; truncated after record 7');
    expect(logWords({ ...taken, state: 'refused', words: 'the clock was not set' })).toBe('not in the archive: the clock was not set');
  });

  it('says how far it is', () => {
    expect(logWords({ ...taken, state: 'going', share: 0.459 })).toBe('goes into the archive: 45 %');
    expect(logWords({ ...taken, state: 'waiting' })).toBe('waits to go into the archive');
  });

  it('keeps thousands apart', () => {
    expect(counted(1234567, 'byte')).toBe('1\u202f234\u202f567 bytes');
    expect(counted(999, 'byte')).toBe('999 bytes');
  });
});
