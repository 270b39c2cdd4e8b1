// Steps of a cursor over what is drawn: along a line of places, or over columns that have places from top to bottom.

export interface Step {
  readonly axis: 'across' | 'down';
  readonly by: 1 | -1;
  readonly reach: 'next' | 'far' | 'end';
}

/** A place in columns: which column, and which of its places. */
export interface Spot {
  readonly column: number;
  readonly row: number;
}

/** Columns side by side; of each, where its places lie, from top to bottom. */
export type Columns = readonly (readonly number[])[];

type Press = Pick<KeyboardEvent, 'key' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey'>;

const STEPS: Record<string, Step> = {
  ArrowLeft: { axis: 'across', by: -1, reach: 'next' },
  ArrowRight: { axis: 'across', by: 1, reach: 'next' },
  ArrowUp: { axis: 'down', by: -1, reach: 'next' },
  ArrowDown: { axis: 'down', by: 1, reach: 'next' },
  PageUp: { axis: 'down', by: -1, reach: 'far' },
  PageDown: { axis: 'down', by: 1, reach: 'far' },
  Home: { axis: 'across', by: -1, reach: 'end' },
  End: { axis: 'across', by: 1, reach: 'end' },
};
/** A step that is far goes over such a part of all places, but over so many at least. */
const PART = 1 / 20;
const FEWEST = 5;

/** The step that a key asks for; Shift makes it a far one. */
export function stepOf(press: Press): Step | undefined {
  if (press.ctrlKey || press.altKey || press.metaKey) return undefined;
  const step = STEPS[press.key];
  return step && press.shiftKey && step.reach === 'next' ? { ...step, reach: 'far' } : step;
}

/** Which way a step goes along a line: to the right is onwards, and so is up. */
export function onwards(step: Step): 1 | -1 {
  return (step.axis === 'down') === step.by > 0 ? -1 : 1;
}

/** The place on a line after a step. */
export function onLine(at: number, count: number, step: Step): number {
  return stepped(at, count, onwards(step), step.reach);
}

/** The place in columns after a step; in another column, the one that lies nearest to where it came from. */
export function onColumns(at: Spot, columns: Columns, step: Step): Spot {
  const here = columns[at.column] ?? [];
  if (step.axis === 'down') return { ...at, row: stepped(at.row, here.length, step.by, step.reach) };
  const column = stepped(at.column, columns.length, step.by, step.reach);
  return { column, row: nearestTo(here[at.row] ?? 0, columns[column] ?? []) };
}

function stepped(at: number, count: number, by: 1 | -1, reach: Step['reach']): number {
  const size = { next: 1, far: Math.max(FEWEST, Math.round(count * PART)), end: count }[reach];
  return Math.max(0, Math.min(count - 1, at + by * size));
}

function nearestTo(wanted: number, places: readonly number[]): number {
  let found = 0;
  places.forEach((place, index) => {
    if (Math.abs(place - wanted) < Math.abs((places[found] ?? Infinity) - wanted)) found = index;
  });
  return found;
}
