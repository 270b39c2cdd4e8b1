// Numbers as people read them: few digits, a unit, a real minus sign.

const MINUS = '\u2212';
const THIN = '\u202f';

export function number(value: number | null | undefined, digits = 1): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

/** A number of things, its thousands apart. */
export function counted(count: number, thing: string): string {
  const digits = String(count).replace(/\B(?=(\d{3})+$)/g, THIN);
  return `${digits} ${thing}${count === 1 ? '' : 's'}`;
}

/** 1st, 2nd, 3rd, 4th ... */
export function ordinal(count: number): string {
  const isTeen = Math.floor((count % 100) / 10) === 1;
  return `${count}${(isTeen ? undefined : ['th', 'st', 'nd', 'rd'][count % 10]) ?? 'th'}`;
}

/** Digits after the point that a value of this size deserves. */
export function digitsFor(value: number, unit = ''): number {
  const size = Math.abs(value);
  if (unit === '' || unit === '1') return Number.isInteger(value) ? 0 : 2;
  if (unit === 'degE' || unit === 'degN') return 5;
  if (unit === 'deg') return 1;
  if (unit === 'm/s') return 2;
  if (size >= 1000) return 0;
  if (size >= 100) return unit === 'ml' ? 0 : 1;
  if (size >= 10) return 1;
  return size >= 0.1 || size === 0 ? 2 : 3;
}

const SHOWN: Record<string, string> = {
  degC: '°C',
  deg: '°',
  degN: '°',
  degE: '°',
  '1': '',
  'm/s': 'm/s',
  'deg/s': '°/s',
};

export function unitWords(unit: string): string {
  return SHOWN[unit] ?? unit;
}

export function quantity(value: number | null | undefined, unit: string, digits?: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const shown = unitWords(unit);
  const joint = shown === '' || shown === '°' ? '' : THIN;
  return number(value, digits ?? digitsFor(value, unit)) + joint + shown;
}

/** A distance in m or km. */
export function distance(metres: number | null | undefined): string {
  if (metres === null || metres === undefined || !Number.isFinite(metres)) return '–';
  if (Math.abs(metres) < 1000) return quantity(metres, 'm', 0);
  return quantity(metres / 1000, 'km', Math.abs(metres) < 100000 ? 1 : 0);
}

/** A stretch of time: 4 s, 3 min, 2 h 05 min, 3 d 4 h. */
export function duration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–';
  const s = Math.max(0, Math.round(seconds));
  if (s < 100) return `${s}${THIN}s`;
  const minutes = Math.round(s / 60);
  if (minutes < 100) return `${minutes}${THIN}min`;
  const hours = Math.floor(minutes / 60);
  if (hours < 48) return `${hours}${THIN}h ${String(minutes % 60).padStart(2, '0')}${THIN}min`;
  return `${Math.floor(hours / 24)}${THIN}d ${hours % 24}${THIN}h`;
}

function iso(t: number): string {
  return new Date(t * 1000).toISOString();
}

const isTime = (t: number | null | undefined): t is number =>
  t !== null && t !== undefined && Number.isFinite(t) && Math.abs(t) < 8.6e12;

/** 14:03:25, UTC. */
export function clockTime(t: number | null | undefined, seconds = true): string {
  return isTime(t) ? iso(t).slice(11, seconds ? 19 : 16) : '–';
}

/** 2026-05-03. */
export function day(t: number | null | undefined): string {
  return isTime(t) ? iso(t).slice(0, 10) : '–';
}

/** 2026-05-03 14:03:25, UTC. */
export function dateTime(t: number | null | undefined, seconds = true): string {
  return isTime(t) ? `${day(t)} ${clockTime(t, seconds)}` : '–';
}

function degreesMinutes(value: number, width: number, letters: [string, string]): string {
  const letter = value < 0 ? letters[1] : letters[0];
  const thousandths = Math.round(Math.abs(value) * 60000);
  const degrees = String(Math.floor(thousandths / 60000)).padStart(width, '0');
  const minutes = ((thousandths % 60000) / 1000).toFixed(3).padStart(6, '0');
  return `${degrees}°${minutes}′${letter}`;
}

/** 30°12.345′N. */
export function latitude(value: number | null | undefined): string {
  return value === null || value === undefined ? '–' : degreesMinutes(value, 2, ['N', 'S']);
}

/** 122°45.600′E. */
export function longitude(value: number | null | undefined): string {
  return value === null || value === undefined ? '–' : degreesMinutes(value, 3, ['E', 'W']);
}

/** 074°. */
export function course(degrees: number | null | undefined): string {
  if (degrees === null || degrees === undefined || !Number.isFinite(degrees)) return '–';
  return `${String(Math.round(((degrees % 360) + 360) % 360) % 360).padStart(3, '0')}°`;
}

/** Speed and course over ground of a velocity. */
export function velocity(north: number, east: number): { speed: number; course: number } {
  return { speed: Math.hypot(north, east), course: ((Math.atan2(east, north) * 180) / Math.PI + 360) % 360 };
}

/** Size of a file. */
export function bytes(count: number | null | undefined): string {
  if (count === null || count === undefined) return '–';
  if (count < 1000) return `${count}${THIN}B`;
  const steps = ['kB', 'MB', 'GB', 'TB'];
  let value = count / 1000;
  let step = 0;
  while (value >= 1000 && step < steps.length - 1) {
    value /= 1000;
    step += 1;
  }
  return `${value.toFixed(value < 10 ? 1 : 0)}${THIN}${steps[step]}`;
}
