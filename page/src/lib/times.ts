// Times on axes and in fields: UTC always, 24 hours.

const pad = (value: number, width = 2): string => String(value).padStart(width, '0');

/** A time as people write it in a field: 2026-05-03 14:03:25. */
export function toField(t: number): string {
  return Number.isFinite(t) ? new Date(Math.round(t) * 1000).toISOString().slice(0, 19).replace('T', ' ') : '';
}

const WRITTEN = /^(\d{4}-\d{2}-\d{2})(?:[T ]+(\d{1,2}):(\d{2})(?::(\d{2}(?:\.\d+)?))?)?\s*(?:Z|UTC)?$/i;

/** The time in UTC that is written in a field, with or without hours and seconds; null where it is none. */
export function fromField(text: string): number | null {
  const found = WRITTEN.exec(text.trim());
  if (!found) return null;
  const [, day = '', hours = '0', minutes = '00', seconds = '00'] = found;
  const parsed = Date.parse(`${day}T${hours.padStart(2, '0')}:${minutes}:${seconds}Z`);
  return Number.isFinite(parsed) && parsed >= 0 ? parsed / 1000 : null;
}

const MONTHS = ['Jan', 'Feb', 'Mar', 'Apr', 'May', 'Jun', 'Jul', 'Aug', 'Sep', 'Oct', 'Nov', 'Dec'];

/** Labels of the ticks of a time axis; at midnight stands the day instead of 00:00. */
export function tickWords(ticks: readonly number[], increment: number): string[] {
  return ticks.map((t) => {
    const date = new Date(Math.round(t * 1000));
    const day = `${date.getUTCDate()} ${MONTHS[date.getUTCMonth()]}`;
    if (increment >= 28 * 86400) return `${MONTHS[date.getUTCMonth()]} ${date.getUTCFullYear()}`;
    if (increment >= 86400 || t % 86400 === 0) return day;
    const minutes = `${pad(date.getUTCHours())}:${pad(date.getUTCMinutes())}`;
    const seconds = increment < 60 ? `:${pad(date.getUTCSeconds())}` : '';
    const part = increment < 1 ? `.${String(date.getUTCMilliseconds()).padStart(3, '0').slice(0, increment < 0.1 ? 3 : 1)}` : '';
    return `${minutes}${seconds}${part}`;
  });
}
