// One meaning of how far a position may be wrong, for the ring on maps and for ± everywhere.

/** Of a place whose error along each direction is normal: with 95 % it lies within so many standard deviations. */
const DEVIATIONS = Math.sqrt(-2 * Math.log(0.05));

export const SURE_WORDS = 'ring and ±: it lies within, 95 % sure';

/** Radius within which a vehicle lies with 95 %, m; null where it is not known how sure its position is. */
export function sure(sigma_m: number | null | undefined): number | null {
  return sigma_m === null || sigma_m === undefined ? null : DEVIATIONS * sigma_m;
}
