/** People as the station's page shows them. */

import type { Role } from '../../lib/types';

export type { AuditRow, Person, Token } from '../../lib/types';

export const ROLES: { role: Role; words: string }[] = [
  { role: 'viewer', words: 'looks at everything, changes nothing' },
  { role: 'pilot', words: 'also commands, plans, sets parameters and limits, acknowledges alarms' },
  { role: 'admin', words: 'also users, chart layers and the audit log' },
];

/** What a password should be; the station has the last word. */
export const PASSWORD_HINT = 'at least 10 characters; a short sentence is easy to remember';

/** What an action was about, in one line: the way it came, and what was said. */
export function detailWords(detail: unknown): string {
  if (detail === null || detail === undefined) return '';
  if (typeof detail !== 'object' || Array.isArray(detail)) return shown(detail);
  const { path, body, by } = detail as Record<string, unknown>;
  const others = Object.entries(detail).filter(([key]) => !['path', 'body', 'by', 'status'].includes(key));
  const said = typeof body === 'object' && body !== null ? pairs(body as Record<string, unknown>) : shown(body);
  const way = by === 'token' ? 'by token' : '';
  return [shown(path).replace(/^\/api/, ''), said, pairs(Object.fromEntries(others)), way].filter(Boolean).join(' · ');
}

function pairs(table: Record<string, unknown>): string {
  return Object.entries(table)
    .filter(([, value]) => value !== null && value !== undefined && value !== '')
    .map(([key, value]) => `${key.replaceAll('_', ' ')} ${shown(value)}`)
    .join(', ');
}

function shown(value: unknown): string {
  if (value === null || value === undefined) return '';
  return typeof value === 'object' ? JSON.stringify(value) : String(value);
}
