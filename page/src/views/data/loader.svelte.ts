// An answer that is asked for again whenever its question changes; an answer to an older question is thrown away.

import { api, sentence, type Query } from '../../lib/api';

export class Loader<T> {
  answer = $state.raw<T>();
  failure = $state<string>();
  isBusy = $state(false);
  #controller: AbortController | undefined;

  /** For an $effect, which cancels it by the function that comes back. */
  ask(path: string, query: Query = {}): () => void {
    const controller = new AbortController();
    this.#controller = controller;
    this.isBusy = true;
    api
      .get<T>(path, query, controller.signal)
      .then((answer) => {
        if (controller !== this.#controller) return;
        this.answer = answer;
        this.failure = undefined;
      })
      .catch((error: unknown) => {
        if (controller.signal.aborted || controller !== this.#controller) return;
        this.answer = undefined;
        this.failure = sentence(error);
      })
      .finally(() => {
        if (controller === this.#controller) this.isBusy = false;
      });
    return () => controller.abort();
  }
}
