"""What goes wrong with people, in sentences for them."""

from stommel.errors import StommelError


class PeopleError(StommelError):
    """A name, a password, a role or a hold that cannot be; `key` is the field to mend, where there is one."""

    def __init__(self, reason: str, key: str | None = None, value: object = None, allowed: str | None = None) -> None:
        self.key, self.value, self.allowed = key, value, allowed
        super().__init__(reason)


class UnknownPersonError(PeopleError):
    """Nobody, or no token, of that name."""


class WrongLoginError(PeopleError):
    """Name and password do not belong together; which of them is wrong is not said."""


class TooManyTriesError(PeopleError):
    """Too many wrong passwords; `wait` seconds until the next try."""

    def __init__(self, reason: str, wait: float) -> None:
        self.wait = wait
        super().__init__(reason)


class HeldError(PeopleError):
    """Somebody else holds command of the vehicle; `holder` says who."""

    def __init__(self, reason: str, holder: str) -> None:
        self.holder = holder
        super().__init__(reason)
