// What is sampled and derived, as oceanographers call it, and the colours of each.

import { interpolateCividis, interpolateMagma, interpolatePlasma, interpolateViridis } from 'd3-scale-chromatic';

export interface Variable {
  readonly key: string;
  readonly words: string;
  readonly unit: string;
  readonly digits: number;
  readonly colours: (share: number) => string;
}

/** A part of a colour scale, so that neither end vanishes on light or dark paper. */
const part = (colours: (share: number) => string, low: number, high: number) => (share: number): string =>
  colours(low + share * (high - low));

const TEMPERATURE: Variable = {
  key: 'conservative_temperature',
  words: 'Conservative temperature',
  unit: '°C',
  digits: 2,
  colours: part(interpolatePlasma, 0, 0.95),
};

export const VARIABLES: readonly Variable[] = [
  TEMPERATURE,
  { key: 'absolute_salinity', words: 'Absolute salinity', unit: 'g/kg', digits: 3, colours: part(interpolateViridis, 0.05, 1) },
  { key: 'potential_density_anomaly', words: 'Potential density anomaly', unit: 'kg/m³', digits: 2, colours: part(interpolateCividis, 0.05, 1) },
  { key: 'density', words: 'In-situ density', unit: 'kg/m³', digits: 2, colours: part(interpolateCividis, 0.05, 1) },
  { key: 'temperature', words: 'In-situ temperature', unit: '°C', digits: 2, colours: part(interpolatePlasma, 0, 0.95) },
  { key: 'practical_salinity', words: 'Practical salinity', unit: '', digits: 3, colours: part(interpolateViridis, 0.05, 1) },
  { key: 'sound_speed', words: 'Speed of sound', unit: 'm/s', digits: 1, colours: part(interpolateMagma, 0.2, 0.95) },
  { key: 'conductivity', words: 'Conductivity', unit: 'S/m', digits: 3, colours: part(interpolateViridis, 0.05, 1) },
];

export function variableNamed(key: string): Variable {
  return VARIABLES.find((one) => one.key === key) ?? TEMPERATURE;
}

/** Name and unit, for an axis. */
export function labelOf(variable: Variable): string {
  return variable.unit ? `${variable.words}, ${variable.unit}` : variable.words;
}

/** A colour scale as 256 colours, red, green, blue and opacity of each after another. */
export function table(colours: (share: number) => string): Uint8ClampedArray {
  const found = new Uint8ClampedArray(1024);
  for (let index = 0; index < 256; index += 1) {
    const [red = 0, green = 0, blue = 0] = channels(colours(index / 255));
    found.set([red, green, blue, 255], 4 * index);
  }
  return found;
}

function channels(colour: string): number[] {
  if (colour.startsWith('#')) return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return (colour.match(/[\d.]+/g) ?? []).slice(0, 3).map(Number);
}
