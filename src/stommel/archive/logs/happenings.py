"""What happened aboard, by the events of a log, in the words in which the radio says it."""

from stommel.archive.logs.channels import Fields

ERROR, WARNING, NOTICE, INFO = 3, 4, 5, 6
"""Of MAV_SEVERITY. The radio tells the worst alarms as worse; the log does not say what an alarm leads to."""

_TOLD = {
    "safety:raised": (WARNING, "alarm: "),
    "safety:cleared": (NOTICE, "alarm over: "),
    "executive": (INFO, ""),
    "command": (INFO, "command: "),
    "parameter": (INFO, "parameter: "),
    "exception": (ERROR, "exception: "),
    "node:emergency": (ERROR, "node: "),
}
"""By the code of an event: its severity and what stands before its words. Any other stands with its code."""


def text_of(fields: Fields, at: float) -> tuple[float, int, str] | None:
    """Time [s since 1970], severity and words of an event; None of one that says nothing.

    Parameters
    ----------
    fields
        Of the record, `code` and `reason`.
    at
        When it happened [s since 1970].
    """
    code, reason = fields.get("code"), fields.get("reason")
    if not isinstance(code, str) or not isinstance(reason, str) or not (code or reason):
        return None
    severity, before = _TOLD.get(code, (NOTICE, f"{code}: "))
    return at, severity, before + reason
