"""`forcerig analyse …`, as typer sees it."""

from pathlib import Path
from typing import Annotated, Any

import typer

analyse = typer.Typer(
    help="What a rig and its controller can do, and what runs tell.", no_args_is_help=True
)

Json = Annotated[bool, typer.Option("--json", help="One JSON document on standard output.")]
Csv = Annotated[bool, typer.Option("--csv", help="A table with units in its header.")]
RigFile = Annotated[Path | None, typer.Option(help="Rig parameters that differ from the shipped.")]
Settings = Annotated[Path | None, typer.Option(help="Controller settings; as shipped without.")]
MeanN = Annotated[float, typer.Option("--mean-n", help="Mean of the load, N.")]
FromHz = Annotated[float | None, typer.Option("--from-hz", help="Lowest frequency.")]
ToHz = Annotated[float | None, typer.Option("--to-hz", help="Highest frequency.")]
Points = Annotated[int | None, typer.Option(help="Of each curve.")]


def _given(**values: Any) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value not in (None, [])}


@analyse.command()
def static(
    orifice_diameter_m: Annotated[
        list[float] | None, typer.Option(help="Of the bypass; may be given again.")
    ] = None,
    pressure_pa: Annotated[
        float | None, typer.Option(help="Pump to tank.", show_default="of the rig")
    ] = None,
    points: Points = None,
    rig: RigFile = None,
    json: Json = False,
    csv: Csv = False,
) -> None:
    """Static characteristic and force gain for bypass orifices (figure 5)."""
    from app.commands.analyse import Subject
    from app.commands.analyse import static as run

    given = _given(orifice_diameter_m=orifice_diameter_m, pressure_pa=pressure_pa, points=points)
    raise typer.Exit(run(Subject(rig, None, json, csv), given))


@analyse.command()
def linear(
    amplitude_n: Annotated[
        list[float] | None,
        typer.Option(help="Of the load; may be given again.", show_default="1, 2, 5, 10 kN"),
    ] = None,
    mean_n: MeanN = 0.0,
    load_hz: Annotated[
        float | None, typer.Option(help="Frequency of the load: puts the compensation in.")
    ] = None,
    from_hz: FromHz = None,
    to_hz: ToHz = None,
    points: Points = None,
    bode: Annotated[
        bool, typer.Option("--bode", help="Responses instead of margins, where not as JSON.")
    ] = False,
    rig: RigFile = None,
    controller: Settings = None,
    json: Json = False,
    csv: Csv = False,
) -> None:
    """K_1, K_2, τ, margins, open and closed loop at every amplitude."""
    from app.commands.analyse import Subject
    from app.commands.analyse import linear as run

    given = _given(amplitude_n=amplitude_n, mean_n=mean_n, load_hz=load_hz)
    given |= _given(from_hz=from_hz, to_hz=to_hz, points=points)
    raise typer.Exit(run(Subject(rig, controller, json, csv), given, bode))


@analyse.command()
def compensator(
    load_hz: Annotated[
        float | None, typer.Option(help="Frequency of the load.", show_default="40")
    ] = None,
    amplitude_n: Annotated[
        float | None, typer.Option(help="Of the load.", show_default="3000")
    ] = None,
    mean_n: MeanN = 0.0,
    tune_hz: Annotated[
        float | None, typer.Option(help="Tell the gains that are exact at this frequency.")
    ] = None,
    from_hz: FromHz = None,
    to_hz: ToHz = None,
    points: Points = None,
    rig: RigFile = None,
    controller: Settings = None,
    json: Json = False,
    csv: Csv = False,
) -> None:
    """Each filter of the compensation, and the loop with it and without (figure 11)."""
    from app.commands.analyse import Subject
    from app.commands.analyse import compensator as run

    given = _given(load_hz=load_hz, amplitude_n=amplitude_n, mean_n=mean_n, tune_hz=tune_hz)
    given |= _given(from_hz=from_hz, to_hz=to_hz, points=points)
    raise typer.Exit(run(Subject(rig, controller, json, csv), given))


@analyse.command("frequency-response")
def frequency_response(
    run: Annotated[Path, typer.Argument(help="A run's Parquet file.")],
    transfer: Annotated[
        str | None,
        typer.Option(
            help="force, plant, motion, disturbance, compliance, position, stiffness, admittance or loop.",
            show_default="force, or the first that the run has",
        ),
    ] = None,
    load_hz: Annotated[
        float | None,
        typer.Option(min=0.1, max=1999.0, help="Of the open loop: under a load of this frequency."),
    ] = None,
    estimator: Annotated[
        str | None,
        typer.Option(
            help="Averaged spectra of the whole record, whatever the test: h1, h2 or hv, where noise"
            " is on the output, the input or both; reference (the setpoint) for what is fed back.",
            show_default="the points that the test asks for",
        ),
    ] = None,
    segment_s: Annotated[
        float,
        typer.Option(min=0.01, max=1000.0, help="Of a spectrum: 1/segment is its resolution."),
    ] = 1.0,
    json: Json = False,
    csv: Csv = False,
) -> None:
    """Every point that a run measured, with its 95 % intervals, and extremes (figure 12) or margins."""
    from app.commands.printed import Printed
    from app.commands.run_responses import Asked
    from app.commands.run_responses import frequency_response as tell
    from app.commands.run_spectra import Spectral

    spectral = None if estimator is None else Spectral(estimator, segment_s)
    raise typer.Exit(tell(run, Asked(transfer, load_hz, spectral), Printed(json, csv)))


@analyse.command()
def goodness(
    run: Annotated[Path, typer.Argument(help="A run's Parquet file.")],
    against: Annotated[
        Path | None,
        typer.Option(help="Another run of the same test.", show_default="its own setpoint"),
    ] = None,
    json: Json = False,
) -> None:
    """G of equation (4): how well the force follows its setpoint, or that of another run."""
    from app.commands.run_analyses import goodness as tell

    raise typer.Exit(tell(run, against, json))


@analyse.command()
def unit(
    run: Annotated[Path, typer.Argument(help="A run's Parquet file.")], json: Json = False
) -> None:
    """Static stiffness, hysteresis and backlash of the unit under test, from slow cycles of 2 Hz or less."""
    from app.commands.run_analyses import unit as tell

    raise typer.Exit(tell(run, json))


@analyse.command()
def identification(
    runs: Annotated[list[Path], typer.Argument(help="Parquet files of runs of one rig.")],
    rig: Annotated[
        Path | None, typer.Option(help="Rig to begin with.", show_default="the shipped one")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Write the fitted rig to this file.")] = None,
    json: Json = False,
) -> None:
    """Parameters of the rig model fitted to runs, with 95 % intervals and what cannot be told apart."""
    from app.commands.identification import identification as tell

    raise typer.Exit(tell(runs, rig, out, json))
