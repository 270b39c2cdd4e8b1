"""Rows of the log: record, samples of the CTD, events, surfacings (compiled)."""

from stommel.compilation import inlined
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.inertia import velocities
from stommel.dynamics.state import DEPTH, R_PX, Actuation
from stommel.geometry.attitude import attitude_of
from stommel.ocean.kernel.column import water_at
from stommel.ocean.kernel.grid import BOTTOM, SALINITY, Column
from stommel.simulation.log import EVENT_ROWS, ROWS, SAMPLES, SURFACINGS
from stommel.simulation.plant.sensing import measured_internal_pressure, oil_volume


@inlined
def salinity_at(column: Column, z: float) -> float:
    """Absolute Salinity at depth `z` of a filled column [g/kg]."""
    values = column.values
    position = max(z, 0.0) / column.dz
    n = min(int(position), values.shape[0] - 2)
    share = min(position - n, 1.0)
    S: float = values[n, SALINITY] + share * (values[n + 1, SALINITY] - values[n, SALINITY])
    return S


@inlined
def hull_velocities(vehicle, x, by_mass, at_rest, done, water, step):  # type: ignore[no-untyped-def]  # compiled only
    """Velocities of the hull at the beginning of a step: what the momenta leave beside mass and oil that move in it.

    A vehicle that floats or lies on the ground is put to rest as a whole, whatever moves in it.
    """
    mu = done.steering - 0.5 * done.steering_rate * step if by_mass else 0.0
    mu_dot = done.steering_rate if by_mass and not at_rest else 0.0
    r_px_dot, u_b = (0.0, 0.0) if at_rest else (done.r_px_dot, done.u_b)
    return velocities(vehicle, state_from_array(x), Actuation(r_px_dot, 0.0, u_b, 0.0, mu, mu_dot), water, False)


@inlined
def write_row(log, t, age, x, equipment, done, step, memory, world, readings, column, noise):  # type: ignore[no-untyped-def]  # compiled only
    """Write one row of the record (`ROW`); `done` is what the actuators do from now on."""
    by_mass, sensors = equipment.plant.steering.by_mass != 0.0, equipment.sensors
    state = state_from_array(x)
    water = water_at(column, x[DEPTH], age)
    at_rest = world.afloat != 0 or x[DEPTH] >= column.place[BOTTOM]
    eta = hull_velocities(equipment.vehicle, x, by_mass, at_rest, done, water, step)
    true = attitude_of(state.Q)
    row = log.record[log.counts[ROWS]]
    log.counts[ROWS] += 1
    row.time, row.latitude, row.longitude, row.depth = t, world.latitude, world.longitude, x[DEPTH]
    row.roll, row.pitch, row.heading = true.phi, true.theta, true.psi
    row.u, row.v, row.w = eta.v_r
    row.p, row.q, row.r = eta.omega
    row.moving_mass, row.ballast = x[R_PX], oil_volume(x, world)
    row.rudder = 0.0 if by_mass else world.steering
    row.roll_mass = world.steering if by_mass else 0.0
    row.phase = memory.phase
    row.measured_pitch, row.measured_heading, row.measured_depth = readings.theta, readings.psi, readings.depth
    row.density, row.temperature, row.salinity = water.rho, water.T, salinity_at(column, x[DEPTH])
    row.current_north, row.current_east = water.U[0], water.U[1]
    row.bottom_depth = column.place[BOTTOM]
    row.reckoned_latitude, row.reckoned_longitude = memory.latitude, memory.longitude
    row.voltage = world.voltage + sensors.voltage_bias + sensors.voltage_noise * noise.standard_normal()
    row.current = world.current + sensors.current_bias + sensors.current_noise * noise.standard_normal()
    pressure = measured_internal_pressure(sensors, world)
    row.internal_pressure = pressure + sensors.internal_pressure_noise * noise.standard_normal()
    for j in range(len(world.energy)):
        row.energy[j] = world.energy[j]


@inlined
def write_sample(log, t, x, water, memory, world, column):  # type: ignore[no-untyped-def]  # compiled only
    """Write one sample of the CTD (`SAMPLE`)."""
    row = log.samples[log.counts[SAMPLES]]
    log.counts[SAMPLES] += 1
    row.time, row.latitude, row.longitude, row.pressure = t, memory.latitude, memory.longitude, water.P
    row.thermistor, row.cell = world.thermistor, water.T - world.cell_error
    row.salinity, row.phase, row.dive = salinity_at(column, x[DEPTH]), memory.phase, memory.dives


@inlined
def write_event(log, t, memory, world, depth, reason):  # type: ignore[no-untyped-def]  # compiled only
    """Write down what happened, and why (`EVENT`)."""
    if log.counts[EVENT_ROWS] < len(log.events):
        row = log.events[log.counts[EVENT_ROWS]]
        log.counts[EVENT_ROWS] += 1
        row.time, row.phase, row.reason = t, memory.phase, reason
        row.latitude, row.longitude, row.depth = world.latitude, world.longitude, depth


@inlined
def write_surfacing(log, memory, world, t):  # type: ignore[no-untyped-def]  # compiled only
    """Write down what a stay at the surface told of the time under water before (`SURFACING`)."""
    if memory.averaged_over > 0.0 and log.counts[SURFACINGS] < len(log.surfacings):
        row = log.surfacings[log.counts[SURFACINGS]]
        log.counts[SURFACINGS] += 1
        row.time, row.latitude, row.longitude = t, memory.submerged_latitude, memory.submerged_longitude
        row.current_north, row.current_east = memory.current_north, memory.current_east
        row.true_current_north = world.current_sum_north / world.current_time
        row.true_current_east = world.current_sum_east / world.current_time
        row.reckoning_error, row.submerged, row.dive = world.reckoning_error, memory.averaged_over, memory.dives - 1.0
