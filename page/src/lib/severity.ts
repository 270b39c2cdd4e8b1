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

/** What tells two alarms apart, also while the archive has not taken them and they have no number. */
export function identityOf(alarm: { vehicle: number | null; key: string; raised: number }): string {
  return `${alarm.vehicle} ${alarm.key} ${alarm.raised}`;
}
