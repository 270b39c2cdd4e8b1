"""A pitch controller on the linearised glider: from trim to python-control in a few lines."""

import control
import numpy as np

import stommel

zju = stommel.load_vehicle("zju")
flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0)
plant = stommel.linearise(zju, flight).longitudinal.to_control()

# linear-quadratic regulator on the moving mass alone: a degree of pitch is worth a centimetre of travel
weights = np.diag([0.0, 0.0, 0.0, 1.0 / np.radians(1.0) ** 2])
gain, _, closed = control.lqr(plant.A, plant.B[:, :1], weights, [[1.0 / 0.01**2]])

print("open loop poles  ", np.round(np.sort_complex(plant.poles()), 3))
print("closed loop poles", np.round(np.sort_complex(closed), 3))
print("moving mass [m] per state (u, w, q, theta)", np.round(gain, 3))
