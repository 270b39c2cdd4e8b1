/** A preview: what the simulator found, or how far it is. */

import type { Job, Preview as PreviewResult } from '../../lib/types';

export type { Job, PreviewResult };

/** Whether a job ended, one way or the other. */
export function isOver(job: Job): boolean {
  return job.state === 'done' || job.state === 'failed' || job.state === 'cancelled';
}

/** How far a job is, in words. */
export function jobWords(job: Job): string {
  if (job.state === 'waiting') return 'Waits for the simulator, which flies another plan first';
  if (job.state === 'starting') return 'The simulator is made ready; this takes a while the first time';
  return `The simulator flies the plan: ${Math.round(100 * job.share)} %`;
}

/** A line through depths; a gap where one is not known. */
export function depthPath(
  times: number[],
  depths: (number | null)[],
  x: (t: number) => number,
  y: (depth: number) => number,
): string {
  let path = '';
  let pen = false;
  times.forEach((t, index) => {
    const depth = depths[index];
    if (depth === null || depth === undefined || !Number.isFinite(depth)) {
      pen = false;
      return;
    }
    path += `${pen ? 'L' : 'M'}${x(t).toFixed(1)} ${y(depth).toFixed(1)}`;
    pen = true;
  });
  return path;
}

/** The step of 1, 2 or 5 times a power of ten that is no smaller. */
export function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(least, 1e-9)));
  return [1, 2, 5, 10].map((each) => each * power).find((each) => each >= least) ?? 10 * power;
}
