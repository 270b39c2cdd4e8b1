/** What a person has typed and not sent yet; outlives a reload, an expired session and a lost station. */

export interface Draft<T> {
  read(): T | null;
  keep(value: T): void;
  forget(): void;
}

const PREFIX = 'stommel-draft-';
const MOST_CHARACTERS = 2_000_000;

/** A draft under a name; where the browser keeps nothing, it is only in the page. */
export function draft<T>(
  name: string,
  isRight: (value: unknown) => value is T,
  store: Storage | null = storage(),
): Draft<T> {
  const key = PREFIX + name;
  return {
    read() {
      try {
        const value: unknown = JSON.parse(store?.getItem(key) ?? 'null');
        return isRight(value) ? value : null;
      } catch {
        return null;
      }
    },
    keep(value) {
      try {
        const text = JSON.stringify(value);
        if (text.length <= MOST_CHARACTERS) store?.setItem(key, text);
      } catch {
        // full or forbidden: the page goes on without
      }
    },
    forget() {
      try {
        store?.removeItem(key);
      } catch {
        // forbidden: nothing was kept either
      }
    },
  };
}

function storage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

/** Whether a value is an object with names, which a draft of a form is. */
export function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
