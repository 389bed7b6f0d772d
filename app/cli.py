"""The command line, `forcerig`. Each command imports what it needs: `--help` is quick."""

from pathlib import Path
from typing import Annotated

import typer

from app.cli_access import tokens, users
from app.cli_analyse import analyse

cli = typer.Typer(
    help="Operator console of a servo-hydraulic force-control test rig.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
database = typer.Typer(help="The database of the console.", no_args_is_help=True)
cli.add_typer(database, name="db")
cli.add_typer(users, name="user")
cli.add_typer(tokens, name="token")
cli.add_typer(analyse, name="analyse")
audit = typer.Typer(help="Who did what, when and why.", no_args_is_help=True)
cli.add_typer(audit, name="audit")

Test = Annotated[str, typer.Argument(help="A YAML or JSON file, or the id of a library test.")]
Json = Annotated[bool, typer.Option("--json", help="One JSON document on standard output.")]
Data = Annotated[
    Path | None, typer.Option("--data", help="Where its state is kept.", show_default="data")
]
RigFile = Annotated[Path | None, typer.Option(help="Rig parameters that differ from the shipped.")]
Settings = Annotated[Path | None, typer.Option(help="Controller settings; as shipped without.")]
OutFile = Annotated[Path | None, typer.Option(help="Write all channels to this Parquet file.")]
Report = Annotated[Path | None, typer.Option(help="Write a report to this file, .pdf or .html.")]
Seed = Annotated[int, typer.Option(min=0, help="Of the sensors' noise.")]
Host = Annotated[str | None, typer.Option(help="Address to listen on.", show_default="127.0.0.1")]
Port = Annotated[
    int | None,
    typer.Option(min=0, max=65535, help="0 takes any free one.", show_default="8000"),
]


@cli.command()
def check(test: Test, json: Json = False) -> None:
    """Validate a test, and print its blocks, durations, cycles and peaks."""
    from app.commands.check import check as run

    raise typer.Exit(run(test, json))


@cli.command()
def simulate(
    test: Test,
    rig: RigFile = None,
    controller: Settings = None,
    seed: Seed = 1,
    out: OutFile = None,
    report: Report = None,
    json: Json = False,
) -> None:
    """Run a test on the virtual rig, measure and judge it.

    Ends with 0 passed, 1 failed acceptance, 2 bad input, 3 tripped.
    """
    from app.commands.simulate import Request, run

    raise typer.Exit(run(Request(test, rig, controller, seed, out, report, json)))


@cli.command()
def run(
    test: Annotated[str, typer.Argument(help="The id of a test in the console's library.")],
    url: Annotated[str, typer.Option(envvar="FORCERIG_URL", help="Of the console.")],
    token: Annotated[
        str, typer.Option(envvar="FORCERIG_TOKEN", help="With scope operate: better not typed.")
    ],
    reason: Annotated[str, typer.Option(help="Why: others see it.")] = "forcerig run",
    revision: Annotated[int | None, typer.Option(min=1, help="The newest without.")] = None,
    pressurise: Annotated[
        bool, typer.Option("--pressurise", help="Reset and pressurise the rig first.")
    ] = False,
    wait: Annotated[bool, typer.Option("--wait", help="For the end, and the verdict.")] = False,
    report: Report = None,
    junit: Annotated[Path | None, typer.Option(help="Write the verdict as JUnit XML.")] = None,
    json: Json = False,
) -> None:
    """Run a test on the rig of a running console, in command of it.

    Ends with 0 passed, 1 failed acceptance, 2 refused, 3 did not come to its end. Ctrl C takes the load off.
    """
    from app.commands.run import Request
    from app.commands.run import run as carry_out

    asked = Request(test, url, token, reason, revision, pressurise, wait, report, junit, json)
    raise typer.Exit(carry_out(asked))


@cli.command()
def export(
    recording: Annotated[Path, typer.Argument(help="The Parquet file of a run or a simulation.")],
    out: Annotated[Path, typer.Argument(help="Ends in .parquet, .csv, .mat, .tdms or .h5.")],
    channels: Annotated[
        str, typer.Option(help="Names, with commas between; all without.", show_default="all")
    ] = "",
    from_s: Annotated[float, typer.Option(min=0, max=1e9, help="From the run's start.")] = 0.0,
    to_s: Annotated[
        float | None, typer.Option(min=0, max=1e9, help="Its end without.", show_default="the end")
    ] = None,
    json: Json = False,
) -> None:
    """Write a recording as a file of another program: chunk by chunk, however long it is."""
    from app.commands.export import Request, run
    from app.exports.extract import Wanted

    names = tuple(name.strip() for name in channels.split(",") if name.strip())
    raise typer.Exit(run(Request(recording, out, Wanted(names, from_s, to_s), json)))


@cli.command()
def serve(
    host: Host = None,
    port: Port = None,
    data: Data = None,
    tls_cert: Annotated[Path | None, typer.Option(help="Certificate (PEM): HTTPS.")] = None,
    tls_key: Annotated[Path | None, typer.Option(help="Its key (PEM).")] = None,
    plain_http: Annotated[
        bool, typer.Option("--plain-http", help="Without TLS, where other machines reach it.")
    ] = False,
) -> None:
    """Start the console and the loop. What is not given may come from FORCERIG_HOST and so on."""
    from app.main import serve as run

    given = {"tls_cert": tls_cert, "tls_key": tls_key, "plain_http": plain_http or None}
    run(host, port, data, **given)


@cli.command()
def stop(data: Data = None) -> None:
    """Take the load off: without the console, whoever is in command, whatever state it is in.

    Ends with 0 where the loop is stopping or has nothing to stop, else with 1.
    """
    from app.commands.stop import run

    raise typer.Exit(run(data))


@cli.command()
def doctor(json: Json = False) -> None:
    """Say whether this machine is fit for real time."""
    from rtcore.doctor import main as run

    raise typer.Exit(run(json))


@cli.command()
def bench(
    name: Annotated[str, typer.Argument(help="Its name, or all.")] = "all",
    minutes: Annotated[
        float | None, typer.Option(min=0.1, max=1440, help="Of real time, for recording.")
    ] = None,
    hour: Annotated[bool, typer.Option("--hour", help="As --minutes 60.")] = False,
    json: Json = False,
) -> None:
    """Run the benchmarks."""
    from app.commands.bench import run

    raise typer.Exit(run(name, json, 60.0 if hour else minutes))


@cli.command()
def reproduce(
    figure: Annotated[str, typer.Argument(help="figure-5, -6, -7, -9, -11, -12, or all.")],
    out: Annotated[Path, typer.Option(help="The folder that its files go to.")] = Path(),
    json: Json = False,
) -> None:
    """Compute a figure of the paper on the virtual rig: data, picture and a page of a report."""
    from app.commands.reproduce import run

    raise typer.Exit(run(figure, out, json))


@cli.command()
def backup(
    file: Annotated[
        Path, typer.Argument(help="The archive to make; `.zst` at its end compresses.")
    ],
    data: Data = None,
    without_samples: Annotated[bool, typer.Option("--without-samples")] = False,
    json: Json = False,
) -> None:
    """Back up everything in one archive, while the console runs."""
    from app.commands.backup import run_backup as run

    raise typer.Exit(run(file, data, not without_samples, json))


@cli.command()
def restore(
    file: Annotated[Path, typer.Argument(help="An archive that backup made.")],
    data: Annotated[Path, typer.Option("--data", help="A new directory, or an empty one.")],
    json: Json = False,
) -> None:
    """Put a backup back, into a directory of its own."""
    from app.commands.backup import run_restore as run

    raise typer.Exit(run(file, data, json))


@database.command()
def upgrade(data: Data = None) -> None:
    """Bring the database to the present revision."""
    from app.db import upgrade as run
    from app.settings import Settings

    run(Settings().data_dir if data is None else data)


@audit.command()
def verify(data: Data = None, json: Json = False) -> None:
    """Check that every row of the audit is as it was entered, and none is gone.

    Ends with 0 intact, 1 broken, 2 nothing to check.
    """
    from app.commands.audit import verify as run

    raise typer.Exit(run(data, json))


@audit.command("list")
def list_audit(
    data: Data = None,
    who: Annotated[str | None, typer.Option(help="The name of who did it.")] = None,
    action: Annotated[str | None, typer.Option(help="Or its beginning: tests")] = None,
    target: Annotated[str | None, typer.Option(help="What it was done to.")] = None,
    search: Annotated[str, typer.Option(help="Beginnings of words.")] = "",
    limit: Annotated[int, typer.Option(min=1, max=100_000)] = 50,
    json: Json = False,
) -> None:
    """Print the newest entries of the audit, the newest first."""
    from app.audit.sought import Sought
    from app.commands.audit import list_entries as run

    sought = Sought(who=who, action=action, target=target, search=search)
    raise typer.Exit(run(data, sought, limit, json))


def main() -> None:
    """The entry point of `forcerig`."""
    cli()
