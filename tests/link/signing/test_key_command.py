"""Oracle: the file that the library reads, its mode, and that no answer of the command holds the key."""

import json
from pathlib import Path

import pytest

from stommel.link.signing.key_file import KeyFile
from tests.cli.test_bad_input import refused
from tests.link.signing.ends import OTHER, keys_of
from tests.support.command import Command


def test_a_new_key_is_private_shown_by_its_fingerprint_and_sound(stommel: Command, tmp_path: Path) -> None:
    file = tmp_path / "new" / "zju-7.key"
    made = json.loads(stommel("link", "key", "new", str(file), "--vehicle", "7", "--json").out)
    keys = KeyFile(file).read()
    assert made["fingerprint"] == keys.current.fingerprint
    assert (made["vehicle"], made["used"], made["written"]) == (7, False, [str(file)])
    assert file.stat().st_mode & 0o777 == 0o600
    for verb in ("show", "check"):
        for arguments in ((), ("--json",)):
            answer = stommel("link", "key", verb, str(file), *arguments)
            assert answer.status == 0
            assert keys.current.fingerprint in answer.out
            assert made["made"] in answer.out
            assert keys.current.secret.hex() not in answer.out


def test_a_key_is_not_replaced_by_accident(stommel: Command, tmp_path: Path) -> None:
    file = tmp_path / "zju-1.key"
    stommel("link", "key", "new", str(file))
    before = file.read_bytes()
    refused(stommel("link", "key", "new", str(file)), "already exists; --force replaces it")
    assert file.read_bytes() == before
    assert stommel("link", "key", "new", str(file), "--force").status == 0
    assert file.read_bytes() != before


def test_a_loose_file_is_shown_with_what_to_do_and_fails_the_check(stommel: Command, tmp_path: Path) -> None:
    file = KeyFile(tmp_path / "zju-1.key")
    file.write(keys_of()._replace(next=OTHER))
    file.path.chmod(0o644)
    answer = stommel("link", "key", "show", str(file.path))
    assert "chmod 600" in answer.out
    assert "a change of the key is under way" in answer.out
    refused(stommel("link", "key", "check", str(file.path)), "others may read it: its mode is 0644; 0600 is allowed")


@pytest.mark.parametrize("verb", ["show", "check"])
def test_what_is_no_sound_key_file_is_one_line(stommel: Command, tmp_path: Path, verb: str) -> None:
    file = tmp_path / "zju-1.key"
    refused(stommel("link", "key", verb, str(file)), "cannot be read: No such file or directory")
    file.write_text("hello\n")
    file.chmod(0o600)
    refused(stommel("link", "key", verb, str(file)), "is no key file: its first line must be 'stommel link key 1'")
    refused(stommel("link", "key", verb, str(tmp_path)), "it is a folder")
