"""Compiled functions as plain Python: the same answers, for one question, without a compiler, and until it is wanted.

Oracle: the machine code of the same functions. Sums of products may be fused there, so that last digits differ.
"""

import math
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from stommel import SteadyFlight, StommelError, builtin_names, load_vehicle, steady_flight, trim, turn
from stommel.analysis.linear_equations import linearise_into
from stommel.analysis.wings_level import trim_into
from stommel.compilation import compiled, compiler, inlined, one_question, plain
from stommel.dynamics.packing import pack, reference_water
from stommel.geometry import elementary
from stommel.vehicle import FULL, PAPER, Physics

Array = NDArray[np.float64]

SAME = 1e-12
"""Relative to the greatest number of its kind: rounding, and what Newton's method leaves."""


@pytest.fixture
def forbidden(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Nothing is compiled here: whatever was, runs as plain Python."""
    with monkeypatch.context() as patched:
        patched.setattr(compiler, "is_available", lambda: False)
        patched.setattr("stommel.compilation.decorators._Compiled.__call__", lambda self, *a, **k: self._first(*a, **k))
        yield


def flights(vehicle: str, physics: Physics) -> list[SteadyFlight | str]:
    """Trim, straight and turning, or why that cannot be flown."""
    glider = load_vehicle(vehicle)
    asked: list[Callable[[], SteadyFlight]] = [
        lambda: trim(glider, speed_m_s=0.4, pitch_deg=-35.0, physics=physics, within_limits=False),
        lambda: trim(glider, speed_m_s=0.3, pitch_deg=20.0, physics=physics, within_limits=False),
        lambda: trim(glider, speed_m_s=0.3, glide_path_deg=-25.0, physics=physics, within_limits=False),
        lambda: trim(glider, speed_m_s=0.3, glide_path_deg=-1.0, physics=physics, within_limits=False),
        lambda: steady_flight(glider, moving_mass_mm=405.0, ballast_ml=-40.0, physics=physics, within_limits=False),
        lambda: turn(glider, speed_m_s=0.4, pitch_deg=-30.0, turn_rate_rad_s=0.005, physics=physics),
    ]
    return [answer(ask) for ask in asked]


def answer(ask: Callable[[], SteadyFlight]) -> SteadyFlight | str:
    try:
        return ask()
    except StommelError as error:
        return str(error)


def numbers(flight: SteadyFlight | str) -> Array | str:
    if isinstance(flight, str):
        return flight
    z = np.array([flight.V, flight.alpha, flight.beta, flight.phi, flight.theta, flight.turn_rate, flight.mu])
    return np.append(z, [flight.r_px, 1e3 * flight.V_b, flight.delta_r])


@pytest.mark.parametrize("physics", [PAPER, FULL], ids=["paper", "full"])
@pytest.mark.parametrize("vehicle", builtin_names())
def test_every_steady_flight_is_the_same(vehicle: str, physics: Physics, request: pytest.FixtureRequest) -> None:
    fast = [numbers(flight) for flight in flights(vehicle, physics)]
    request.getfixturevalue("forbidden")
    slow = [numbers(flight) for flight in flights(vehicle, physics)]
    found = 0
    for one, other in zip(fast, slow, strict=True):
        if isinstance(one, str) or isinstance(other, str):
            assert isinstance(one, str)
            assert one == other
        else:
            np.testing.assert_allclose(other, one, rtol=0.0, atol=SAME)
            found += 1
    assert found >= 3


@pytest.mark.parametrize("vehicle", builtin_names())
def test_every_linear_model_is_the_same(vehicle: str, request: pytest.FixtureRequest) -> None:
    glider = load_vehicle(vehicle)
    record, water, z = pack(glider, FULL), reference_water(glider), np.zeros(10)
    assert trim_into(record, 0.4, math.radians(-30.0), False, water, z) == 0
    models = []
    for mode in ("compiled", "plain"):
        if mode == "plain":
            request.getfixturevalue("forbidden")
        A, B = np.empty((8, 8)), np.empty((8, 4))
        linearise_into(record, z, water, A, B)
        models.append(np.hstack([A, B]))
    np.testing.assert_allclose(models[1], models[0], rtol=0.0, atol=SAME * np.abs(models[0]).max())


@pytest.mark.parametrize("x", [0.3, 0.7])
@pytest.mark.parametrize(
    ("function", "slope"),
    [
        (elementary.sqrt, lambda x: 0.5 / math.sqrt(x)),
        (elementary.asin, lambda x: 1.0 / math.sqrt(1.0 - x * x)),
        (elementary.sin, math.cos),
        (elementary.cos, lambda x: -math.sin(x)),
        (lambda x: elementary.atan2(x, 2.0), lambda x: 2.0 / (4.0 + x * x)),
    ],
)
def test_plain_elementary_functions_carry_a_complex_step(
    function: Callable[[complex], complex], slope: Callable[[float], float], x: float
) -> None:
    """Oracle: derivatives in closed form."""
    assert function(complex(x, 1e-40)).imag / 1e-40 == pytest.approx(slope(x), rel=1e-15)
    assert function(complex(x, 1e-40)).real == function(x)


def test_what_the_c_library_cannot_answer_is_not_a_number() -> None:
    assert math.isnan(elementary.sqrt(-1.0))
    assert math.isnan(elementary.asin(1.5))


@compiled
def _half(x: float) -> float:
    return 0.5 * x


@compiled
def _halve(x: Array, times: int) -> int:
    for _ in range(times):
        x[0] = _half(x[0])
    return times


class _Held(NamedTuple):
    rows: NDArray[np.void]
    numbers: tuple[Array, str]


ROW = np.dtype([("value", "f8"), ("pair", "f8", (2,))])


@compiled
def _halve_within(held: _Held, one: np.record, times: int) -> int:
    row = held.rows[1]
    for _ in range(times):
        row.value = _half(row.value)
        one.pair[1] = _half(one.pair[1])
        held.numbers[0][0] = _half(held.numbers[0][0])
    return times


@compiled
def _inverse(x: float) -> float:
    return 1.0 / x


@compiled
def _over(record: np.record, x: float) -> float:
    return float(record.value) / x


@pytest.fixture
def untouched(monkeypatch: pytest.MonkeyPatch) -> None:
    """The functions above, as in a process that has compiled none of them."""
    for function in (_half, _halve, _halve_within, _inverse, _over):
        monkeypatch.setattr(function, "_call", function._first)  # type: ignore[attr-defined]  # see decorators


def is_plain(function: Callable[..., object]) -> bool:
    return function._call == function._first  # type: ignore[attr-defined, no-any-return]  # see decorators


@pytest.mark.usefixtures("untouched")
def test_a_short_question_compiles_nothing_and_a_long_one_begins_anew_in_machine_code() -> None:
    with one_question():
        x = np.array([1.0])
        assert _halve(x, 10) == 10
        assert x[0] == 2.0**-10
        assert is_plain(_halve)
        x = np.array([1.0])
        assert _halve(x, 400) == 400
        assert x[0] == 2.0**-400
        assert not is_plain(_halve)
    assert is_plain(_half)


@pytest.mark.usefixtures("untouched")
@pytest.mark.parametrize("times", [10, 400])
def test_records_within_tuples_are_read_by_name_and_begin_anew_too(times: int) -> None:
    """Oracle: powers of two, which are exact; 1200 halvings are a long question."""
    rows = np.ones(2, ROW)
    held, one = _Held(rows, (np.ones(1), "")), np.ones(1, ROW).view(np.recarray)[0]
    with one_question():
        assert _halve_within(held, one, times) == times
    assert is_plain(_halve_within) == (times == 10)
    assert list(rows["value"]) == [1.0, 2.0**-times]
    assert (one.value, list(one.pair), held.numbers[0][0]) == (1.0, [1.0, 2.0**-times], 2.0**-times)


@pytest.mark.usefixtures("untouched")
def test_a_library_compiles_at_the_first_call() -> None:
    assert _half(3.0) == 1.5
    assert not is_plain(_half)


@pytest.mark.usefixtures("untouched")
def test_where_python_stops_at_a_division_by_zero_the_question_goes_on_in_machine_code() -> None:
    with one_question():
        assert _inverse(2.0) == 0.5
        assert is_plain(_inverse)
        assert _inverse(0.0) == math.inf


@pytest.mark.usefixtures("untouched")
def test_a_record_that_nobody_may_change_is_left_as_it_is_when_a_question_begins_anew() -> None:
    """`stommel steady zju --moving-mass-mm 700 --ballast-ml -55` in a new process called that a defect of stommel."""
    rows = np.ones(1, ROW)
    rows.flags.writeable = False
    frozen = rows.view(np.recarray)[0]
    with one_question():
        assert _over(frozen, 2.0) == 0.5
        assert is_plain(_over)
        assert _over(frozen, 0.0) == math.inf
    assert not is_plain(_over)


def test_a_decorated_function_looks_like_the_function_behind_it() -> None:
    @inlined
    def twice(x: float) -> float:
        """Two times."""
        return 2.0 * x

    assert (twice.__name__, twice.__doc__) == ("twice", "Two times.")
    assert plain(twice) is not twice
    assert plain(twice)(3.0) == twice(3.0) == 6.0
    assert plain(math.sin) is math.sin
    assert pickle.loads(pickle.dumps(trim_into)) is trim_into


ASK = """
import sys
{before}
from stommel import load_vehicle, trim
from stommel.compilation import one_question
with one_question():
    glider = load_vehicle("zju")
    flight = trim(glider, speed_m_s=0.4, pitch_deg=-35.0)
print(flight.r_px, sys.modules.get("numba") is None)
import stommel.simulation.mission_loop
"""


@pytest.mark.parametrize(
    ("before", "environment"),
    [("", {}), ("sys.modules['numba'] = None", {}), ("", {"STOMMEL_COMPILE": "0"})],
    ids=["one question", "no Numba", "forbidden"],
)
def test_a_process_answers_without_the_compiler(before: str, environment: dict[str, str]) -> None:
    done = subprocess.run(
        [sys.executable, "-c", ASK.format(before=before)],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    position, without = done.stdout.split()
    assert without == "True"
    expected = trim(load_vehicle("zju"), speed_m_s=0.4, pitch_deg=-35.0).r_px
    assert float(position) == pytest.approx(expected, rel=SAME)


PUMP = """
from stommel import load_vehicle
from stommel.machinery.engine import engine_of, simulate
run = simulate(engine_of(load_vehicle("zju")).engine, pressure_pa=2e6, inflate_m3=500e-6)
print(run.as_json()["duration_s"])
"""


def test_an_engine_runs_without_the_compiler() -> None:
    """Its arrays of records are read by name; about 80 s are published (section 5.1.2 of the paper)."""
    done = subprocess.run(
        [sys.executable, "-c", PUMP],
        env=os.environ | {"STOMMEL_COMPILE": "0"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert float(done.stdout) == pytest.approx(80.0, abs=0.5)


def test_nothing_is_compiled_where_it_is_forbidden_for_a_while() -> None:
    """Oracle: the modules of a process that asks 2000 times, which is no short question."""
    program = (
        "import sys\n"
        "from stommel.compilation import without_compiler\n"
        "from stommel.control.guidance import course_to_steer\n"
        "with without_compiler():\n"
        "    for _ in range(2000):\n"
        "        course_to_steer(1.0, 0.0, 0.0, 0.0, 1.0, (0.0, 0.0), 0.3)\n"
        "assert 'numba' not in sys.modules\n"
        "course_to_steer(1.0, 0.0, 0.0, 0.0, 1.0, (0.0, 0.0), 0.3)\n"
        "assert 'numba' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=120, env=os.environ)
