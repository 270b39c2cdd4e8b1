// Oracles: a hull whose file counts from the centre of buoyancy forward, and a machine of three states.
import { expect, it } from 'vitest';
import { edges, placed } from './machine';
import { behindBow } from './scene';

it('turns a hull that counts forward into distances behind the bow', () => {
  expect(behindBow([[-1, 0.02], [0.5, 0.1], [0.75, 0]])).toEqual([
    [0, 0],
    [0.25, 0.1],
    [1.75, 0.02],
  ]);
});

it('draws one arrow for each pair of states and joins its reasons', () => {
  const nodes = placed(['hold', 'mission', 'a state of tomorrow']);
  const found = edges(nodes, [
    ['hold', 'mission', 'told to start'],
    ['hold', 'mission', 'the time has come'],
    ['mission', 'hold', ''],
    ['hold', 'nowhere', 'not drawn'],
  ]);
  expect(found.map((edge) => [edge.from, edge.to, edge.when])).toEqual([
    ['hold', 'mission', 'told to start, or the time has come'],
    ['mission', 'hold', ''],
  ]);
  expect(nodes[2]?.y).toBeGreaterThan(200);
});
