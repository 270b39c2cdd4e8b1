"""Fly the equations of motion themselves: launch from rest, and settle into the trimmed glide."""

import numpy as np

import stommel
from stommel.dynamics.acceleration import state_of, velocities_of
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.integration import integrate
from stommel.dynamics.packing import pack, reference_water
from stommel.dynamics.state import Actuation
from stommel.geometry.attitude import euler_from_quaternion, quaternion_from_euler

zju = stommel.load_vehicle("zju")
flight = stommel.trim(zju, speed_m_s=0.4, pitch_deg=-35.0, physics=stommel.FULL)
record, water, locked = pack(zju, stommel.FULL), reference_water(zju), Actuation()

rest, level = (0.0, 0.0, 0.0), quaternion_from_euler(0.0, 0.0, 0.0)
start = state_of(record, rest, rest, rest, level, flight.r_px, flight.V_b, locked, water)
x = np.array([*start.X, *start.Q, *start.p, *start.h, start.r_px, start.p_px, start.V_b])

states = np.empty((10, 16))
integrate(record, x, locked, water, False, 0.05, 6000, states)
for k, state in enumerate(states):
    moving = velocities_of(record, state_from_array(state), locked, water, False)
    pitch = np.degrees(euler_from_quaternion(tuple(state[3:7]))[1])
    speed = np.linalg.norm(moving.v)
    print(f"{30 * (k + 1):4d} s  depth {state[2]:7.2f} m  pitch {pitch:7.2f} deg  speed {speed:.4f} m/s")
