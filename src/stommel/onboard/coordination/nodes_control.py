"""What the coordinator tells nodes beside set points: to start, to test themselves, to forget a fault."""

from dataclasses import dataclass, field

from stommel.messages.codec import Encoder, Received
from stommel.messages.commanding import CommandSender, Outcome
from stommel.messages.database import ACQUISITION, MOTION
from stommel.messages.frames import Frame
from stommel.messages.nodes import NodeState, NodeWatch
from stommel.onboard.coordination.executive import ExecutiveState, State

ASK_AGAIN = 10.0
"""Between two commands of a kind to a node [s]."""

OIL_WRONG, MASS_WRONG, STEERING_WRONG, ALL_WRONG = 1 | 64, 2 | 8 | 128, 4 | 256, 16 | 32
"""Bits of what the motion node's self-test found, by the drive that they are about."""


@dataclass
class NodesControl:
    """Keeps the nodes working, and asks for self-tests while drives are unproven."""

    sender: CommandSender
    drives_proven: tuple[bool, bool, bool] = (False, False, False)
    """Whether oil, moving mass and steering passed the motion node's self-test."""
    self_test_result: str | None = None
    """Drives that did not follow in the last self-test that was asked for, in words; None until it is over."""
    _test_asked: bool = False
    _asked: dict[tuple[int, str], float] = field(default_factory=dict)
    _restarts: int = 0
    _tested_for_dive: bool = False

    @classmethod
    def of(cls, encoder: Encoder, restarts: int) -> "NodesControl":
        """Return the control of a coordinator that has started so often before."""
        return cls(CommandSender(encoder, restarts=restarts))

    def take(self, received: Received, t: float) -> None:
        """Take a message: acknowledgements of own commands count."""
        self.sender.take(received, t)

    def step(self, watch: NodeWatch, state: ExecutiveState, t: float, *, dives_soon: bool = False) -> list[Frame]:
        """Return the frames of commands that are due; shortly before a dive the drives prove themselves again."""
        if watch.restarts_seen != self._restarts:
            self._restarts = watch.restarts_seen
            self.drives_proven = (False, False, False)
        for node in (MOTION, ACQUISITION):
            if watch.state_of(node) == NodeState.PreOperational and not watch.is_refused(node):
                self._ask(node, "Start", t)
        if watch.state_of(MOTION) == NodeState.Safe and state.state is State.START_UP:
            self._ask(MOTION, "ClearFault", t)  # an abort of before is over
        if self._test_asked:
            self._test_asked = False
            self.sender.send(MOTION, "SelfTest", 0, t)
        if dives_soon and not self._tested_for_dive:
            self.sender.send(MOTION, "SelfTest", 0, t)
        self._tested_for_dive = dives_soon
        if state.self_test:
            self._ask(MOTION, "SelfTest", t)
        return self.sender.poll(t)

    def ask_self_test(self) -> None:
        """Have the motion node test itself at the next step."""
        self._test_asked, self.self_test_result = True, None

    def outcomes(self) -> list[Outcome]:
        """Return what became of commands since the last call."""
        outcomes = self.sender.outcomes()
        for outcome in outcomes:
            if outcome.command == "SelfTest" and outcome.target == MOTION and outcome.result in ("Done", "Failed"):
                found = outcome.detail if outcome.result == "Failed" else 0
                wrong = (OIL_WRONG, MASS_WRONG, STEERING_WRONG)
                self.drives_proven = (
                    not found & (wrong[0] | ALL_WRONG), not found & (wrong[1] | ALL_WRONG),
                    not found & (wrong[2] | ALL_WRONG),
                )  # fmt: skip
                names = zip(("pump or valve", "moving mass", "steering"), self.drives_proven, strict=True)
                self.self_test_result = ", ".join(name for name, proven in names if not proven)
        return outcomes

    def clear_faults(self, t: float) -> None:
        """Tell both nodes to forget their faults, as the operator asks."""
        for node in (MOTION, ACQUISITION):
            self.sender.send(node, "ClearFault", 0, t)

    def _ask(self, node: int, command: str, t: float) -> None:
        if t >= self._asked.get((node, command), t):
            self.sender.send(node, command, 0, t)
            self._asked[node, command] = t + ASK_AGAIN
