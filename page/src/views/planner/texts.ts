/** Texts that were typed into fields of places and are no right value: they keep to their place when others come or go. */

export type Texts = Record<string, string>;

/** Texts when a place comes before number `from` of a list (`by` 1), or the one before it goes (`by` -1). */
export function renumbered(texts: Texts, list: string, from: number, by: number): Texts {
  const moved = Object.entries(texts).flatMap(([key, text]): [string, string][] => {
    const [first, number, ...rest] = key.split('.');
    if (first !== list || number === undefined) return [[key, text]];
    const old = Number(number);
    if (by < 0 && old === from + by) return [];
    return [[[list, old >= from ? old + by : old, ...rest].join('.'), text]];
  });
  return Object.fromEntries(moved);
}

/** Texts without those of a list. */
export function withoutList(texts: Texts, list: string): Texts {
  return Object.fromEntries(Object.entries(texts).filter(([key]) => !key.startsWith(`${list}.`)));
}
