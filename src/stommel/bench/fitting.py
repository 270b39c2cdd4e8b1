"""Constants of the engine model from a bench log, with their uncertainty."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from stommel.bench.failures import BenchRequestError
from stommel.bench.identifiability import require_identifiable, warnings_of
from stommel.bench.performance import RunPerformance
from stommel.files.units import counted
from stommel.machinery.engine.steady_state import EngineParameters, steady_state

Array = NDArray[np.float64]

DEFAULT_PARAMETERS = (
    "displacement_m3_rev",
    "leakage_m3_s_pa",
    "pump_friction_n_m",
    "pump_friction_share",
    "pump_damping_n_m_s",
)
"""What a bench with several speeds and pressures can tell; the others are on data sheets or drawings."""
CONFIDENCE = 0.95
_REWEIGHTINGS = 4
_LARGEST_SCATTER = 0.2


@dataclass(frozen=True)
class FittedParameter:
    """One constant of the engine, in SI units."""

    name: str
    value: float
    standard_error: float
    low: float
    """Lower end of the stated interval: all true values lie in their intervals at once with 95 % probability."""
    high: float
    """Upper end."""
    alone: tuple[float, float]
    """Interval of this parameter alone, at 95 %."""
    start: float
    """Value of the vehicle file, where the fit began."""
    true: float | None = None
    """The value that made a generated log."""

    def as_row(self) -> dict[str, object]:
        """Words for JSON."""
        return {
            "name": self.name,
            "value": self.value,
            "standard_error": self.standard_error,
            "interval_95": [self.low, self.high],
            "interval_95_alone": list(self.alone),
            "start": self.start,
            "true": self.true,
            "true_inside": None if self.true is None else self.low <= self.true <= self.high,
        }


@dataclass(frozen=True)
class EngineFit:
    """Result of a fit."""

    parameters: tuple[FittedParameter, ...]
    correlation: Array
    """Of the estimates, in the order of `parameters`."""
    flow_scatter: float
    """Relative standard deviation of the runs about the model, piston speed."""
    current_scatter: float
    """The same of the average current."""
    degrees_of_freedom: float
    engine: EngineParameters
    """The engine with the fitted constants."""
    flow_residuals: Array
    """Measured / model - 1 of each run, piston speed."""
    current_residuals: Array
    """The same of the average current."""
    warnings: tuple[str, ...]

    def as_json(self) -> dict[str, object]:
        """Words for JSON."""
        return {
            "runs": len(self.flow_residuals),
            "parameters": [one.as_row() for one in self.parameters],
            "confidence": CONFIDENCE,
            "interval_meaning": "all true values lie in their interval_95 at once with this probability (Bonferroni); "
            "interval_95_alone is for one constant alone",
            "correlation": self.correlation.tolist(),
            "flow_scatter": self.flow_scatter,
            "current_scatter": self.current_scatter,
            "degrees_of_freedom": self.degrees_of_freedom,
            "warnings": list(self.warnings),
        }


def fit_engine(
    runs: Sequence[RunPerformance],
    start: EngineParameters,
    names: Sequence[str] = DEFAULT_PARAMETERS,
    true: dict[str, float] | None = None,
) -> EngineFit:
    """Fit constants of the engine to piston speed and average current of every run.

    Least squares of relative deviations. How far runs scatter about the model is estimated from the runs themselves,
    for speed and current apart, so that the intervals hold without knowing the sensors (docs/theory/bench).

    Parameters
    ----------
    runs
        Averages of the runs.
    start
        The engine as its vehicle file describes it; constants that are not fitted stay as they are.
    names
        Fields of `EngineParameters` to fit.
    true
        Constants that made a generated log, to stand beside the result.

    Raises
    ------
    BenchRequestError
        A name is unknown, the runs are too few or cannot tell the constants apart, or the model does not fit them.
    """
    _check_request(runs, start, names)
    predict = _predictor(runs, start, names)
    x0 = np.array([getattr(start, name) for name in names])
    scale = np.where(x0 > 0.0, x0, _typical(start, names))
    weights = np.ones((2, 1))
    z = np.where(x0 > 0.0, 1.0, 0.1)
    require_identifiable(_jacobian(predict, z * scale, scale).reshape(-1, len(names)), names)
    for _ in range(_REWEIGHTINGS):
        z, J, r = _solve(predict, scale, z, weights)
        sigma, freedom = _scatter(J, r, weights)
        weights = 1.0 / sigma[:, None]
    covariance = np.linalg.inv(np.einsum("kij,kil->jl", J * weights[:, :, None], J * weights[:, :, None]))
    if max(sigma) > _LARGEST_SCATTER:
        raise BenchRequestError(
            f"the model does not fit: runs scatter by {sigma[0]:.0%} in piston speed and {sigma[1]:.0%} in current; "
            "is it the log of this engine, and are the units right?"
        )
    return _result(names, z * scale, scale, covariance, sigma, freedom, r, start, true)


def _check_request(runs: Sequence[RunPerformance], start: EngineParameters, names: Sequence[str]) -> None:
    known = {field.name for field in fields(EngineParameters)}
    for name in names:
        if name not in known:
            raise BenchRequestError(f"parameter {name!r}: unknown; there are: {', '.join(sorted(known))}")
        if not np.isfinite(getattr(start, name)):
            raise BenchRequestError(f"parameter {name}: the vehicle gives no finite value to begin from")
    if len(set(names)) < len(names) or not names:
        raise BenchRequestError("parameters to fit: name at least one, and none twice")
    if 2 * len(runs) < len(names) + 4:
        raise BenchRequestError(
            f"{counted(len(runs), 'run gives', 'runs give')} {2 * len(runs)} numbers, too few for "
            f"{counted(len(names), 'parameter')} with an uncertainty; "
            f"at least {(len(names) + 5) // 2} runs"
        )


def _typical(start: EngineParameters, names: Sequence[str]) -> Array:
    """Size of a constant whose value is zero: what would take a hundredth of the pump's flow or torque at 1 MPa."""
    torque = start.displacement_m3_rev * 1e6 / (2 * np.pi)
    sizes = {
        "leakage_m3_s_pa": start.displacement_m3_rev * 10.0 * 0.01 / 1e6,
        "pump_friction_n_m": 0.01 * torque,
        "pump_friction_share": 0.01,
        "pump_damping_n_m_s": 0.01 * torque / 50.0,
        "no_load_current_a": 0.01,
    }
    return np.array([sizes.get(name, 1.0) for name in names])


