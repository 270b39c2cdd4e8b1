/** Files of a vehicle and their transfers, as the page shows them. */

import type { StoredLog, Transfer } from '../../lib/types';
import { bytes, counted } from '../../lib/units';
import { plainState, type Tone } from '../commands/model';

export type { FolderEntry as Entry, StoredFile, Transfer } from '../../lib/types';

/** How far a log is in the archive, in words. */
export function logWords(log: Omit<StoredLog, 'begin' | 'end'>): string {
  if (log.state === 'waiting') return 'waits to go into the archive';
  if (log.state === 'going') return `goes into the archive: ${Math.floor(100 * log.share)} %`;
  if (log.state === 'refused') return `not in the archive: ${log.words}`;
  const found = [counted(log.samples, 'sample'), counted(log.dives, 'dive'), counted(log.texts, 'status text')];
  if (log.left_out > 0) found.push(`${counted(log.left_out, 'row')} left out, which no archive takes`);
  const told = `in the archive: ${found.join(', ')}`;
  return log.words.startsWith('whole') ? told : `${told}; ${log.words}`;
}

/** How much of a file is there, 0 to 1; null before its size is known. */
export function shareOf(transfer: Transfer): number | null {
  if (/whole|done/.test(transfer.state)) return 1;
  return transfer.size ? Math.min(1, transfer.done / transfer.size) : null;
}

/** What a transfer is doing, in words. */
export function transferWords(transfer: Transfer): string {
  const state = plainState(transfer.state);
  if (transfer.is_over) {
    if (transfer.reason.startsWith(state)) return transfer.reason;
    return transfer.reason ? `${state}: ${transfer.reason}` : state;
  }
  if (transfer.is_paused) return 'paused; goes on where it was';
  if (state === 'going') return transfer.reason || (transfer.direction === 'upload' ? 'is being sent' : 'is being fetched');
  return transfer.reason || state;
}

export function transferTone(transfer: Transfer): Tone {
  if (!transfer.is_over) return transfer.is_paused ? '' : 'accent';
  if (/whole|done/.test(transfer.state)) return 'ok';
  return /cancel/.test(transfer.state) ? '' : 'warning';
}

/** The folder above a path; the root's is the root. */
export function above(path: string): string {
  return path.split('/').filter(Boolean).slice(0, -1).join('/');
}

/** A name in a folder. */
export function inside(folder: string, name: string): string {
  return folder ? `${folder}/${name}` : name;
}

/** Folders from the root to a path: name and path of each. */
export function crumbs(path: string): { name: string; path: string }[] {
  const parts = path.split('/').filter(Boolean);
  return parts.map((name, index) => ({ name, path: parts.slice(0, index + 1).join('/') }));
}

/** Of a file that is sent to a vehicle; the station has the last word. */
const MOST_BYTES = 8 << 20;

/** What is wrong with a file that shall be sent, in words; empty if nothing is. */
export function fileProblem(file: File): string {
  if (file.size === 0) return 'this file is empty';
  return file.size > MOST_BYTES ? `this file has ${bytes(file.size)}; at most ${bytes(MOST_BYTES)} go over the radio` : '';
}

/** What is wrong with a path that a file shall get, in words; empty if nothing is. */
export function pathProblem(path: string): string {
  const parts = path.split('/');
  if (path.trim() === '') return 'give the file a name';
  if (path.length > 200) return 'at most 200 characters';
  if (parts.some((part) => part === '' || part === '.' || part === '..')) return 'no empty, “.” or “..” folders';
  return '';
}
