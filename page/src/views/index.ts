// Every view of the page: its name in the address, its title, the key after g, and how its code is fetched.

import type { Component } from 'svelte';
import type { Role } from '../lib/types';

interface Common {
  name: string;
  title: string;
  key: string;
  /** Least role that may open it; "viewer" where nothing is said. */
  role?: Role;
}

export interface VehicleView extends Common {
  of: 'vehicle';
  load: () => Promise<{ default: Component<{ vehicle: number }> }>;
}

export interface StationView extends Common {
  of: 'station';
  load: () => Promise<{ default: Component }>;
}

export type View = VehicleView | StationView;

export const views: readonly View[] = [
  { name: 'fleet', title: 'Fleet', key: 'f', of: 'station', load: () => import('./fleet/Fleet.svelte') },
  { name: 'map', title: 'Map', key: 'm', of: 'station', load: () => import('./map/MapView.svelte') },
  { name: 'all-alarms', title: 'All alarms', key: 'w', of: 'station', load: () => import('./alarms/AllAlarms.svelte') },
  { name: 'people', title: 'People', key: 'u', role: 'viewer', of: 'station', load: () => import('./people/People.svelte') },
  { name: 'vehicle', title: 'Overview', key: 'v', of: 'vehicle', load: () => import('./vehicle/Vehicle.svelte') },
  { name: 'plots', title: 'Plots', key: 'p', of: 'vehicle', load: () => import('./plots/Plots.svelte') },
  { name: 'data', title: 'Data', key: 'd', of: 'vehicle', load: () => import('./data/Data.svelte') },
  { name: 'commands', title: 'Commands', key: 'c', of: 'vehicle', load: () => import('./commands/Commands.svelte') },
  { name: 'parameters', title: 'Parameters', key: 'e', of: 'vehicle', load: () => import('./parameters/Parameters.svelte') },
  { name: 'plan', title: 'Plan', key: 'n', of: 'vehicle', load: () => import('./planner/Planner.svelte') },
  { name: 'link', title: 'Link', key: 'l', of: 'vehicle', load: () => import('./link/Link.svelte') },
  { name: 'files', title: 'Files', key: 'i', of: 'vehicle', load: () => import('./files/Files.svelte') },
  { name: 'alarms', title: 'Alarms', key: 'a', of: 'vehicle', load: () => import('./alarms/Alarms.svelte') },
  { name: 'replay', title: 'Replay', key: 'r', of: 'vehicle', load: () => import('./replay/Replay.svelte') },
  { name: 'log', title: 'Log', key: 'o', of: 'vehicle', load: () => import('./log/Log.svelte') },
];

export function viewNamed(name: string): View | undefined {
  return views.find((view) => view.name === name);
}
