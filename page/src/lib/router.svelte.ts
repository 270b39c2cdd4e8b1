// The address after the # says which view is open: #/vehicle/1/plots?begin=...

export interface Route {
  /** Name of the view: "fleet", "vehicle", "plots", ... */
  view: string;
  /** Number of the vehicle, where the address has one. */
  vehicle: number | undefined;
  rest: string[];
  query: Record<string, string>;
}

export function parse(hash: string): Route {
  const [path = '', search = ''] = hash.replace(/^#\/?/, '').split('?', 2);
  const parts = path.split('/').filter(Boolean).map(decoded);
  const query = Object.fromEntries(new URLSearchParams(search));
  if (parts[0] === 'vehicle') {
    const vehicle = Number(parts[1]);
    const known = Number.isInteger(vehicle) && vehicle >= 1 && vehicle <= 250;
    return { view: parts[2] ?? 'vehicle', vehicle: known ? vehicle : undefined, rest: parts.slice(3), query };
  }
  return { view: parts[0] ?? 'fleet', vehicle: undefined, rest: parts.slice(1), query };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/** Address of a view: link('plots', 1) is #/vehicle/1/plots. */
export function link(view: string, vehicle?: number, query: Record<string, string | number> = {}): string {
  const path = vehicle === undefined ? view : view === 'vehicle' ? `vehicle/${vehicle}` : `vehicle/${vehicle}/${view}`;
  const pairs = Object.entries(query).map(([key, value]): [string, string] => [key, String(value)]);
  const text = new URLSearchParams(pairs).toString();
  return `#/${path}${text ? `?${text}` : ''}`;
}

class Router {
  route = $state.raw<Route>(parse(location.hash));
  /** The vehicle that was looked at last, so that the way back from the fleet is one key. */
  lastVehicle = $state<number | undefined>(parse(location.hash).vehicle);

  start(): void {
    window.addEventListener('hashchange', this.changed);
    this.changed();
  }

  stop(): void {
    window.removeEventListener('hashchange', this.changed);
  }

  go(view: string, vehicle?: number, query: Record<string, string | number> = {}): void {
    location.hash = link(view, vehicle, query);
  }

  /** Changes the query of the present address without a step in the history. */
  setQuery(query: Record<string, string | number>): void {
    const address = link(this.route.view, this.route.vehicle, query);
    history.replaceState(null, '', address);
    this.changed();
  }

  private changed = (): void => {
    const route = parse(location.hash);
    this.route = route;
    if (route.vehicle !== undefined) this.lastVehicle = route.vehicle;
  };
}

export const router = new Router();
