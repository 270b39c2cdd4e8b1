/** Figures of a link as plain tiles: what each is, and what it means. */

import type { LinkFigures } from '../../lib/types';
import type { FrameRow } from './frames';
import { bytes, duration, number, quantity } from '../../lib/units';

export type { LinkAnswer } from '../../lib/types';

type NotTold = 'goodput_b_s' | 'retransmit_ratio';
/** What one end counts; the vehicle does not tell all of it. */
export type Figures = Omit<LinkFigures, NotTold> & { [Name in NotTold]: number | null };

/** The figures that a LINK_STATISTICS message of the vehicle tells of its side. */
export function toldBy(row: FrameRow): Figures {
  const value = (name: string): number | null => {
    const told = row.values[name];
    return typeof told === 'number' ? told : null;
  };
  const count = (name: string): number => value(name) ?? 0;
  const sent = count('good') + count('lost');
  return {
    good: count('good'),
    bad: count('bad'),
    duplicate: count('duplicate'),
    lost: count('lost'),
    loss_share: sent > 0 ? count('lost') / sent : 0,
    unsigned_refused: count('unsigned_refused'),
    wrongly_signed_refused: count('wrongly_signed_refused'),
    replayed_refused: count('replayed_refused'),
    out_of_step_refused: 0,
    round_trip_s: value('round_trip_time'),
    time_out_s: value('time_out'),
    goodput_b_s: value('goodput'),
    retransmit_ratio: value('retransmit_ratio'),
    bytes_waiting: count('bytes_waiting'),
    surface_time_left_s: value('surface_time_left'),
    is_signing: count('is_signing') !== 0,
  };
}

export interface Figure {
  key: string;
  label: string;
  value: string;
  meaning: string;
  tone: '' | 'caution' | 'warning';
}

/** The tiles of one end; `sender` is who speaks, as in "share of the vehicle's frames". */
export function figuresOf(told: Figures, sender: string): Figure[] {
  const refused = told.unsigned_refused + told.wrongly_signed_refused + told.replayed_refused;
  return [
    figure('good', 'Frames received', count(told.good), `whole, from ${sender}`),
    figure(
      'loss',
      'Lost',
      percent(told.loss_share),
      `${count(told.lost)} frames of ${sender} did not arrive`,
      told.loss_share > 0.3 ? 'caution' : '',
    ),
    figure('rtt', 'Round trip', duration1(told.round_trip_s), `asked again after ${duration1(told.time_out_s)}`),
    figure('goodput', 'Files', told.goodput_b_s === null ? '–' : `${bytes(Math.round(told.goodput_b_s))}/s`, 'new bytes of files'),
    figure('waiting', 'Queue', bytes(told.bytes_waiting), 'waits to be sent'),
    figure('again', 'Sent again', told.retransmit_ratio === null ? '–' : percent(told.retransmit_ratio), 'share of the bytes sent'),
    figure('bad', 'Spoilt', count(told.bad), 'wrong checksum, or noise between frames'),
    figure('duplicate', 'Twice', count(told.duplicate), 'frames that came again'),
    figure(
      'refused',
      'Not believed',
      count(refused),
      refusedWords(told, sender),
      told.wrongly_signed_refused + told.replayed_refused > 0 ? 'warning' : refused > 0 ? 'caution' : '',
    ),
    figure(
      'signing',
      'Signatures',
      told.is_signing ? 'on' : 'off',
      told.is_signing ? 'every frame is signed and checked' : 'anybody in range could speak for either end',
      told.is_signing ? '' : 'caution',
    ),
  ];
}

/** What was not believed; rightly signed frames of an end that had not heard the other one yet are no sign of a stranger. */
function refusedWords(told: Figures, sender: string): string {
  const early = told.out_of_step_refused;
  const apart = early === 0 ? '' : `; not counted: ${count(early)} rightly signed, said before ${sender} had heard the other end`;
  if (told.unsigned_refused + told.wrongly_signed_refused + told.replayed_refused === 0) return `no frame without the right signature${apart}`;
  return `${count(told.unsigned_refused)} unsigned, ${count(told.wrongly_signed_refused)} with a wrong key, ${count(told.replayed_refused)} too old${apart}`;
}

function figure(key: string, label: string, value: string, meaning: string, tone: Figure['tone'] = ''): Figure {
  return { key, label, value, meaning, tone };
}

function count(value: number): string {
  return value.toLocaleString('en').replaceAll(',', '\u202f');
}

function percent(share: number): string {
  return `${number(100 * share, share < 0.1 ? 1 : 0)} %`;
}

function duration1(seconds: number | null): string {
  if (seconds === null) return '–';
  return seconds < 10 ? quantity(seconds, 's', 2) : duration(seconds);
}
