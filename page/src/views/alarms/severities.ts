// How bad an alarm is: its words and its mark.

export const SEVERITIES = ['critical', 'warning', 'notice'] as const;

const TAGS: Record<string, string> = { critical: 'warning', warning: 'caution', notice: 'accent' };

/** Class of the tag of a severity; the word itself stands in it, so that nothing depends on the colour. */
export function tagOf(severity: string): string {
  return TAGS[severity] ?? '';
}