def _predictor(
    runs: Sequence[RunPerformance], start: EngineParameters, names: Sequence[str]
) -> Callable[[Array], Array]:
    """Return the function from constants to (model / measured - 1), rows: piston speed, current."""
    P, omega, U, I, v = np.array(
        [(p.pressure, p.motor_speed, p.voltage, p.current, p.piston_speed) for p in (run.point for run in runs)]
    ).T

    def predict(x: Array) -> Array:
        steady = steady_state(replace(start, **dict(zip(names, x.tolist(), strict=True))), P, omega)
        speed = steady.flow_m3_s / start.piston_area_m2
        return np.stack([speed / v - 1.0, steady.power_w / U / I - 1.0])

    return predict


def _jacobian(predict: Callable[[Array], Array], x: Array, scale: Array) -> Array:
    """Central differences of `predict` by x / scale; shape (2, runs, parameters)."""
    columns = []
    for k in range(len(x)):
        h = np.zeros_like(x)
        h[k] = 1e-5 * scale[k]
        columns.append((predict(x + h) - predict(x - h)) / 2e-5)
    return np.stack(columns, axis=-1)


def _solve(predict: Callable[[Array], Array], scale: Array, z: Array, weights: Array) -> tuple[Array, Array, Array]:
    """Least squares with given weights; returns x / scale, its Jacobian and the residuals, both without weights."""
    from scipy.optimize import least_squares  # noqa: PLC0415 - start-up counts

    def residuals(z: Array) -> Array:
        return (predict(z * scale) * weights).ravel()

    def slopes(z: Array) -> Array:
        return (_jacobian(predict, z * scale, scale) * weights[:, :, None]).reshape(-1, len(scale))

    found = least_squares(residuals, z, jac=slopes, bounds=(0.0, np.inf), xtol=1e-12, ftol=1e-12)
    z = np.asarray(found.x)
    return z, _jacobian(predict, z * scale, scale), predict(z * scale)


def _scatter(J: Array, r: Array, weights: Array) -> tuple[Array, Array]:
    """Standard deviation of each kind of residual, over its own degrees of freedom: runs less leverage."""
    weighted = J * weights[:, :, None]
    inverse = np.linalg.inv(np.einsum("kij,kil->jl", weighted, weighted))
    leverage = np.einsum("kij,jl,kil->k", weighted, inverse, weighted)
    freedom = r.shape[1] - leverage
    return np.maximum(np.sqrt(np.sum(r**2, axis=1) / freedom), 1e-12), freedom


def _result(
    names: Sequence[str],
    x: Array,
    scale: Array,
    covariance: Array,
    sigma: Array,
    freedom: Array,
    r: Array,
    start: EngineParameters,
    true: dict[str, float] | None,
) -> EngineFit:
    from scipy.stats import t as student  # noqa: PLC0415 - start-up counts

    errors = np.sqrt(np.diag(covariance)) * scale
    dof = float(np.min(freedom))
    alone = float(student.ppf(0.5 + 0.5 * CONFIDENCE, dof))
    together = float(student.ppf(1.0 - 0.5 * (1.0 - CONFIDENCE) / len(names), dof))  # Bonferroni
    fitted = tuple(
        FittedParameter(
            name=name,
            value=float(x[k]),
            standard_error=float(errors[k]),
            low=float(x[k] - together * errors[k]),
            high=float(x[k] + together * errors[k]),
            alone=(float(x[k] - alone * errors[k]), float(x[k] + alone * errors[k])),
            start=float(getattr(start, name)),
            true=true.get(name) if true is not None else None,
        )
        for k, name in enumerate(names)
    )
    deviations = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(deviations, deviations)
    measured = 1.0 / (1.0 + r) - 1.0
    return EngineFit(
        parameters=fitted,
        correlation=correlation,
        flow_scatter=float(sigma[0]),
        current_scatter=float(sigma[1]),
        degrees_of_freedom=dof,
        engine=replace(start, **{one.name: one.value for one in fitted}),
        flow_residuals=measured[0],
        current_residuals=measured[1],
        warnings=warnings_of(names, x, errors, correlation),
    )
