// Whether the first five minutes are shown, and where they are. A station that is a demonstration shows them by itself;
// a browser that has seen them is left alone.

const KEY = 'stommel-tour';

function seen(): boolean {
  try {
    return localStorage.getItem(KEY) === 'done';
  } catch {
    return true;
  }
}

class TourState {
  step = $state<number | undefined>(undefined);
}

export const tour = new TourState();

/** Show it by itself, to a browser that has not seen it. */
export function offerTour(): void {
  if (!seen()) tour.step ??= 0;
}

export function startTour(): void {
  tour.step = 0;
}

export function endTour(): void {
  tour.step = undefined;
  try {
    localStorage.setItem(KEY, 'done');
  } catch {
    // Storage is switched off: it is shown again next time.
  }
}
