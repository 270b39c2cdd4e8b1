"""`stommel can`. Oracle: what was put on the bus beside it, and the same numbers as words and as JSON."""

import json
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from stommel.cli.can import InterfaceChoice
from stommel.messages.adapters import INTERFACES, Adapter
from stommel.messages.bus import CanBus
from stommel.messages.codec import Decoder, Encoder, Received
from stommel.messages.database import database_hash
from stommel.messages.frames import Frame
from stommel.messages.spoken import frame_of, frame_text
from tests.cli.test_bad_input import refused
from tests.support.command import Command, Outcome


def motion_frames() -> list[Frame]:
    """One of each kind that `dump` tells apart."""
    encoder = Encoder()
    information = encoder.frame(
        "MotionInformation", hardware=3, version_major=1, version_minor=2, version_patch=3,
        database_hash=database_hash() ^ 1,
    )  # fmt: skip
    setpoint = encoder.frame("MotionSetpoint", ballast=1e-4, moving_mass=0.4, steering=-0.25)
    broken = Frame(setpoint.identifier, bytes((setpoint.data[0] ^ 1,)) + setpoint.data[1:])
    heartbeat = encoder.frame("MotionHeartbeat", state=3, restarts=7, uptime=12)
    return [information, heartbeat, setpoint, broken, Frame(0x709, b"\x01"), Frame(0x333, b"")]


def dumped(stommel: Command, channel: str, *options: str) -> Outcome:
    def speak() -> None:
        with CanBus(Adapter("virtual", channel)) as bus:
            end = time.monotonic() + 10.0
            while not heard.is_set() and time.monotonic() < end:
                for frame in motion_frames():
                    bus.send(frame)
                time.sleep(0.4)

    heard = threading.Event()
    speaker = threading.Thread(target=speak)
    speaker.start()
    try:
        return stommel("can", "dump", "--interface", "virtual", "--channel", channel, "--seconds", 0.9, *options)
    finally:
        heard.set()
        speaker.join()


def test_dump_tells_words_rejections_and_strangers(stommel: Command) -> None:
    found = dumped(stommel, "words")
    assert found.status == 0, found.err
    for words in (
        "MotionSetpoint: ballast 0.0001 m3, moving_mass 0.4 m, steering -0.25 rad",
        "MotionSetpoint rejected: its checksum is wrong",
        "MotionHeartbeat: state Safe, restarts 7, uptime 12 s",
        "0x709: heartbeat of an unknown node 9: the database has no such identifier (01)",
        "0x333: the database has no such identifier (no data)",
        f"refused: Motion: CAN database {database_hash() ^ 1:06x}, must be {database_hash():06x}",
        "unknown: 0x709: heartbeat of an unknown node 9",
    ):
        assert words in found.out, words
    (row,) = (line.split() for line in found.out.splitlines() if line.split()[:2] == ["Motion", "Safe"])
    assert row == ["Motion", "Safe", "7", row[3], "1.2.3"]


def test_dump_as_json_has_every_frame(stommel: Command) -> None:
    answer = dumped(stommel, "json", "--json").json
    assert {(frame["message"], frame["rejected"]) for frame in answer["frames"]} >= {
        ("MotionSetpoint", None), ("MotionSetpoint", "checksum"), ("MotionHeartbeat", None), (None, "unknown"),
    }  # fmt: skip
    setpoint = next(f for f in answer["frames"] if f["message"] == "MotionSetpoint" and f["rejected"] is None)
    assert setpoint["signals"] == {"ballast": 1e-4, "moving_mass": 0.4, "steering": -0.25}
    assert setpoint["units"] == {"ballast": "m3", "moving_mass": "m", "steering": "rad"}
    assert answer["counts"]["received"] == len(answer["frames"])
    assert answer["unknown"].keys() == {"0x333", "0x709: heartbeat of an unknown node 9"}
    motion = next(node for node in answer["nodes"] if node["name"] == "Motion")
    assert (motion["state"], motion["restarts"], motion["version"]) == ("Safe", 7, [1, 2, 3])
    assert answer["listened_s"] == pytest.approx(0.9, abs=0.05)


def log_text() -> str:
    lines = [f"({1000.5 + k:.6f}) can0 {frame_text(frame)}" for k, frame in enumerate(motion_frames())]
    return "\n".join([*lines, "(1010.0) can0 12345678#00", "(1011.0) can0 100#R", "(1012.0) can", ""])


def test_a_log_is_decoded_and_its_bad_lines_are_named(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "bus.log").write_text(log_text())
    found = stommel("can", "decode", "bus.log", "--json").json
    assert found["counts"] == {"good": 3, "rejected": 1, "unknown": 2, "unreadable": 3}
    assert found["frames"][2]["time_s"] == 1002.5
    assert found["frames"][2]["interface"] == "can0"
    assert [line.split(":")[1] for line in found["unreadable"]] == [" line 7", " line 8", " line 9"]
    words = stommel("can", "decode", "bus.log").out
    assert "(1002.500000) MotionSetpoint: ballast 0.0001 m3" in words
    assert "unreadable: bus.log: line 9: '(1012.0) can': must be (time) interface ID#DATA" in words


def test_frames_are_decoded(stommel: Command) -> None:
    frame = Encoder().frame("CoordinatorCommand", target=2, command=4, sequence=1, argument=-3)
    answer = stommel("can", "decode", frame_text(frame).lower(), "333#01.02", "--json").json
    assert answer["frames"][0]["signals"] == {"target": "Motion", "command": "Blow", "sequence": 1, "argument": -3}
    assert answer["frames"][1]["data"] == "0102"
    assert answer["counts"] == {"good": 1, "rejected": 0, "unknown": 1, "unreadable": 0}


