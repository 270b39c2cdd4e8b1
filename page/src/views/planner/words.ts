/** Keys of a plan in words of people. */

import type { PlanSection } from './fields';

/** "Dives, depth" for "dives.depth_m"; "Waypoint 3" for "waypoints.2". */
export function placeWords(key: string, sections: PlanSection[]): string {
  if (key === '') return 'The plan';
  const waypoint = /^waypoints\.(\d+)(?:\.(\w+))?/.exec(key);
  if (waypoint) return `Waypoint ${Number(waypoint[1]) + 1}${axis(waypoint[2])}`;
  if (key === 'geofence') return 'Geofence';
  const corner = /^geofence\.(\d+)(?:\.(\w+))?/.exec(key);
  if (corner) return `Corner ${Number(corner[1]) + 1} of the fence${axis(corner[2])}`;
  if (/^start\b(?!_)/.test(key)) return `Start${axis(key.split('.')[1])}`;
  for (const section of sections) {
    if (section.key === key) return section.title;
    const field = section.fields.find((each) => each.key === key);
    if (field) return section.key === '' ? field.label : `${section.title}, ${lower(field.label)}`;
  }
  const plain = key.replaceAll('_', ' ').replaceAll('.', ', ');
  return plain.charAt(0).toUpperCase() + plain.slice(1);
}

function axis(name: string | undefined): string {
  return name ? `, ${name.replace('_deg', '')}` : '';
}

function lower(label: string): string {
  return /^[A-Z]{2}/.test(label) ? label : label.charAt(0).toLowerCase() + label.slice(1);
}
