/** The station's own description of a plan: ranges, defaults and choices, as JSON Schema. */

import { api } from '../../lib/api';
import type { Schema } from './fields';

let known: [Schema, Record<string, Schema>] | undefined;

/** The description, and the tables that it refers to; asked for once. */
export async function schemaOf(): Promise<[Schema, Record<string, Schema>]> {
  if (!known) {
    const schema = await api.get<Schema>('/plan-schema');
    known = [schema, schema.$defs ?? {}];
  }
  return known;
}
