// Light, dark, or what the system says. theme.js has set it before the first paint.

import { keptChoice } from './choice';

export type Theme = 'system' | 'light' | 'dark';
const kept = keptChoice('stommel-theme');

function stored(): Theme {
  const value = kept.read();
  return value === 'light' || value === 'dark' ? value : 'system';
}

class ThemeChoice {
  chosen = $state<Theme>(stored());
  /** Rises with each change, also of the system: what draws on a canvas reads its colours again. */
  changes = $state(0);

  constructor() {
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => (this.changes += 1));
  }

  get dark(): boolean {
    void this.changes;
    return this.chosen === 'system' ? matchMedia('(prefers-color-scheme: dark)').matches : this.chosen === 'dark';
  }

  choose(theme: Theme): void {
    this.chosen = theme;
    if (theme === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    kept.keep(theme === 'system' ? null : theme);
    this.changes += 1;
  }

  toggle(): void {
    this.choose(this.dark ? 'light' : 'dark');
  }
}

export const theme = new ThemeChoice();

let probe: HTMLElement | undefined;

/** A colour of tokens.css as rgb(...), as it is in the present theme, for a canvas. */
export function token(name: string): string {
  if (!probe) {
    probe = document.createElement('span');
    probe.hidden = true;
    document.documentElement.append(probe);
  }
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}
