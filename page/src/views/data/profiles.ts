// Profiles as lines over depth.

import type { ProfileAnswer } from './answers';
import type { Spot } from '../../lib/steps';
import type { Cast } from './casts';
import type { Axis, Pen } from './sheet';

export interface DrawnProfile {
  readonly answer: ProfileAnswer;
  readonly colour: string;
}

export function drawProfiles(it: Pen, profiles: readonly DrawnProfile[], key: string): void {
  const { context } = it;
  context.lineWidth = 1.5;
  for (const { answer, colour } of profiles) {
    const values = answer.values[key];
    const depths = answer.values['depth'];
    if (!values || !depths) continue;
    context.strokeStyle = colour;
    context.beginPath();
    let isDown = false;
    values.forEach((value, index) => {
      const at = depths[index];
      if (value === null || at === null || at === undefined) {
        isDown = false;
        return;
      }
      if (isDown) context.lineTo(it.x(value), it.y(at));
      else context.moveTo(it.x(value), it.y(at));
      isDown = true;
    });
    context.stroke();
  }
}

/** The sample nearest to a place of the paper, both axes counted by their spans; null where there is none. */
export function spotNear(
  casts: readonly Cast[], values: (column: number) => readonly (number | null)[], x: Axis, y: Axis, at: { x: number; y: number },
): Spot | null {
  let found: Spot | null = null;
  let least = Infinity;
  casts.forEach((cast, column) => {
    const those = values(column);
    cast.samples.forEach((sample, row) => {
      const far = Math.hypot(((those[sample] ?? NaN) - at.x) / (x.high - x.low), ((cast.depth[row] ?? NaN) - at.y) / (y.high - y.low));
      if (far < least) [found, least] = [{ column, row }, far];
    });
  });
  return found;
}

/** The value of the sample nearest to a depth; null where the profile does not reach it. */
export function valueNear(answer: ProfileAnswer, key: string, depth: number): number | null {
  const depths = answer.values['depth'] ?? [];
  const values = answer.values[key] ?? [];
  let found: number | null = null;
  let least = Infinity;
  depths.forEach((at, index) => {
    const value = values[index] ?? null;
    if (at === null || value === null) return;
    const far = Math.abs(at - depth);
    if (far < least) [least, found] = [far, value];
  });
  return least <= 5 ? found : null;
}
