"""What a root locus says, in words computed from its numbers."""

import numpy as np
from numpy.typing import NDArray

from stommel.analysis import Modes, RootLocus
from stommel.report.plots import TradeOff, planes_of, trade_off
from stommel.report.wording import joined, percent, short

_FLAT = 0.01
"""Relative change below which a quantity counts as constant."""

NAMES = {"wing_position": "the wing position l_w / l", "rudder_position": "the rudder position l_r / l"}


def locus_title(locus: RootLocus, verb: str = "") -> str:
    """What is varied, from where to where, with its unit."""
    what = NAMES.get(locus.over, locus.over)
    unit = f" {locus.unit}" if locus.unit else ""
    return f"{what}{verb} from {short(locus.values[0])} to {short(locus.values[-1])}{unit}"


def locus_heading(locus: RootLocus) -> str:
    """The title as a heading; the key of a file keeps its small letters."""
    title = locus_title(locus).removeprefix("the ")
    return title[0].upper() + title[1:] if locus.over in NAMES else title


def locus_reading(locus: RootLocus, modes: Modes | None) -> list[str]:
    """Sentences on the damping of the modes and on control authority along a locus, plane by plane."""
    sentences = []
    for plane in planes_of(locus):
        trade = trade_off(locus, plane, modes)
        sentences += _damping_sentences(locus, trade)
        sentences.append(_authority_sentence(trade))
        sentences.append(_conclusion(trade))
    return sentences


def trend(values: NDArray[np.float64]) -> int:
    """+1 if values grow throughout, -1 if they fall throughout, 0 if they hardly change, 2 if they do both."""
    scale = float(np.max(np.abs(values)))
    if scale == 0.0 or float(np.ptp(values)) < _FLAT * scale:
        return 0
    steps = np.diff(values)
    noise = 1e-9 * scale
    return 1 if np.all(steps > -noise) else -1 if np.all(steps < noise) else 2


def _change(values: NDArray[np.float64], unit: str) -> str:
    first, last = float(values[0]), float(values[-1])
    kind = trend(values)
    if kind == 0:
        ends = " to ".join(dict.fromkeys((short(first, 3), short(last, 3))))
        return f"hardly changes ({ends} {unit})"
    share = f" ({percent(last / first - 1.0)})" if first > 0.0 and last > 0.0 else ""
    if kind == 2:
        low, high = short(float(values.min()), 3), short(float(values.max()), 3)
        return f"goes from {short(first, 3)} to {short(last, 3)} {unit}{share}, between {low} and {high} on the way"
    verb = "grows" if kind == 1 else "falls"
    return f"{verb} throughout from {short(first, 3)} to {short(last, 3)} {unit}{share}"


def _damping_sentences(locus: RootLocus, trade: TradeOff) -> list[str]:
    swings = [decay for decay in trade.decays if decay.oscillatory]
    slowest = min(trade.decays, key=lambda decay: float(decay.rate.min()))
    moved = locus_title(locus, " goes")
    sentences = [
        f"As {moved}, the decay rate of the {decay.name} {_change(decay.rate, '1/s')}." for decay in swings
    ] or [f"As {moved}, no mode swings."]
    if slowest not in swings:
        sentences.append(f"That of the slowest mode, {slowest.name}, {_change(slowest.rate, '1/s')}.")
    unstable = locus.values[np.min([decay.rate for decay in trade.decays], axis=0) <= 0.0]
    if len(unstable):
        ends = " to ".join(dict.fromkeys((short(unstable[0]), short(unstable[-1]))))
        unit = f" {locus.unit}" if locus.unit else ""
        sentences.append(f"The vehicle is unstable at {ends}{unit}; there a final change of the flight has no meaning.")
    return sentences


def _authority_sentence(trade: TradeOff) -> str:
    if trade.authority is None:
        return "Nothing steers in this plane, so there is no control authority to trade."
    return f"The {trade.authority_name} {_change(trade.authority, trade.authority_unit)}."


def _conclusion(trade: TradeOff) -> str:
    """The trade-off of section 3.2 of the paper, if there is one."""
    swings = [decay for decay in trade.decays if decay.oscillatory]
    damping = [trend(decay.rate) for decay in swings]
    if not damping:
        return "There is no oscillation whose damping could be traded."
    words = f"damping of {'every oscillatory mode' if len(swings) > 1 else 'the oscillatory mode'}"
    if trade.authority is None:
        return f"The {words} {_verb(damping)}."
    authority = trend(trade.authority)
    if all(kind == 1 for kind in damping):
        if authority == -1:
            return f"So the {words} grows while authority falls: stability is paid for with control authority."
        if authority == 0:
            return f"So the {words} grows and the final authority stays: over this range nothing is traded."
        if authority == 1:
            return f"So the {words} and authority grow together: over this range there is no trade-off."
    if all(kind == -1 for kind in damping) and authority == 1:
        return f"So authority grows while the {words} falls: authority is paid for with stability."
    moves = {0: "hardly changes", 1: "grows", -1: "falls", 2: "turns round"}[authority]
    return f"So the {words} {_verb(damping)}, while authority {moves}."


def _verb(kinds: list[int]) -> str:
    words = {0: "hardly changes", 1: "grows", -1: "falls", 2: "turns round"}
    return joined([words[kind] for kind in dict.fromkeys(kinds)]) if len(set(kinds)) == 1 else "does not move one way"
