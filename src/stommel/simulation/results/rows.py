"""Rows of the log: record, samples of the CTD, events, surfacings (compiled)."""

from stommel.compilation import inlined
from stommel.dynamics.equations import state_from_array
from stommel.dynamics.inertia import velocities
from stommel.dynamics.state import Actuation
from stommel.geometry.attitude import attitude_of
from stommel.ocean.kernel.column import water_at
from stommel.ocean.kernel.grid import BOTTOM, SALINITY, Column
from stommel.simulation.memory import EVENTS, ROWS, SAMPLES, SURFACINGS
from stommel.simulation.plant.sensing import measured_internal_pressure


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
def write_row(  # type: ignore[no-untyped-def]  # compiled only
    log, t, age, x, equipment, software, world, measured, depth_measured, column, noise
):
    """Write one row of the record (`STATE_COLUMNS`)."""
    by_mass, sensors = equipment.plant.steers_by_mass != 0.0, equipment.sensors
    state = state_from_array(x)
    water = water_at(column, x[2], age)
    actuation = Actuation(0.0, 0.0, 0.0, 0.0, world.steering if by_mass else 0.0, 0.0)
    eta = velocities(equipment.vehicle, state, actuation, water, False)
    true = attitude_of(state.Q)
    row = log.record[log.counts[ROWS]]
    log.counts[ROWS] += 1
    row[0], row[1], row[2], row[3] = t, world.latitude, world.longitude, x[2]
    row[4], row[5], row[6] = true.phi, true.theta, true.psi
    row[7], row[8], row[9] = eta.v_r
    row[10], row[11], row[12] = eta.omega
    row[13], row[14] = x[13], x[15] + world.leaked
    row[15] = 0.0 if by_mass else world.steering
    row[16] = world.steering if by_mass else 0.0
    row[17] = software.phase
    row[18], row[19], row[20] = measured.theta, measured.psi, depth_measured
    row[21], row[22] = water.rho, water.T
    row[23] = salinity_at(column, x[2])
    row[24], row[25] = water.U[0], water.U[1]
    row[26] = column.place[BOTTOM]
    row[27], row[28] = software.latitude, software.longitude
    row[29] = world.voltage + sensors.voltage_bias + sensors.voltage_noise * noise.standard_normal()
    row[30] = world.current + sensors.current_bias + sensors.current_noise * noise.standard_normal()
    row[31] = measured_internal_pressure(sensors, world) + sensors.internal_pressure_noise * noise.standard_normal()
    for j in range(len(world.energy)):
        row[32 + j] = world.energy[j]


@inlined
def write_sample(log, t, x, water, software, world, column):  # type: ignore[no-untyped-def]  # compiled only
    """Write one sample of the CTD (`SAMPLE_COLUMNS`)."""
    row = log.samples[log.counts[SAMPLES]]
    log.counts[SAMPLES] += 1
    row[0], row[1], row[2], row[3] = t, software.latitude, software.longitude, water.P
    row[4], row[5] = world.thermistor, water.T - world.cell_error
    row[6], row[7] = salinity_at(column, x[2]), software.phase


@inlined
def write_event(log, t, software, world, depth, reason):  # type: ignore[no-untyped-def]  # compiled only
    """Write down what happened, and why (`EVENT_COLUMNS`)."""
    if log.counts[EVENTS] < len(log.events):
        row = log.events[log.counts[EVENTS]]
        log.counts[EVENTS] += 1
        row[0], row[1], row[2], row[3], row[4] = t, software.phase, world.latitude, world.longitude, depth
        row[5] = reason


@inlined
def write_surfacing(log, software, world, t, submerged):  # type: ignore[no-untyped-def]  # compiled only
    """Write down what a stay at the surface told of the `submerged` seconds before (`SURFACING_COLUMNS`)."""
    if submerged > 0.0 and log.counts[SURFACINGS] < len(log.surfacings):
        row = log.surfacings[log.counts[SURFACINGS]]
        log.counts[SURFACINGS] += 1
        row[0], row[1], row[2] = t, software.latitude, software.longitude
        row[3], row[4] = software.current_north, software.current_east
        row[5], row[6] = world.current_sum_north / world.current_time, world.current_sum_east / world.current_time
        row[7], row[8], row[9] = software.reckoning_error, submerged, software.dives - 1.0
