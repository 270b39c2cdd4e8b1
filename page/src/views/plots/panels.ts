// What is drawn together: the panels of the motion (as Fig. 17 of Fan et al. 2013), of the machinery and of the energy.

import type { Channel } from '../../lib/types';

export interface Panel {
  readonly id: string;
  readonly title: string;
  readonly channels: readonly string[];
  /** Depth grows downwards. */
  readonly isDepth?: boolean;
}

export interface PanelGroup {
  readonly id: string;
  readonly words: string;
  readonly panels: readonly Panel[];
}

export const GROUPS: readonly PanelGroup[] = [
  {
    id: 'motion',
    words: 'Motion',
    panels: [
      { id: 'bladder', title: 'Bladder volume', channels: ['ballast_ml', 'ballast_setpoint_ml'] },
      { id: 'attitude', title: 'Attitude', channels: ['pitch_deg', 'roll_deg'] },
      { id: 'heading', title: 'Heading', channels: ['heading_deg'] },
      { id: 'path', title: 'Path', channels: ['depth_m'], isDepth: true },
    ],
  },
  {
    id: 'actuators',
    words: 'Actuators',
    panels: [
      { id: 'mass', title: 'Moving mass', channels: ['moving_mass_mm', 'moving_mass_setpoint_mm'] },
      { id: 'steering', title: 'Steering', channels: ['steering_deg', 'steering_setpoint_deg'] },
      { id: 'drives', title: 'Currents of the drives', channels: ['pump_current_a', 'mass_current_a'] },
      { id: 'switches', title: 'Pump and valve', channels: ['pump_running', 'valve_open'] },
      { id: 'depth', title: 'Depth', channels: ['depth_m'], isDepth: true },
    ],
  },
  {
    id: 'energy',
    words: 'Energy',
    panels: [
      { id: 'voltage', title: 'Voltage', channels: ['voltage_v'] },
      { id: 'current', title: 'Current', channels: ['battery_current_a'] },
      { id: 'energy', title: 'Energy', channels: ['energy_used_kj', 'energy_left_kj'] },
      { id: 'warmth', title: 'Battery temperature', channels: ['battery_temperature_degc'] },
    ],
  },
  {
    id: 'way',
    words: 'Way',
    panels: [
      { id: 'speed', title: 'Speed', channels: ['speed_through_water_m_s', 'speed_over_ground_m_s', 'climb_m_s'] },
      { id: 'stream', title: 'Current of the water', channels: ['current_north_m_s', 'current_east_m_s'] },
      { id: 'waypoint', title: 'Distance to the waypoint', channels: ['waypoint_distance_m'] },
      { id: 'doubt', title: 'Standard deviation of the position', channels: ['position_sigma_m'] },
    ],
  },
];

const CHOICE_LIMIT = 24;

/** Panels of own choice: channels of one unit share a panel, in the order in which they were chosen. */
export function ownPanels(keys: readonly string[], channels: ReadonlyMap<string, Channel>): Panel[] {
  const byUnit = new Map<string, string[]>();
  for (const key of keys.slice(0, CHOICE_LIMIT)) {
    const channel = channels.get(key);
    if (!channel) continue;
    const place = isDepthLike(channel) ? 'depth' : channel.unit || (isSwitch(channel) ? 'switch' : key);
    byUnit.set(place, [...(byUnit.get(place) ?? []), key]);
  }
  return [...byUnit.entries()].map(([place, those]) => ({
    id: `own-${place}`,
    title: titleOf(those, channels),
    channels: those,
    isDepth: place === 'depth',
  }));
}

function titleOf(keys: readonly string[], channels: ReadonlyMap<string, Channel>): string {
  const [first] = keys.map((key) => channels.get(key));
  if (keys.length === 1) return capital(first?.words ?? '');
  return first?.unit ? `${keys.length} channels in ${first.unit}` : `${keys.length} channels`;
}

const capital = (words: string): string => words.slice(0, 1).toUpperCase() + words.slice(1);

export function isDepthLike(channel: Channel): boolean {
  return channel.key.startsWith('depth') || channel.standard_name === 'depth';
}

/** The panels of a group that have at least one channel this vehicle knows, each with those channels only. */
export function known(group: PanelGroup, channels: ReadonlyMap<string, Channel>): Panel[] {
  return group.panels
    .map((panel) => ({ ...panel, channels: panel.channels.filter((key) => channels.has(key)) }))
    .filter((panel) => panel.channels.length > 0);
}

/** The channels of some panels, each once. */
export function keysOf(panels: readonly Panel[]): string[] {
  return [...new Set(panels.flatMap((panel) => panel.channels))];
}

/** Whether a channel is on or off. */
export function isSwitch(channel: Channel): boolean {
  return channel.unit === '' && !channel.values && channel.low === 0 && channel.high === 1 && !channel.key.endsWith('_share');
}

/** Whether a channel stays as it is until it changes, so that it is drawn in steps. */
export function isStepped(channel: Channel): boolean {
  return isSwitch(channel) || (channel.values !== undefined && channel.values !== null && Object.keys(channel.values).length > 0);
}
