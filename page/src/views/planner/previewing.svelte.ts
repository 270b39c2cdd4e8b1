/** Asks the station's simulator to fly a plan, and follows it until it has. */

import { api, ApiError, sentence } from '../../lib/api';
import { isOver, type Job, type PreviewResult } from './jobs';
import type { Plan } from './plan';

const EVERY_MS = 400;

export class Previewing {
  readonly vehicle: number;
  job = $state.raw<Job | null>(null);
  result = $state.raw<PreviewResult | null>(null);
  /** Name of the job whose result it is. */
  resultJob = '';
  reason = $state('');
  /** Of the desk, when the preview was asked for. */
  private version = $state(-1);
  private timer: ReturnType<typeof setTimeout> | undefined;
  private count = 0;

  constructor(vehicle: number) {
    this.vehicle = vehicle;
  }

  get isRunning(): boolean {
    return this.job !== null && !isOver(this.job);
  }

  /** Whether what is shown belongs to another state of the plan. */
  isOld(version: number): boolean {
    return this.result !== null && version !== this.version;
  }

  async start(plan: Plan, version: number): Promise<void> {
    this.stop();
    this.count += 1;
    const number = this.count;
    this.reason = '';
    try {
      const { job } = await api.post<{ job: string }>('/plans/preview', { vehicle: this.vehicle, plan });
      if (number !== this.count) {
        void api.delete(`/jobs/${job}`).catch(() => undefined);
        return;
      }
      this.job = { job, share: 0, state: 'waiting', seconds_left: null, result: null, error: null };
      await this.follow(job, number, version);
    } catch (error) {
      if (number !== this.count) return;
      this.job = null;
      this.reason = sentence(error);
    }
  }

  private async follow(name: string, number: number, version: number): Promise<void> {
    try {
      const job = await api.get<Job>(`/jobs/${name}`);
      if (number !== this.count) return;
      this.job = job;
      if (job.state === 'done' && job.result) {
        this.result = job.result;
        this.resultJob = job.job;
        this.version = version;
      } else if (job.state === 'failed') this.reason = job.error?.reason ?? 'The simulator did not say why it failed.';
      if (isOver(job)) return;
    } catch (error) {
      if (number !== this.count) return;
      // out of reach: the job goes on there, and is asked for again
      if (!(error instanceof ApiError) || error.status !== 0) throw error;
    }
    this.timer = setTimeout(() => {
      this.follow(name, number, version).catch((error: unknown) => {
        this.job = null;
        this.reason = sentence(error);
      });
    }, EVERY_MS);
  }

  /** The person does not want it any more. */
  cancel(): void {
    const job = this.job;
    this.count += 1;
    clearTimeout(this.timer);
    this.job = null;
    if (job && !isOver(job)) void api.delete(`/jobs/${job.job}`).catch(() => undefined);
  }

  /** Another plan lies on the desk. */
  forget(): void {
    this.cancel();
    this.result = null;
    this.reason = '';
  }

  stop(): void {
    this.cancel();
  }
}
