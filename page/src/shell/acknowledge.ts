// Says to the station that somebody has seen an alarm.

import { api, sentence } from '../lib/api';
import { done, problem } from '../lib/notices.svelte';
import type { AlarmBrief } from '../lib/types';

export async function acknowledge(alarm: AlarmBrief): Promise<void> {
  try {
    await api.post(`/alarms/${alarm.id}/acknowledge`, { note: '' });
    done(`Acknowledged: ${alarm.words}.`);
  } catch (error) {
    problem(sentence(error));
  }
}
