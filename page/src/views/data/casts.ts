// The samples of each profile from the surface down: what a cursor goes over in profiles and in a T-S diagram.

export interface Cast {
  readonly profile: number;
  /** Indices of its samples. */
  readonly samples: readonly number[];
  readonly depth: readonly number[];
}

/** Of those samples that have a depth. */
export function castOf(profile: number, samples: readonly number[], depth: readonly (number | null)[]): Cast {
  const known = samples.flatMap((sample): [number, number][] => {
    const at = depth[sample];
    return typeof at === 'number' ? [[sample, at]] : [];
  });
  known.sort((a, b) => a[1] - b[1]);
  return { profile, samples: known.map(([sample]) => sample), depth: known.map(([, at]) => at) };
}

/** Samples by the profile that each is of, in the order of their numbers; 0 is between profiles. */
export function castsOf(profiles: readonly number[], depth: readonly (number | null)[]): Cast[] {
  const found = new Map<number, number[]>();
  profiles.forEach((profile, sample) => {
    const those = found.get(profile);
    if (those) those.push(sample);
    else found.set(profile, [sample]);
  });
  return [...found].sort((a, b) => a[0] - b[0]).map(([profile, samples]) => castOf(profile, samples, depth));
}