SAID = ("BenchCommand", "target=Motion", "command=Stop", "sequence=32768", "argument=-1")


def test_what_is_sent_arrives_and_one_of_three_is_always_taken(stommel: Command) -> None:
    """Whatever alive counter was heard before."""
    with CanBus(Adapter("virtual", "sent")) as bus:
        answer = stommel("can", "send", *SAID, "--interface", "virtual", "--channel", "sent", "--json").json
        time.sleep(0.3)
        frames = bus.receive()
    assert [frame_text(frame) for frame in frames] == answer["frames"]
    assert len(frames) == 3
    for before in range(16):
        decoder = Decoder()
        decoder.take(Encoder(before).frame("BenchCommand", target=0, command=1, sequence=1, argument=1))
        heard = [answer for answer in map(decoder.take, frames) if isinstance(answer, Received)]
        assert heard[-1].values["command"] == 2
        assert heard[-1].values["argument"] == -1


def test_words_of_sending_are_those_of_its_json(stommel: Command) -> None:
    shown = stommel("can", "send", *SAID, "--interface", "virtual", "--times", 2, "--period", 0.01)
    assert "sent BenchCommand: target Motion, command Stop, sequence 32768, argument -1\n" in shown.out
    assert len(shown.out.splitlines()) == 3
    assert frame_of(shown.out.splitlines()[0]).identifier == 0x114


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("send", "Sinc"), "CAN message Sinc: the database has none of this name; did you mean Sync?"),
        (("send", "Sync"), "Sync: vehicle_time: not given"),
        (("send", "Sync", "vehicle_time"), "must be signal=value; signals are vehicle_time"),
        (("send", "Sync", "vehicle_time=1", "vehicle_time=2"), "vehicle_time: given twice"),
        (("send", "Sync", "time=1"), "Sync: unknown signal time"),
        (("send", "Sync", "checksum=1"), "Sync: unknown signal checksum"),
        (("send", "Sync", "vehicle_time=nan"), "Sync: vehicle_time = 'nan': must be a number"),
        (("send", "Sync", "vehicle_time=-1"), "vehicle_time = -1: must be between 0 and 1e+09 s"),
        (("send", *SAID[:2], "command=Stopp", *SAID[3:]), "command = 'Stopp': must be one of"),
        (("send", *SAID[:2], "command=99", *SAID[3:]), "command = '99': must be one of"),
        (("send", *SAID[:3], "sequence=1.5", SAID[4]), "sequence = '1.5': must be a whole number"),
        (("send", *SAID[:3], "sequence=70000", SAID[4]), "sequence = 70000: must be between 0 and 65535"),
        (("decode", "100#0"), "must be ID#DATA, hexadecimal"),
        (("decode", "100#" + "00" * 9), "9 bytes; at most 8 are allowed"),
        (("decode", "800#00"), "the identifier must be between 0 and 7FF"),
        (("decode", ""), "'': must be ID#DATA, as 100#E803204E0000000C, or the name of a candump log"),
        (("decode", "702#00", " "), "' ': must be ID#DATA, as 100#E803204E0000000C, or the name of a candump log"),
        (("decode", "nowhere.log"), "nowhere.log: cannot be read: No such file"),
        (("decode", "text.log"), "text.log: cannot be read: it is no candump log: line 1: 'hello': must be (time)"),
        (("dump", "--interface", "vrtual"), "did you mean virtual?"),
        (("dump", "--interface", "slcan"), "--bitrate = not given: slcan needs one of 10000, "),
        (("dump", "--interface", "virtual", "--bitrate", "500000"), "--bitrate = 500000: leave it out; virtual has"),
        (("dump", "--interface", "udp_multicast", "--channel", "1.2.3.4"), "'1.2.3.4': must be a multicast"),
        (("dump", "--interface", "slcan", "--channel", "/dev/none", "--bitrate", "500000"), "no such adapter"),
        (("dump", "--seconds", "0"), "--seconds = 0: must be between 0.1 and 86400 s"),
    ],
)  # fmt: skip
def test_bad_input_is_one_line(stommel: Command, tmp_path: Path, arguments: tuple[str, ...], says: str) -> None:
    (tmp_path / "text.log").write_text("hello\nworld\n")
    refused(stommel("can", *arguments), says)


def test_the_choices_are_the_interfaces() -> None:
    assert {choice.value for choice in InterfaceChoice} == set(INTERFACES)


def test_an_empty_log_is_an_answer(stommel: Command, tmp_path: Path) -> None:
    (tmp_path / "empty.log").write_text("")
    assert json.loads(stommel("can", "decode", "empty.log", "--json").out)["frames"] == []


def test_listening_ends_by_hand_with_what_was_heard(stommel: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C is how a bench ends it: an answer, not an error."""
    looks = iter([None, None, KeyboardInterrupt])

    def sleep(seconds: float) -> None:
        time.sleep(seconds)
        if (interruption := next(looks)) is not None:
            raise interruption

    monkeypatch.setattr("stommel.cli.can.time", SimpleNamespace(sleep=sleep, monotonic=time.monotonic))
    found = stommel("can", "dump", "--interface", "virtual", "--seconds", 60, "--json")
    assert (found.status, found.err) == (0, "")
    assert found.json["reports"] == ["ended by hand"]
    assert found.json["listened_s"] < 10.0


def test_words_aboard_load_no_adapter_and_no_database() -> None:
    """The vehicle's software starts in two seconds on a small board: python-can and cantools come when used."""
    program = """
import sys
import stommel.messages.adapters, stommel.messages.bus, stommel.messages.commanding
import stommel.messages.nodes, stommel.messages.parameter_files, stommel.messages.spoken
print(sorted({"can", "cantools", "numpy", "numba", "scipy"} & set(sys.modules)))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
