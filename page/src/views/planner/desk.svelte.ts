/** The plan on the desk: every change can be undone, is kept in the browser, and is checked by the station. */

import { api, sentence } from '../../lib/api';
import { draft, isRecord } from '../../lib/drafts';
import { numberOf, problemOf, type PlanField, type PlanSection, valueAt, withValue } from './fields';
import { inserted, isPlan, MOST_PLACES, type PlaceList, type Plan, type PlanPlace, type PlanProblem, without } from './plan';
import { renumbered, withoutList } from './texts';
import { Undo } from './undo';

interface Kept {
  plan: Plan;
  texts: Record<string, string>;
}

const CHECK_AFTER_MS = 350;
const CHECK_AGAIN_MS = 5000;

function isKept(value: unknown): value is Kept {
  return isRecord(value) && isPlan(value.plan) && isRecord(value.texts);
}

export class Desk {
  readonly vehicle: number;
  plan = $state.raw<Plan | null>(null);
  /** Texts that are no right value yet, by key: shown as they were typed, and never sent. */
  texts = $state.raw<Record<string, string>>({});
  /** What the station found wrong. */
  told = $state.raw<PlanProblem[]>([]);
  /** What a pilot should know, though it can be flown. */
  warnings = $state.raw<string[]>([]);
  checking = $state(false);
  /** Why the station did not check it; empty if it did. */
  unchecked = $state('');
  sections = $state.raw<PlanSection[]>([]);
  steps = $state(0);
  /** Rises with each change of the plan. */
  version = $state(0);
  /** Whether a draft from before was found. */
  readonly isRestored: boolean;
  private undoing = new Undo<Plan>();
  private kept;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asked = 0;
  private isAsking = false;
  private again = false;

  constructor(vehicle: number) {
    this.vehicle = vehicle;
    this.kept = draft(`plan.${vehicle}`, isKept);
    const before = this.kept.read();
    this.isRestored = before !== null;
    if (before) {
      this.plan = { ...before.plan, waypoints: before.plan.waypoints ?? [] };
      this.texts = before.texts;
      this.check();
    }
  }

  get canUndo(): boolean {
    void this.steps;
    return this.undoing.canUndo;
  }

  get canRedo(): boolean {
    void this.steps;
    return this.undoing.canRedo;
  }

  /** Everything that is wrong, as typed here and as the station says. */
  readonly problems = $derived.by<PlanProblem[]>(() => {
    const typed = this.sections
      .flatMap((section) => section.fields)
      .map((field) => ({ field, text: this.texts[field.key] }))
      .filter((each): each is { field: PlanField; text: string } => each.text !== undefined)
      .map(({ field, text }) => ({ key: field.key, value: text, reason: problemOf(field, text), allowed: '' }));
    const places = Object.entries(this.texts)
      .filter(([key]) => /latitude|longitude/.test(key) && valueAt(this.plan, key) !== undefined)
      .map(([key, text]) => ({ key, value: text, reason: `"${text}" is no ${key.split('.').at(-1)?.split('_')[0]}`, allowed: '' }));
    const known = new Set([...typed, ...places].map((each) => each.key));
    return [...typed, ...places, ...this.told.filter((each) => !known.has(each.key))];
  });

  /** What is wrong at a key, or below it. */
  problemAt(key: string, below = false): string {
    const found = this.problems.find((each) => each.key === key || (below && each.key.startsWith(`${key}.`)));
    return found ? plain(found) : '';
  }

  /** Takes a changed plan. Changes with the same `run`, such as the steps of one drag, are undone as one. */
  change(plan: Plan, run = ''): void {
    if (this.plan && (run === '' || run !== this.run)) this.undoing.keep(this.plan);
    this.run = run;
    this.put(plan);
  }

  /** What comes next is another step to be undone, even if it is like the last: a pointer was lifted between. */
  rest(): void {
    this.run = '';
  }

  private run = '';

