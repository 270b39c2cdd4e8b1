/** Plans to begin with, and the station's description of what may stand in a plan. */

import { api } from '../../lib/api';
import { sectionsOf, type PlanSection, type ToldField } from './fields';
import type { Plan } from './plan';

export interface Template {
  name: string;
  words: string;
  plan: Plan;
}

interface Answer {
  templates: Template[];
  fields: ToldField[];
  vehicles: string[];
}

export interface Templates {
  templates: Template[];
  sections: PlanSection[];
  vehicles: string[];
}

/** For a vehicle, at the place where it is. */
export async function templatesFor(vehicle: number): Promise<Templates> {
  const answer = await api.get<Answer>('/plan-templates', { vehicle });
  return { templates: answer.templates, sections: sectionsOf(answer.fields), vehicles: answer.vehicles };
}
