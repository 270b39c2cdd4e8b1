"""Where should the wing sit? Damping against control authority, as in section 3.2 of Fan et al. (2013).

A wing farther aft damps the pitch better, and moving mass and rudder are answered more sluggishly. The pitch that a
millimetre of travel gives in the end is the same wherever the wing is: a balance of weights, printed to show it.
"""

import stommel

zju = stommel.load_vehicle("zju")
locus = stommel.root_locus(zju, "wing_position", 0.0, 0.2, points=5, speed_m_s=0.4, pitch_deg=-35.0)

print("wing aft of     short period:   peak pitch rate   turn per     pitch in the end")
print("centre [hulls]  damping ratio   [deg/s per mm]    rudder [1/s] [deg per mm]")
for position, eigenvalues, authority in zip(locus.values, locus.longitudinal, locus.authorities, strict=True):
    oscillation = next(value for value in eigenvalues if value.imag > 0)
    damping = -oscillation.real / abs(oscillation)
    answers = f"{authority.peak_pitch_rate_deg_s_per_mm:15.4f} {authority.turn_rate_deg_s_per_rudder_deg:15.4f}"
    print(f"{position:14.2f} {damping:14.3f} {answers} {authority.pitch_deg_per_mm:16.4f}")
