"""What a question about samples names: channels."""

from stommel.station.channels import CHANNELS, Channel, channel_named
from stommel.station.web.errors import refusal

MOST_CHANNELS = 40


def asked_channels(text: str) -> list[Channel]:
    """The channels whose keys stand in a text with commas between them, each once; a refusal of one that is not."""
    keys = list(dict.fromkeys(part.strip() for part in text.split(",") if part.strip()))
    if not 1 <= len(keys) <= MOST_CHANNELS:
        raise refusal(
            422, f"{len(keys)} channels are asked for", key="channels", value=text[:100],
            allowed=f"1 to {MOST_CHANNELS}",
        )  # fmt: skip
    return [_asked(key) for key in keys]


def _asked(key: str) -> Channel:
    channel = channel_named(key)
    if channel is None:
        known = ", ".join(channel.key for channel in CHANNELS)
        raise refusal(422, f"there is no channel {key[:80]}", key="channels", value=key[:80], allowed=known)
    return channel
