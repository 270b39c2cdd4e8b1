"""`stommel station token add|list|remove`: tokens by which scripts speak for somebody."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from stommel.cli.finish import finish
from stommel.cli.numbers import count_option
from stommel.cli.options import JsonOption
from stommel.cli.output import show_table
from stommel.cli.station.options import DatabaseOption, FolderOption, SettingsOption, opened_people
from stommel.station.people.roles import Role

if TYPE_CHECKING:
    from stommel.station.people.tokens import Token

token_app = typer.Typer(no_args_is_help=True, help="Tokens, by which scripts speak for somebody.")


@token_app.command("add")
def add(
    user: Annotated[str, typer.Argument(metavar="USER", help="For whom the script speaks.")],
    name: Annotated[str, typer.Argument(metavar="NAME", help="What the token is for.")],
    role: Annotated[Role, typer.Option("--role", help="What the script may; at most what the person may.")],
    days: Annotated[int, count_option("--days", 1, 366, "Days until it ends")] = 90,
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Make a token and print it, once; scripts send it as `Authorization: Bearer TOKEN`.

    Example: stommel station token add anna plots --role viewer --database sea.sqlite
    """
    if not 1 <= len(name) <= 80 or not name.isprintable():
        raise typer.BadParameter("must be 1 to 80 characters that can be printed", param_hint="NAME")
    with opened_people(settings, database, folder) as people:
        token, secret = people.tokens.add(user, name, role, float(days))
        detail = {"user": token.user, "name": name, "role": role}
        people.audit.record("add token", user=None, address="command line", detail=detail)
    finish(_row(token) | {"secret": secret}, None, as_json, lambda row: typer.echo(row["secret"]))


@token_app.command("list")
def list_tokens(
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """List the tokens of everybody, without their secrets.

    Example: stommel station token list --database sea.sqlite
    """
    with opened_people(settings, database, folder) as people:
        rows = [_row(token) for token in people.tokens.of(None)]
    finish(rows, None, as_json, _show)


@token_app.command("remove")
def remove(
    number: Annotated[int, typer.Argument(metavar="NUMBER", min=1, max=2**53, help="Number in the list.")],
    database: DatabaseOption = None,
    settings: SettingsOption = None,
    folder: FolderOption = None,
    as_json: JsonOption = False,
) -> None:
    """Remove a token; what used it is refused at once.

    Example: stommel station token remove 3 --database sea.sqlite
    """
    with opened_people(settings, database, folder) as people:
        people.tokens.remove(number)
        people.audit.record("remove token", user=None, address="command line", detail={"token": number})
    finish({"token": number}, None, as_json, lambda row: typer.echo(f"token {row['token']} is removed"))


def _row(token: "Token") -> dict[str, Any]:
    return {
        "token": token.token, "user": token.user, "name": token.name, "role": token.role.value,
        "made_s": token.made, "expires_s": token.expires, "last_used_s": token.last_used,
    }  # fmt: skip


def _show(rows: list[dict[str, Any]]) -> None:
    from stommel.station.people.times import day

    show_table(
        "Tokens",
        ["number", "user", "for", "role", "until", "last used"],
        [
            [
                str(row["token"]), row["user"], row["name"], row["role"], day(row["expires_s"]),
                day(row["last_used_s"]),
            ]
            for row in rows
        ],
        [] if rows else ["none yet"],
    )  # fmt: skip
