// Short messages at the corner: what was done, or why not.

export interface Notice {
  id: number;
  kind: 'done' | 'problem';
  words: string;
}

class Notices {
  list = $state.raw<Notice[]>([]);
  private count = 0;

  /** What was done goes by itself, unless it is to last until somebody has read it. */
  add(kind: Notice['kind'], words: string, lasts = kind === 'problem'): void {
    this.count += 1;
    const notice = { id: this.count, kind, words };
    this.list = [...this.list.slice(-3), notice];
    if (!lasts) setTimeout(() => this.remove(notice.id), 6000);
  }

  remove(id: number): void {
    this.list = this.list.filter((notice) => notice.id !== id);
  }
}

export const notices = new Notices();
export const done = (words: string): void => notices.add('done', words);
export const problem = (words: string): void => notices.add('problem', words);
