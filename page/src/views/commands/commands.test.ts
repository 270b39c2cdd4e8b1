// Oracle: the station, which counts each change of a command as later than the one before it.
import { expect, it } from 'vitest';
import type { CommandRow } from './model';
import { withRow } from './model';

const row = (state: string, changed: number): CommandRow =>
  ({ id: 'a', given: 100, state, changed }) as CommandRow;

it('takes what was said later, and no answer that was long under way', () => {
  const sent = withRow([], row('queued', 100));
  const done = withRow(sent, row('done', 100.000001));
  expect(done.map((each) => each.state)).toEqual(['done']);
  expect(withRow(done, row('queued', 100)).map((each) => each.state)).toEqual(['done']);
});
