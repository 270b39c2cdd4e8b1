// Asks the station over HTTP. Every refusal becomes an ApiError whose message is a sentence for people.

import type { Refusal } from './types';

export class ApiError extends Error {
  readonly status: number;
  readonly refusal: Refusal;

  constructor(status: number, refusal: Refusal) {
    super(sentenceOf(refusal));
    this.name = 'ApiError';
    this.status = status;
    this.refusal = refusal;
  }
}

/** The reason, and what would be allowed unless the reason says so itself. */
function sentenceOf({ reason, allowed }: Refusal): string {
  if (!allowed || reason.includes(allowed)) return reason;
  return /[.!?]$/.test(reason) ? `${reason} Allowed: ${allowed}.` : `${reason}; allowed: ${allowed}.`;
}

export type Query = Record<string, string | number | boolean | null | undefined>;

export interface Asked {
  query?: Query;
  signal?: AbortSignal;
}

type Listener = () => void;
const whenSignedOut = new Set<Listener>();

/** Calls back when the station answers that nobody is signed in. */
export function onSignedOut(listener: Listener): () => void {
  whenSignedOut.add(listener);
  return () => whenSignedOut.delete(listener);
}

/** The address below /api, with its query; empty values are left out. */
export function address(path: string, query: Query = {}): string {
  const pairs = Object.entries(query).filter(([, value]) => value !== undefined && value !== null);
  const text = new URLSearchParams(pairs.map(([key, value]) => [key, String(value)])).toString();
  return `./api${path}${text ? `?${text}` : ''}`;
}

function refusal(status: number, body: unknown): Refusal {
  const detail = (body as { detail?: unknown } | null)?.detail;
  if (typeof detail === 'string') return { reason: detail };
  if (detail && typeof detail === 'object' && 'reason' in detail) return detail as Refusal;
  return { reason: `The station answered ${status}, without a reason.` };
}

async function read(answer: Response): Promise<unknown> {
  if (answer.status === 204) return null;
  const kind = answer.headers.get('content-type') ?? '';
  return kind.includes('json') ? answer.json() : answer.text();
}

async function ask<T>(method: string, path: string, body: unknown, asked: Asked): Promise<T> {
  const isForm = body instanceof FormData || body instanceof Blob;
  const headers: Record<string, string> = { accept: 'application/json', 'x-requested-with': 'stommel' };
  if (body !== undefined && !isForm) headers['content-type'] = 'application/json';
  const request: RequestInit = { method, headers, credentials: 'same-origin' };
  if (body !== undefined) request.body = isForm ? body : JSON.stringify(body);
  if (asked.signal) request.signal = asked.signal;
  let answer: Response;
  try {
    answer = await fetch(address(path, asked.query), request);
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    throw new ApiError(0, { reason: 'The station does not answer. The page goes on trying.' });
  }
  const content = await read(answer).catch(() => null);
  if (answer.ok) return content as T;
  if (answer.status === 401) whenSignedOut.forEach((listener) => listener());
  throw new ApiError(answer.status, refusal(answer.status, content));
}

export const api = {
  get: <T>(path: string, query: Query = {}, signal?: AbortSignal): Promise<T> =>
    ask<T>('GET', path, undefined, signal ? { query, signal } : { query }),
  post: <T>(path: string, body?: unknown, query: Query = {}): Promise<T> => ask<T>('POST', path, body ?? {}, { query }),
  put: <T>(path: string, body: unknown): Promise<T> => ask<T>('PUT', path, body, {}),
  patch: <T>(path: string, body: unknown): Promise<T> => ask<T>('PATCH', path, body, {}),
  delete: <T>(path: string, query: Query = {}): Promise<T> => ask<T>('DELETE', path, undefined, { query }),
  /** Sends a file or form as it is. */
  upload: <T>(path: string, body: FormData | Blob, query: Query = {}): Promise<T> =>
    ask<T>('POST', path, body, { query }),
};

/** The sentence of whatever went wrong. */
export function sentence(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
