/** States that one can go back to and forward again, at most so many. */
export class Undo<T> {
  private past: string[] = [];
  private future: string[] = [];

  constructor(private readonly most = 100) {}

  /** Remember a state before it changes. */
  keep(state: T): void {
    const text = JSON.stringify(state);
    if (this.past.at(-1) === text) return;
    this.past.push(text);
    if (this.past.length > this.most) this.past.shift();
    this.future = [];
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** The state before; null if there is none. */
  undo(present: T): T | null {
    const text = this.past.pop();
    if (text === undefined) return null;
    this.future.push(JSON.stringify(present));
    return JSON.parse(text) as T;
  }

  /** The state that was gone back from; null if there is none. */
  redo(present: T): T | null {
    const text = this.future.pop();
    if (text === undefined) return null;
    this.past.push(JSON.stringify(present));
    return JSON.parse(text) as T;
  }
}
