// Profiles as lines over depth.

import type { ProfileAnswer } from './answers';
import { line, type Pen } from './sheet';

export interface DrawnProfile {
  readonly answer: ProfileAnswer | undefined;
  readonly colour: string;
}

export function drawProfiles(it: Pen, profiles: readonly DrawnProfile[], key: string, depth: number | null): void {
  const { context, box } = it;
  context.lineWidth = 1.5;
  for (const { answer, colour } of profiles) {
    const values = answer?.values[key];
    const depths = answer?.values['depth'];
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
  if (depth === null) return;
  context.strokeStyle = it.ink.faint;
  context.lineWidth = 1;
  context.setLineDash([3, 3]);
  line(context, box.left, it.y(depth), box.left + box.width, it.y(depth));
  context.setLineDash([]);
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
