"""A mirror of the parameters of both nodes: read over the bus at the start, written and saved from here.

This is the door for whoever shows and sets parameters, as the radio link does: `of` says what is known of a node's,
`write` and `save` ask for something, and `View.parameters` of the coordinator says what became of it.
"""

from collections.abc import Mapping

from stommel.messages.codec import Encoder, Received
from stommel.messages.database import NODES
from stommel.messages.frames import Frame
from stommel.messages.nodes import NodeWatch
from stommel.messages.parameters import Value
from stommel.onboard.coordination.node_mirror import NodeMirror, NodeParameter, ParameterOutcome, Request
from stommel.onboard.nodes.parameter_tables import PARAMETERS

Wanted = Mapping[int, Mapping[str, Value]]
"""Values by number of the node and name."""


class NodeParameters:
    """Asks both nodes for their parameters, one request in flight each, and keeps what they answer.

    It begins with a node once that has said what it is and is not refused, and again after the node's restart, or after
    it was silent. A node that does not answer marks its own parameters only.

    Parameters
    ----------
    encoder
        Of the coordinator.
    wanted
        What parameters shall be at each start of a node, where they are something else.

    Raises
    ------
    UnknownParameterError
        A name in `wanted` is none of the node's.
    """

    def __init__(self, encoder: Encoder, wanted: Wanted | None = None) -> None:
        wanted = wanted or {}
        self._nodes = {node: NodeMirror(node, encoder, wanted.get(node, {})) for node in PARAMETERS}
        self._by_answer = {f"{NODES[node]}ParameterAnswer": mirror for node, mirror in self._nodes.items()}
        self._outcomes: list[ParameterOutcome] = []

    def of(self, node: int) -> tuple[NodeParameter, ...]:
        """Return the parameters of a node, in the order of their numbers."""
        return tuple(self._nodes[node].known.values())

    def write(self, node: int, number: int, value: Value) -> None:
        """Set a parameter until the node's next start; its outcome follows, and the mirror has what the node said.

        Writes are sent in their order, before what is still to be read.
        """
        self._ask(node, Request("Write", number, value))

    def read(self, node: int, number: int) -> None:
        """Ask again for a value that the node itself may have changed, as a counter; the mirror then has it."""
        self._ask(node, Request("Read", number))

    def save(self, node: int) -> None:
        """Let a node keep its values over its next start; the outcome follows."""
        self._ask(node, Request("Save", 0))

    def take(self, received: Received, t: float) -> None:
        """Take a message at a time [s]; all but answers to what was asked are passed over."""
        mirror = self._by_answer.get(received.name)
        if mirror is not None:
            mirror.client.take(received, t)
            self._outcomes += mirror.learn(t)

    def step(self, watch: NodeWatch, t: float) -> list[Frame]:
        """Return the requests that are due at a time [s], one a node at most."""
        frames: list[Frame] = []
        for mirror in self._nodes.values():
            frames += mirror.step(watch, t)
            self._outcomes += mirror.learn(t)
        return frames

    def outcomes(self) -> tuple[ParameterOutcome, ...]:
        """Return what became of writes and savings since this was last asked."""
        outcomes, self._outcomes = tuple(self._outcomes), []
        return outcomes

    def _ask(self, node: int, request: Request) -> None:
        operation, number, value = request
        objection = self._nodes[node].queue(request) if node in self._nodes else "NoAnswer"
        if objection:
            self._outcomes.append(ParameterOutcome(node, number, operation, value, objection))
