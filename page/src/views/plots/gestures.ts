// Wheel, pointer and fingers on a plot, in words of its window: pan by a share of the span, zoom about a time.

export interface Moves {
  pan(share: number): void;
  zoom(factor: number, shareOfWidth: number): void;
}

const STEP_PER_PIXEL = 0.0022;
const GREATEST_STEP = 0.5;

/** Attaches to the drawing area of a plot; the function that comes back detaches again. */
export function attach(area: HTMLElement, moves: Moves): () => void {
  const detachers = [wheel(area, moves), drag(area, moves)];
  area.style.touchAction = 'pan-y';
  return () => detachers.forEach((detach) => detach());
}

function wheel(area: HTMLElement, moves: Moves): () => void {
  const onWheel = (event: WheelEvent): void => {
    event.preventDefault();
    const box = area.getBoundingClientRect();
    if (box.width === 0) return;
    const scale = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    const across = (event.shiftKey && event.deltaX === 0 ? event.deltaY : event.deltaX) * scale;
    const along = event.shiftKey ? 0 : event.deltaY * scale;
    if (Math.abs(across) > Math.abs(along)) {
      moves.pan(across / box.width);
    } else {
      const step = Math.max(-GREATEST_STEP, Math.min(GREATEST_STEP, along * STEP_PER_PIXEL));
      moves.zoom(Math.exp(step), (event.clientX - box.left) / box.width);
    }
  };
  area.addEventListener('wheel', onWheel, { passive: false });
  return () => area.removeEventListener('wheel', onWheel);
}

/** Shift or the middle button moves the window; one finger moves it, two zoom it. */
function drag(area: HTMLElement, moves: Moves): () => void {
  const fingers = new Map<number, number>();

  const onDown = (event: PointerEvent): void => {
    const moving = event.pointerType === 'mouse' ? event.button === 1 || (event.button === 0 && event.shiftKey) : true;
    if (!moving) return;
    fingers.set(event.pointerId, event.clientX);
    area.setPointerCapture(event.pointerId);
    event.preventDefault();
  };
  const onMove = (event: PointerEvent): void => {
    const before = fingers.get(event.pointerId);
    if (before === undefined) return;
    const box = area.getBoundingClientRect();
    if (box.width === 0) return;
    if (fingers.size === 1) {
      moves.pan((before - event.clientX) / box.width);
    } else {
      const other = [...fingers.entries()].find(([id]) => id !== event.pointerId)?.[1] ?? before;
      const factor = Math.abs(before - other) / Math.max(20, Math.abs(event.clientX - other));
      if (Number.isFinite(factor) && factor > 0) moves.zoom(factor, (other - box.left) / box.width);
    }
    fingers.set(event.pointerId, event.clientX);
  };
  const onUp = (event: PointerEvent): void => {
    fingers.delete(event.pointerId);
  };
  // The plot selects by mouse events; a drag that moves the window must not reach it.
  const onMouseDown = (event: MouseEvent): void => {
    if (event.shiftKey || event.button === 1) event.stopImmediatePropagation();
  };
  const pairs: [string, (event: never) => void, boolean][] = [
    ['pointerdown', onDown, false], ['pointermove', onMove, false], ['pointerup', onUp, false],
    ['pointercancel', onUp, false], ['mousedown', onMouseDown, true],
  ];
  pairs.forEach(([name, handler, capture]) => area.addEventListener(name, handler as EventListener, capture));
  return () => pairs.forEach(([name, handler, capture]) => area.removeEventListener(name, handler as EventListener, capture));
}
