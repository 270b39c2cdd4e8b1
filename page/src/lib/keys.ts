// Keys of the whole page: a letter, or g and then a letter. Never while somebody types.

export type Keys = Record<string, () => void>;
const PATIENCE_MS = 1200;

function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && (target.isContentEditable || /^(input|textarea|select)$/i.test(target.tagName));
}

/** Listens until the function that comes back is called. `keys()` is asked at each press: { '?': help, 'g f': fleet }. */
export function listen(keys: () => Keys): () => void {
  let first = '';
  let timer: ReturnType<typeof setTimeout> | undefined;
  const forget = (): void => {
    first = '';
    clearTimeout(timer);
  };
  const pressed = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target)) return;
    if (document.querySelector('dialog[open]')) return;
    const table = keys();
    const whole = first ? `${first} ${event.key}` : event.key;
    const action = table[whole] ?? (first ? table[event.key] : undefined);
    forget();
    if (action) {
      event.preventDefault();
      action();
    } else if (Object.keys(table).some((key) => key.startsWith(`${event.key} `))) {
      first = event.key;
      timer = setTimeout(forget, PATIENCE_MS);
    }
  };
  window.addEventListener('keydown', pressed);
  return () => {
    forget();
    window.removeEventListener('keydown', pressed);
  };
}
