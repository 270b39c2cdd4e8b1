// How bad an alarm is: its words and its mark.

export const SEVERITIES = ['critical', 'warning', 'notice'] as const;

const TAGS: Record<string, string> = { critical: 'warning', warning: 'caution', notice: 'accent' };

/** Class of the tag of a severity; the word itself stands in it, so that nothing depends on the colour. */
export function tagOf(severity: string): string {
  return TAGS[severity] ?? '';
}

const RANK: Record<string, number> = { critical: 2, warning: 1, notice: 0 };

/** Worst first, then the newest. */
export function byUrgency(a: { severity: string; raised: number }, b: { severity: string; raised: number }): number {
  return (RANK[b.severity] ?? 0) - (RANK[a.severity] ?? 0) || b.raised - a.raised;
}
