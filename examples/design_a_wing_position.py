"""Where should the wing sit? Stability against control authority, as in section 3.2 of Fan et al. (2013)."""

import stommel

zju = stommel.load_vehicle("zju")
locus = stommel.root_locus(zju, "wing_position", 0.0, 0.2, points=5, speed_m_s=0.4, pitch_deg=-35.0)

print("wing aft of the centre of buoyancy   short period: damping ratio   pitch per moving mass")
for position, eigenvalues, authority in zip(locus.values, locus.longitudinal, locus.authorities, strict=True):
    oscillation = next(value for value in eigenvalues if value.imag > 0)
    damping = -oscillation.real / abs(oscillation)
    print(f"{position:18.2f} hull lengths {damping:28.3f} {authority.pitch_deg_per_mm:23.4f} deg/mm")
