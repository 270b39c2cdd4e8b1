// Values that begin anew after a full turn, as a heading: where they are cut open to be drawn, and how they are read.

/** What of a channel tells that its values go around: after which turn, and from where on. */
export interface Around {
  low: number;
  turn: number | null;
}

const SECTORS = 72;
/** Sectors without a value that are enough to cut there; with fewer the values are all around. */
const FEWEST_FREE = 6;
/** Beside the place where a line leaves at one edge and comes in at the other, s. */
export const BESIDE_S = 1e-3;

/** The value in the turn that begins at `from`. */
export function within(value: number, from: number, turn: number): number {
  if (value >= from && value < from + turn) return value; // not a bit otherwise than it was told
  const rest = (value - from) % turn;
  return from + (rest < 0 ? rest + turn : rest);
}

/** The value as it is read: 359.97 with one digit is 0.0, never 360.0. */
export function readAround(value: number, around: Around, digits: number): number {
  if (!around.turn) return value;
  const shown = Number(within(value, around.low, around.turn).toFixed(digits));
  return shown >= around.low + around.turn ? shown - around.turn : shown;
}

/** Where to cut the turn open: at its usual begin unless values are there, else in the middle of the widest free stretch. */
export function cutOf(values: Iterable<number | null | undefined>, around: Around): number {
  const turn = around.turn ?? 1;
  const taken = new Array<boolean>(SECTORS).fill(false);
  for (const value of values) {
    if (typeof value !== 'number') continue;
    taken[Math.min(SECTORS - 1, Math.floor(((within(value, around.low, turn) - around.low) / turn) * SECTORS))] = true;
  }
  const first = taken.indexOf(true);
  const about = first + (SECTORS - 1 - taken.lastIndexOf(true));
  if (first < 0 || about >= FEWEST_FREE) return around.low; // nothing is where it is cut usually
  let widest = 0;
  let cut = around.low;
  let free = 0;
  for (let step = 1; step <= SECTORS; step += 1) {
    const sector = (first + step) % SECTORS;
    if (!taken[sector]) {
      free += 1;
      continue;
    }
    if (free > widest) {
      widest = free;
      cut = around.low + ((first + step - free / 2) / SECTORS) * turn;
    }
    free = 0;
  }
  if (widest < FEWEST_FREE) return around.low;
  return cut >= around.low + turn / 2 ? cut - turn : cut;
}

/** Times and values, null in a gap. */
export interface Line {
  readonly t: readonly number[];
  readonly value: readonly (number | null)[];
}

/** The line in the turn from `cut` on; where it goes around, it leaves at one edge and comes in at the other. */
export function laidOut(line: Line, cut: number, turn: number): { t: number[]; value: (number | null)[] } {
  const t: number[] = [];
  const value: (number | null)[] = [];
  let before: number | null = null;
  line.t.forEach((time, place) => {
    const told = line.value[place] ?? null;
    const here = told === null ? null : within(told, cut, turn);
    if (here !== null && before !== null && Math.abs(here - before) > turn / 2) {
      const isUp = here < before;
      const [leaves, enters] = isUp ? [cut + turn, cut] : [cut, cut + turn];
      const out = Math.abs(leaves - before);
      const way = out + Math.abs(here - enters);
      const last = t.at(-1) ?? time;
      const middle = last + (way > 0 ? out / way : 0.5) * (time - last);
      const beside = Math.min(BESIDE_S, (time - last) / 8);
      const inside = Math.min(Math.max(middle, last + 2 * beside), time - 2 * beside);
      t.push(inside - beside, inside, inside + beside);
      value.push(leaves, null, enters);
    }
    t.push(time);
    value.push(here);
    before = here;
  });
  return { t, value };
}