  /** One place more, before the one of that number. */
  insert(list: PlaceList, number: number, place: PlanPlace): void {
    if (!this.plan || (this.plan[list] ?? []).length >= MOST_PLACES) return;
    this.texts = renumbered(this.texts, list, number, 1);
    this.change(inserted(this.plan, number, place, list));
  }

  /** One place less. */
  remove(list: PlaceList, number: number): void {
    if (!this.plan) return;
    this.texts = renumbered(this.texts, list, number + 1, -1);
    this.change(without(this.plan, number, list));
  }

  /** Other corners in place of all that there are. */
  enclose(corners: PlanPlace[]): void {
    if (!this.plan) return;
    this.texts = withoutList(this.texts, 'geofence');
    this.change({ ...this.plan, geofence: corners });
  }

  /** Opens another plan; the one before can be had back. */
  open(plan: Plan): void {
    this.texts = {};
    this.change({ ...plan, waypoints: plan.waypoints ?? [] });
  }

  undo(): void {
    if (!this.plan) return;
    this.rest();
    const before = this.undoing.undo(this.plan);
    if (before) this.put(before);
  }

  redo(): void {
    if (!this.plan) return;
    this.rest();
    const after = this.undoing.redo(this.plan);
    if (after) this.put(after);
  }

  /** Takes what was typed into a field: into the plan if it is right, else as the text that it is. */
  type(field: PlanField, text: string): void {
    if (!this.plan) return;
    if (field.kind !== 'text' && problemOf(field, text)) {
      this.hold(field.key, text);
      return;
    }
    this.release(field.key);
    const empty = text.trim() === '';
    this.change(withValue(this.plan, field.key, empty ? undefined : field.kind === 'text' ? text : numberOf(text)), field.key);
  }

  /** Keeps a text that is no right value. */
  hold(key: string, text: string): void {
    this.texts = { ...this.texts, [key]: text };
    this.keep();
  }

  /** Forgets a text that has become right. */
  release(key: string): void {
    if (this.texts[key] === undefined) return;
    this.texts = Object.fromEntries(Object.entries(this.texts).filter(([name]) => name !== key));
  }

  private put(plan: Plan): void {
    this.plan = plan;
    this.steps += 1;
    this.version += 1;
    this.keep();
    this.check();
  }

  private keep(): void {
    if (this.plan) this.kept.keep({ plan: this.plan, texts: this.texts });
  }

  /** Lets the station check the plan, once it has rested for a moment. */
  check(): void {
    clearTimeout(this.timer);
    this.checking = true;
    this.timer = setTimeout(() => void this.checkNow(), CHECK_AFTER_MS);
  }

  private async checkNow(): Promise<void> {
    if (this.isAsking) {
      this.again = true; // one question at a time: a slow station is not asked faster than it answers
      return;
    }
    this.asked += 1;
    const number = this.asked;
    this.isAsking = true;
    this.again = false;
    try {
      const answer = await api.post<{ problems: PlanProblem[]; warnings: string[] }>('/plans/validate', {
        vehicle: this.vehicle,
        plan: this.plan,
      });
      if (number === this.asked && !this.again) {
        this.told = answer.problems;
        this.warnings = answer.warnings;
        this.unchecked = '';
      }
    } catch (error) {
      if (number === this.asked) {
        this.unchecked = sentence(error).replace(/\.$/, '');
        this.timer = setTimeout(() => void this.checkNow(), CHECK_AGAIN_MS);
      }
    }
    this.isAsking = false;
    if (number !== this.asked) return;
    if (this.again) this.check();
    else this.checking = false;
  }

  stop(): void {
    clearTimeout(this.timer);
    this.asked += 1;
  }
}

/** The sentence of a problem without the key that stands beside it anyway. */
export function plain(problem: PlanProblem): string {
  const { key, reason } = problem;
  if (!key || !reason.startsWith(key)) return reason;
  return reason.slice(key.length).replace(/^ = [^:]+/, '').replace(/^: ?/, '');
}
