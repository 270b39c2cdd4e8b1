/** A choice of whoever looks, kept in the browser; where storage is switched off it lasts as long as the page. */
export interface KeptChoice {
  read(): string | null;
  /** Null forgets it. */
  keep(value: string | null): void;
}

export function keptChoice(key: string): KeptChoice {
  return {
    read() {
      try {
        return localStorage.getItem(key);
      } catch {
        return null;
      }
    },
    keep(value) {
      try {
        if (value === null) localStorage.removeItem(key);
        else localStorage.setItem(key, value);
      } catch {
        // Storage is switched off.
      }
    },
  };
}
