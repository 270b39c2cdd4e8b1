// Times on axes and in fields: UTC always, 24 hours.

const pad = (value: number, width = 2): string => String(value).padStart(width, '0');

/** The value of an input of type datetime-local (with seconds) for a time in UTC. */
export function toField(t: number): string {
  return Number.isFinite(t) ? new Date(Math.round(t) * 1000).toISOString().slice(0, 19) : '';
}

/** The time in UTC that stands in such an input; null where it holds none. */
export function fromField(text: string): number | null {
  const parsed = Date.parse(text.length === 16 ? `${text}:00Z` : `${text}Z`);
  return Number.isFinite(parsed) ? parsed / 1000 : null;
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
