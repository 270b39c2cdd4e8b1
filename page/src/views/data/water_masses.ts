// A T-S diagram: samples by depth, and lines of equal potential density with their values.

import { extent, type Axis, type Pen } from './sheet';
import type { DensityLine, DiagramAnswer } from './answers';

export interface Diagram {
  readonly x: Axis;
  readonly y: Axis;
  readonly depth: [number, number];
}

export function diagramOf(answer: DiagramAnswer): Diagram | null {
  const salinity = extent(answer.absolute_salinity);
  const temperature = extent(answer.conservative_temperature);
  const depth = extent(answer.depth_m, 0);
  if (!salinity || !temperature || !depth) return null;
  return {
    x: { low: salinity[0], high: salinity[1], label: 'Absolute salinity, g/kg' },
    y: { low: temperature[0], high: temperature[1], label: 'Conservative temperature, °C' },
    depth: [Math.max(0, depth[0]), depth[1]],
  };
}

export function drawLines(it: Pen, lines: readonly DensityLine[]): void {
  const { context, ink } = it;
  context.strokeStyle = ink.faint;
  context.fillStyle = ink.text;
  context.font = ink.font;
  context.lineWidth = 1;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const line of lines) {
    const places = line.absolute_salinity.map((salinity, index) => [it.x(salinity), it.y(line.conservative_temperature[index] ?? NaN)] as const);
    context.globalAlpha = 0.55;
    context.setLineDash([4, 3]);
    context.beginPath();
    places.forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
    label(it, String(Number(line.level.toFixed(2))), places);
  }
}

/** The value of a line stands on it, where it is well inside the paper. */
function label(it: Pen, words: string, places: readonly (readonly [number, number])[]): void {
  const { box, context, ink } = it;
  const inside = places.filter(
    ([x, y]) => x > box.left + 20 && x < box.left + box.width - 20 && y > box.top + 10 && y < box.top + box.height - 10,
  );
  const place = inside[Math.floor(inside.length * 0.12)];
  if (!place) return;
  const width = context.measureText(words).width + 6;
  context.fillStyle = ink.ground;
  context.fillRect(place[0] - width / 2, place[1] - 7, width, 14);
  context.fillStyle = ink.text;
  context.fillText(words, place[0], place[1]);
}

export function drawSamples(it: Pen, answer: DiagramAnswer, depth: [number, number], colours: Uint8ClampedArray, chosen: number | null): void {
  const span = depth[1] - depth[0] || 1;
  answer.absolute_salinity.forEach((salinity, index) => {
    const at = 4 * Math.round(255 * Math.min(1, Math.max(0, ((answer.depth_m[index] ?? 0) - depth[0]) / span)));
    const isFaint = chosen !== null && answer.profile[index] !== chosen;
    it.context.globalAlpha = isFaint ? 0.15 : 0.9;
    it.context.fillStyle = `rgb(${colours[at]} ${colours[at + 1]} ${colours[at + 2]})`;
    it.context.fillRect(it.x(salinity) - 1.5, it.y(answer.conservative_temperature[index] ?? NaN) - 1.5, 3, 3);
  });
  it.context.globalAlpha = 1;
}

/** The sample nearest to a place of the diagram, both axes counted by their spans; null where none is near. */
export function sampleNear(answer: DiagramAnswer, diagram: Diagram, at: { x: number; y: number }): number | null {
  const across = diagram.x.high - diagram.x.low;
  const up = diagram.y.high - diagram.y.low;
  let found: number | null = null;
  let least = 0.03;
  answer.absolute_salinity.forEach((salinity, index) => {
    const far = Math.hypot((salinity - at.x) / across, ((answer.conservative_temperature[index] ?? NaN) - at.y) / up);
    if (far < least) [found, least] = [index, far];
  });
  return found;
}
