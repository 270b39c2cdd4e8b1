"""Oracle: the file system, and the key that was written."""

import random
import stat
from pathlib import Path

import pytest

from stommel.errors import FileError, OutputError, StommelError
from stommel.link.signing.guard import Guard, Mode
from stommel.link.signing.key_file import ClockError, KeyFile, new_keys
from stommel.link.signing.keys import Key, Keys
from tests.link.signing.ends import CLOCK, KEY, OTHER, keys_of, seeded
from tests.onboard.coordination.disk import Disk


@pytest.fixture
def file(tmp_path: Path) -> KeyFile:
    written = KeyFile(tmp_path / "zju-1.key")
    written.write(keys_of())
    return written


@pytest.mark.parametrize("keys", [keys_of(), keys_of(unused=False), keys_of()._replace(next=OTHER, vehicle=250)])
def test_what_was_written_is_read(file: KeyFile, keys: Keys) -> None:
    file.write(keys)
    assert file.read() == keys
    assert [path.name for path in file.path.parent.iterdir()] == ["zju-1.key"]


def test_only_the_owner_may_read_it(file: KeyFile) -> None:
    """Also where a file of another mode stood before."""
    assert file.mode == 0o600
    file.path.chmod(0o666)
    file.write(keys_of())
    assert stat.S_IMODE(file.path.stat().st_mode) == 0o600


@pytest.mark.parametrize("mode", [0o604, 0o640, 0o660, 0o644, 0o620, 0o700, 0o4600])
def test_a_file_that_others_may_read_is_refused(file: KeyFile, mode: int) -> None:
    file.path.chmod(mode)
    with pytest.raises(FileError, match=f"zju-1.key: others may read it: its mode is {mode:04o}; 0600 is allowed"):
        file.read()


def test_any_changed_byte_is_told(file: KeyFile) -> None:
    """Field report PX4/PX4-Autopilot#26847: a key that is damaged is none."""
    sound = file.path.read_bytes()
    for at in range(len(sound)):
        file.path.write_bytes(sound[:at] + bytes((sound[at] ^ 1,)) + sound[at + 1 :])
        with pytest.raises(FileError, match=r"zju-1.key: .*(damaged|no key file)"):
            file.read()
        guard = Guard(1, file, Disk(), CLOCK, seeded(1))
        assert guard.mode is Mode.NO_KEY
        file.path.write_bytes(sound[:at])
        with pytest.raises(FileError):
            file.read()


@pytest.mark.parametrize(
    "edit", [("vehicle = 1", "vehicle = 0"), ("made = 2", "made = 1"), ("key = 00", "key = "), ("vehicle", "boat")]
)
def test_values_have_ranges(file: KeyFile, edit: tuple[str, str]) -> None:
    """A file whose checksum somebody has made right by hand."""
    import hashlib

    body = file.path.read_text().rpartition("sha256 = ")[0].replace(*edit)
    file.path.write_text(f"{body}sha256 = {hashlib.sha256(body.encode()).hexdigest()}\n")
    with pytest.raises(FileError, match=r"zju-1.key: cannot be used: "):
        file.read()


def test_fuzzed_files_are_one_line(file: KeyFile) -> None:
    draw = random.Random(1)
    for _ in range(300):
        file.path.write_bytes(b"stommel link key 1\n" + draw.randbytes(draw.randrange(200)))
        with pytest.raises(StommelError) as refused:
            file.read()
        assert len(str(refused.value).splitlines()) == 1


def test_a_folder_that_takes_nothing_leaves_the_old_key(file: KeyFile, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OutputError, match=r"zju-1.key: cannot be written: No space left on device"):
        file.write(keys_of(OTHER))
    assert file.read().current == KEY
    assert [path.name for path in file.path.parent.iterdir()] == ["zju-1.key"]


def test_a_link_is_followed_and_a_pipe_is_not(file: KeyFile, tmp_path: Path) -> None:
    import os

    link = tmp_path / "link.key"
    link.symlink_to(file.path)
    KeyFile(link).write(keys_of(OTHER))
    assert link.is_symlink()
    assert file.read().current == OTHER
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OutputError, match="no regular file"):
        KeyFile(tmp_path / "pipe").write(keys_of())
    with pytest.raises(FileError, match="it is a pipe"):
        KeyFile(tmp_path / "pipe").read()


def test_keys_differ_and_are_dated() -> None:
    made = [new_keys(1, CLOCK) for _ in range(100)]
    assert len({keys.current for keys in made}) == 100
    assert all(len(keys.current.secret) == 32 and keys.unused for keys in made)
    for clock in (0.0, 5e9):
        with pytest.raises(ClockError, match="between 2025 and 2075"):
            new_keys(1, clock)


def test_a_key_shows_its_fingerprint_alone() -> None:
    shown = repr(keys_of(OTHER))
    assert OTHER.fingerprint in shown
    assert OTHER.secret.hex()[:8] not in shown
    assert repr(OTHER.secret)[2:10] not in shown
    assert Key(bytes(32)).fingerprint != OTHER.fingerprint
