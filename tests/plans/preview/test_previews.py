"""The queue of previews: bounded, in order, cancelled at any time, kept for a while."""

import time
from collections.abc import Iterator
from typing import Any

import pytest

from stommel.plans.plan import StationPlan
from stommel.plans.preview import previews as module
from stommel.plans.preview.previews import MOST_WAITING, Previews, TooManyJobsError, UnknownJobError
from stommel.plans.preview.worker import SimulatorError, Worker
from stommel.plans.problems import plan_from
from tests.plans.plans import plan_with
from tests.plans.preview.serving import serve
from tests.support.waiting import until

PLAN = plan_from(plan_with())


class Slow(Worker):
    """Takes so many hundredths of a second for every flight."""

    hundredths = 10

    def ask(self, kind: str, document: Any, *rest: Any) -> Any:
        return super().ask(kind, self.hundredths if kind == "fly" else document, *rest)


@pytest.fixture
def previews() -> Iterator[Previews]:
    found = Previews(lambda: Slow(serve))
    yield found
    found.close()


def ended(previews: Previews, job: str) -> dict[str, Any]:
    until(lambda: previews.job(job)["state"] in ("done", "failed", "cancelled"))
    return previews.job(job)


def test_a_job_tells_how_far_it_is(previews: Previews, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Slow, "hundredths", 200)
    job = previews.start(PLAN)
    seen: list[tuple[str, float, float | None, float]] = []
    while not seen or seen[-1][0] not in ("done", "failed"):
        row = previews.job(job)
        seen.append((row["state"], row["share"], row["seconds_left"], time.monotonic()))
        time.sleep(0.01)
    assert [state for state in dict.fromkeys(s for s, *_ in seen) if state != "waiting"] == [
        "starting", "running", "done",
    ]  # fmt: skip
    over = seen[-1][3]
    told = [(left, over - at) for _, share, left, at in seen if left is not None and share > 0.5]
    assert len(told) > 10
    right = [0.2 * really - 0.2 < left < 5.0 * really + 0.5 for left, really in told]
    assert sum(right) > 0.8 * len(told), "a forecast may err while other work comes and goes, not as a rule"
    assert previews.job(job)["result"] == "slept"


def test_jobs_are_done_one_after_the_other_and_no_more_wait_than_can(
    previews: Previews, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Slow, "hundredths", 100)
    jobs = [previews.start(PLAN)]
    until(lambda: previews.job(jobs[0])["state"] == "running")
    jobs += [previews.start(PLAN) for _ in range(MOST_WAITING)]
    with pytest.raises(TooManyJobsError, match="try again"):
        previews.start(PLAN)
    for job in jobs[1:]:
        previews.cancel(job)
    assert {previews.job(job)["state"] for job in jobs[1:]} == {"cancelled"}
    assert ended(previews, jobs[0])["state"] == "done"


def test_a_running_one_is_cancelled(previews: Previews, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Slow, "hundredths", 6000)
    job = previews.start(PLAN)
    until(lambda: previews.job(job)["state"] == "running")
    previews.cancel(job)
    assert ended(previews, job)["state"] == "cancelled"
    monkeypatch.setattr(Slow, "hundredths", 1)
    assert ended(previews, previews.start(PLAN))["state"] == "done"
    previews.cancel(job)
    assert previews.job(job)["state"] == "cancelled"


def test_a_check_does_not_wait_for_a_flight(previews: Previews, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Slow, "hundredths", 6000)
    job = previews.start(PLAN)
    assert previews.check(PLAN)["echo"]["name"] == PLAN.name
    assert previews.job(job)["state"] in ("waiting", "starting", "running")


def test_the_last_ones_are_kept_and_no_more(previews: Previews, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Slow, "hundredths", 1)
    monkeypatch.setattr(module, "MOST_KEPT", 2)
    jobs = []
    for _ in range(5):
        jobs.append(previews.start(PLAN))
        ended(previews, jobs[-1])
    previews.start(PLAN)
    for job in jobs[:2]:
        with pytest.raises(UnknownJobError):
            previews.job(job)
    assert previews.job(jobs[-1])["state"] == "done"


def test_closing_ends_what_waits_and_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Slow, "hundredths", 6000)
    previews = Previews(lambda: Slow(serve))
    running, waiting = previews.start(PLAN), previews.start(PLAN)
    until(lambda: previews.job(running)["state"] == "running")
    previews.close()
    assert {previews.job(job)["state"] for job in (running, waiting)} == {"cancelled"}
    with pytest.raises(SimulatorError, match="ending"):
        previews.start(PLAN)


def test_an_answer_that_does_not_come_in_time_is_told(previews: Previews) -> None:
    with pytest.raises(SimulatorError, match="ask again"):
        previews.check(PLAN, patience=0.0)


def test_a_plan_goes_to_the_process_as_its_json(previews: Previews) -> None:
    sent = previews.check(PLAN)["echo"]
    assert StationPlan.model_validate(sent) == PLAN
