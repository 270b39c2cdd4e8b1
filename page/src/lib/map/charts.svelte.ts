// The station's own chart layers, and which of them are hidden: one choice for all maps.

import { chartLayers } from './content.svelte';
import type { MapLayer } from './types';

class Charts {
  layers = $state.raw<MapLayer[]>([]);
  private hidden = $state.raw<ReadonlySet<number | string>>(new Set());
  private loads = 0;

  /** Those to be drawn. */
  get shown(): MapLayer[] {
    return this.layers.filter((layer) => !this.hidden.has(layer.id));
  }

  isHidden(id: number | string): boolean {
    return this.hidden.has(id);
  }

  toggle(id: number | string): void {
    const next = new Set(this.hidden);
    if (!next.delete(id)) next.add(id);
    this.hidden = next;
  }

  /** Asks the station for them: when a map opens, and when somebody has changed them. */
  async load(): Promise<void> {
    const load = ++this.loads;
    const found = await chartLayers();
    if (load === this.loads) this.layers = found;
  }
}

export const charts = new Charts();
