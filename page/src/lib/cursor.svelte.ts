// A cursor on what is drawn. Pointer and keys move the same one: whoever moved it last has it.

export class Cursor<Place> {
  #at = $state.raw<Place | null>(null);
  #by = $state<'keys' | 'pointer' | null>(null);
  #isFocused = false;

  /** Where it is; null while nobody has it. */
  get at(): Place | null {
    return this.#by === null ? null : this.#at;
  }

  /** Where it is or was. */
  get last(): Place | null {
    return this.#at;
  }

  get isHeld(): boolean {
    return this.#by === 'keys';
  }

  /** The pointer is there, or away; without a move it takes nothing from the keys. */
  point(at: Place | null, isMoved = true): void {
    if (at !== null && (isMoved || !this.isHeld)) {
      this.#at = at;
      this.#by = 'pointer';
    } else if (at === null && !this.isHeld) {
      this.#by = this.#isFocused ? 'keys' : null;
    }
  }

  /** The keys have it from now on. */
  enter(at: Place | null): void {
    this.#isFocused = true;
    this.move(at);
  }

  move(at: Place | null): void {
    this.#at = at;
    this.#by = 'keys';
  }

  leave(): void {
    this.#isFocused = false;
    if (this.isHeld) this.#by = null;
  }
}
