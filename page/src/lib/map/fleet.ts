// How several vehicles are told apart on one map: a letter and a colour each.

const COLOURS = ['track', 'series-2', 'series-3', 'series-4', 'series-5', 'series-6', 'series-7', 'series-8'] as const;

export interface Sign {
  /** Before the numbers of its waypoints. */
  letter: string;
  /** A name of tokens.css. */
  colour: string;
}

/** Sign of the vehicle at a place in the list; nothing where there is only one. */
export function signOf(index: number, count: number): Sign | undefined {
  if (count < 2 || index < 0) return undefined;
  const letters = String.fromCharCode(65 + (index % 26)) + (index < 26 ? '' : String(Math.floor(index / 26)));
  return { letter: letters, colour: COLOURS[index % COLOURS.length] ?? 'track' };
}
