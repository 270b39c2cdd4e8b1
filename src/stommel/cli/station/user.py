"""`stommel station user add|list|change|password|remove`: people of a station, from its own machine."""

import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, opened_people
from stommel.station.people.roles import Role

if TYPE_CHECKING:
    from stommel.station.people.users import Person

user_app = typer.Typer(no_args_is_help=True, help="People of a station: viewers, pilots and admins.")

NameArgument = Annotated[str, typer.Argument(metavar="NAME", help="With which the person logs in.")]
RoleOption = Annotated[Role, typer.Option("--role", help="Viewers look, pilots fly, admins look after the station.")]


@user_app.command("add")
def add(
    name: NameArgument,
    role: RoleOption,
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Add somebody; the password is asked for, or read as one line from a pipe.

    Example: stommel station user add anna --role pilot --database sea.sqlite
    """
    from stommel.station.people.names import checked_name

    checked_name(name)
    with opened_people(settings, database, folder) as people:
        person = people.users.add(name, _password(), role)
        people.audit.record("add user", user=None, address="command line", detail={"name": person.name, "role": role})
    finish(_row(person), None, as_json, lambda row: typer.echo(f"{row['name']} is {row['role']} now"))


@user_app.command("list")
def list_users(
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """List everybody with a name at the station.

    Example: stommel station user list --database sea.sqlite
    """
    with opened_people(settings, database, folder) as people:
        rows = [_row(person) for person in people.users.everybody()]
    finish(rows, None, as_json, _show)


@user_app.command("change")
def change(
    name: NameArgument,
    role: Annotated[Role | None, typer.Option("--role", help="The role from now on.")] = None,
    disabled: Annotated[
        bool | None, typer.Option("--keep-out/--let-in", help="Keep the person out, or let them in again.")
    ] = None,
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Change somebody's role, or keep somebody out.

    Example: stommel station user change anna --role viewer --database sea.sqlite
    """
    if role is None and disabled is None:
        raise typer.BadParameter("give --role, --keep-out or --let-in", param_hint="NAME")
    with opened_people(settings, database, folder) as people:
        person = people.change(name, role=role, disabled=disabled)
        detail = {"name": person.name, "role": person.role, "disabled": person.disabled}
        people.audit.record("change user", user=None, address="command line", detail=detail)
    words = "may log in" if not person.disabled else "may not log in"
    finish(_row(person), None, as_json, lambda row: typer.echo(f"{row['name']} is {row['role']} and {words}"))


@user_app.command("password")
def password(
    name: NameArgument,
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Give somebody a new password, which is asked for; all their sessions end.

    Example: stommel station user password anna --database sea.sqlite
    """
    with opened_people(settings, database, folder) as people:
        people.users.require(name)
        person = people.change(name, password=_password())
        people.audit.record("change password", user=None, address="command line", detail={"name": person.name})
    finish(_row(person), None, as_json, lambda row: typer.echo(f"{row['name']} has a new password"))


@user_app.command("remove")
def remove(
    name: NameArgument,
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Remove somebody with their sessions and tokens; what they did stays in the audit log.

    Example: stommel station user remove anna --database sea.sqlite
    """
    with opened_people(settings, database, folder) as people:
        person = people.users.require(name)
        people.remove(name)
        people.audit.record("remove user", user=None, address="command line", detail={"name": person.name})
    finish(_row(person), None, as_json, lambda row: typer.echo(f"{row['name']} is removed"))


def _password() -> str:
    """A password from the person, twice, or one line of a pipe."""
    if sys.stdin is not None and sys.stdin.isatty():
        text: str = typer.prompt("password", hide_input=True, confirmation_prompt=True)
        return text
    line = "" if sys.stdin is None else sys.stdin.readline(1000)
    return line.rstrip("\r\n")


def _row(person: "Person") -> dict[str, Any]:
    return {
        "name": person.name, "role": person.role.value, "disabled": person.disabled, "added_s": person.added,
    }  # fmt: skip


def _show(rows: list[dict[str, Any]]) -> None:
    from stommel.station.people.times import day

    show_table(
        "People",
        ["name", "role", "added", ""],
        [[row["name"], row["role"], day(row["added_s"]), "kept out" if row["disabled"] else ""] for row in rows],
        [] if rows else ["nobody yet; add somebody: stommel station user add NAME --role admin"],
    )
