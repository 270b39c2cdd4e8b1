// Where the states of the executive stand in the diagram, and the arrows between them. Pure.

export interface Node {
  name: string;
  x: number;
  y: number;
}

export interface Edge {
  from: string;
  to: string;
  when: string;
  path: string;
}

export const WIDTH = 90;
export const HEIGHT = 26;

/** Places of the states that the vehicle's software has; others find room below. */
const PLACES: Record<string, [number, number]> = {
  'start-up': [47, 20],
  hold: [180, 20],
  communicate: [47, 96],
  mission: [180, 96],
  ascend: [313, 96],
  recover: [47, 172],
  abort: [313, 172],
};

export function placed(names: string[]): Node[] {
  let others = 0;
  return names.map((name) => {
    const place = PLACES[name];
    if (place) return { name, x: place[0], y: place[1] };
    others += 1;
    return { name, x: 47 + ((others - 1) % 3) * 133, y: 240 + Math.floor((others - 1) / 3) * 50 };
  });
}

/** Where the straight line from a node's middle to another point leaves its box. */
function border(node: Node, x: number, y: number): [number, number] {
  const [dx, dy] = [x - node.x, y - node.y];
  const share = Math.min(
    dx === 0 ? Infinity : (WIDTH / 2 + 2) / Math.abs(dx),
    dy === 0 ? Infinity : (HEIGHT / 2 + 2) / Math.abs(dy),
  );
  return [node.x + dx * share, node.y + dy * share];
}

export function edges(nodes: Node[], transitions: readonly [string, string, string][]): Edge[] {
  const byName = new Map(nodes.map((node) => [node.name, node]));
  const whens = new Map<string, { from: Node; to: Node; when: string[] }>();
  for (const [from, to, when] of transitions) {
    const [a, b] = [byName.get(from), byName.get(to)];
    if (!a || !b || a === b) continue;
    const key = `${from}>${to}`;
    const known = whens.get(key);
    if (known) known.when.push(when);
    else whens.set(key, { from: a, to: b, when: [when] });
  }
  return [...whens.values()].map(({ from, to, when }) => {
    const back = whens.has(`${to.name}>${from.name}`);
    const far = Math.hypot(to.x - from.x, to.y - from.y);
    const bend = back ? 14 : far > 200 && to.y === from.y && from.y === PLACES['mission']?.[1] ? 66 : 0;
    const [mx, my] = [(from.x + to.x) / 2, (from.y + to.y) / 2];
    const [cx, cy] = [mx - ((to.y - from.y) / far) * bend, my + ((to.x - from.x) / far) * bend];
    const [sx, sy] = border(from, cx, cy);
    const [ex, ey] = border(to, cx, cy);
    const n = (value: number): string => value.toFixed(1);
    return {
      from: from.name,
      to: to.name,
      when: when.filter(Boolean).join(', or '),
      path: `M${n(sx)} ${n(sy)}Q${n(cx)} ${n(cy)} ${n(ex)} ${n(ey)}`,
    };
  });
}
