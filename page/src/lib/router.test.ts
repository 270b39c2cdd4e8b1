// Oracle: the addresses that the contract of the page names.
import { expect, it, vi } from 'vitest';

vi.stubGlobal('location', { hash: '' });
const { link, parse } = await import('./router.svelte');

it('reads addresses', () => {
  expect(parse('')).toEqual({ view: 'fleet', vehicle: undefined, rest: [], query: {} });
  expect(parse('#/vehicle/1')).toMatchObject({ view: 'vehicle', vehicle: 1 });
  expect(parse('#/vehicle/1/plots?begin=3&end=4')).toMatchObject({ view: 'plots', vehicle: 1, query: { begin: '3', end: '4' } });
  expect(parse('#/vehicle/251/plots').vehicle).toBeUndefined();
  expect(parse('#/vehicle/1.5').vehicle).toBeUndefined();
  expect(parse('#/%E0%A4%A').view).toBe('%E0%A4%A');
});

it('writes the addresses that it reads', () => {
  for (const [view, vehicle] of [['fleet', undefined], ['vehicle', 7], ['plan', 250]] as const) {
    expect(parse(link(view, vehicle, { a: 'b&c' }))).toMatchObject({ view, vehicle, query: { a: 'b&c' } });
  }
});
