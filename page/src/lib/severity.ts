// How loud a severity is on the screen: the station knows critical, warning and notice.

export type Tone = 'warning' | 'caution' | 'accent';

export function toneOf(severity: string | undefined): Tone {
  return severity === 'critical' ? 'warning' : severity === 'notice' ? 'accent' : 'caution';
}

/** The loudest of some. */
export function loudest(severities: readonly string[]): Tone | '' {
  const tones = severities.map(toneOf);
  return tones.includes('warning') ? 'warning' : tones.includes('caution') ? 'caution' : tones.length ? 'accent' : '';
}

const RANK: Record<string, number> = { critical: 2, warning: 1, notice: 0 };

interface Urgent {
  severity: string;
  raised: number | null;
}

/** Worst first, then the newest. */
export function byUrgency(a: Urgent, b: Urgent): number {
  return (RANK[b.severity] ?? 0) - (RANK[a.severity] ?? 0) || (b.raised ?? 0) - (a.raised ?? 0);
}

/** What tells two alarms apart, also while the archive has not taken them and they have no number. */
export function identityOf(alarm: { vehicle: number | null; key: string; raised: number | null }): string {
  return `${alarm.vehicle} ${alarm.key} ${alarm.raised}`;
}
