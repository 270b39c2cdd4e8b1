"""Close the pitch loop of the nonlinear vehicle with a controller from python-control.

The vehicle is told to dive at 35 deg. Our controller wants 25 deg instead, and gets it by feedback alone: an integrator
on the moving mass, designed on the linear model and checked in the z plane before it flies.
"""

from pathlib import Path

import control
import numpy as np

import stommel
from stommel.control.decision import decide
from stommel.control.dive_cycle import DESCENT
from stommel.simulation.scenario.loading import mission_from

PERIOD = 30.0  # [s] between two corrections; the pump and the pitch settle in between
WANTED = np.radians(-25.0)

# the linear model of the dive, sampled at the period of the controller
zju = stommel.load_vehicle("zju")
flight = stommel.trim(zju, speed_m_s=0.35, pitch_deg=-25.0, physics=stommel.FULL)
model = stommel.linearise(zju, flight, physics=stommel.FULL).longitudinal.to_control()
to_pitch = control.ss(model.A, model.B[:, :1], [[0.0, 0.0, 0.0, 1.0]], [[0.0]])
sampled = control.sample_system(to_pitch, PERIOD)
gain = 0.4 / float(np.real(sampled.dcgain()))
integrator = control.tf2ss(control.tf([gain, 0.0], [1.0, -1.0], PERIOD))
poles = control.feedback(sampled * integrator, 1.0).poles()
print("greatest pole in the z plane", round(float(np.abs(poles).max()), 3))


class OuterLoop:
    """The vehicle's own decision, with the moving mass corrected in dives."""

    def __init__(self) -> None:
        self.state, self.correction, self.next = np.zeros((1, 1)), 0.0, 0.0

    def __call__(self, memory, orders, readings, t):
        """Decide once; the signature is that of `stommel.control.decision.decide`."""
        commands = decide(memory, orders, readings, t)
        if memory.phase != DESCENT or t - memory.since < PERIOD:
            return commands
        if t >= self.next:
            error = WANTED - readings.theta
            self.correction = (integrator.C @ self.state + integrator.D * error).item()
            self.state = integrator.A @ self.state + integrator.B * error
            self.next = t + PERIOD
        return commands._replace(r_px=commands.r_px + self.correction)


mission = mission_from(
    {
        "name": "a dive at our own pitch",
        "vehicle": "zju",
        "start_time": "2026-07-01T00:00:00Z",
        "duration_days": 0.05,
        "output_every_s": 1.0,
        "start": {"latitude_deg": 18.0, "longitude_deg": 116.0},
        "waypoints": [{"latitude_deg": 19.0, "longitude_deg": 116.0}],
        "dives": {"depth_m": 150.0, "pitch_deg": 35.0, "speed_m_s": 0.35},
        "pitch_control": {"gain_mm_per_deg": 0.0},
        "ocean": {"name": "south_china_sea"},
    },
    "example",
    Path(),
)
flown = stommel.fly_mission(mission, controller=OuterLoop())
turn = flown.events["time"][1]  # the first event begins the dive, the second ends it
dive = flown.record[(flown.record["phase"] == DESCENT) & (flown.record["time"] < turn)]
for share in (0.2, 0.5, 0.9):
    row = dive[int(share * len(dive))]
    print(f"depth {row['depth']:5.1f} m   pitch {np.degrees(row['pitch']):6.2f} deg")
