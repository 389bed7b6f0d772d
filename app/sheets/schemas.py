"""The sheets as requests and `--json` give them: curves are lists of one length, null where there is no number."""

from pydantic import BaseModel

Curve = list[float | None]


class OrificeCurves(BaseModel):
    """An orifice over the valve command: load pressure, force, its slope, and the flow past the piston."""

    orifice_diameter_m: float
    load_pressure_pa: Curve
    force_n: Curve
    force_gain_n: Curve
    bypass_flow_m3_s: Curve


class StaticSheet(BaseModel):
    """The static characteristic (figure 5), the rod end fixed."""

    pressure_pa: float
    in_force_diameter_m: float
    valve_command: Curve
    orifices: list[OrificeCurves]


class LoopResponse(BaseModel):
    """A frequency response at the frequencies of its sheet; the phase goes on beyond ±180°."""

    gain_db: Curve
    phase_deg: Curve


class LoopExtreme(BaseModel):
    """A peak or a dip within the band of a response."""

    frequency_hz: float
    gain_db: float


class MarginsOut(BaseModel):
    """Of an open loop; null where it does not cross. The gain margin is at `turnover_hz`."""

    crossover_hz: float | None
    phase_margin_deg: float | None
    gain_margin_db: float | None
    worst_sensitivity: float
    turnover_hz: float | None


class LoopAt(BaseModel):
    """The force loop for a load of one amplitude: eqs (6) to (8), margins, responses; null for no peak or dip."""

    amplitude_n: float
    mean_n: float
    k_1_n: float
    k_2_n_s_m: float
    tau_s: float
    margins: MarginsOut
    open_loop: LoopResponse
    closed_loop: LoopResponse
    peak: LoopExtreme | None
    dip: LoopExtreme | None


class LinearSheet(BaseModel):
    """The loop at every amplitude; `load_hz` where the compensation is in it."""

    load_hz: float | None
    frequencies_hz: Curve
    loops: list[LoopAt]


class Tuning(BaseModel):
    """FF_V and FF_A with which the branch is exact at one frequency, and W there, s/m."""

    frequency_hz: float
    ff_v: float
    ff_a: float
    gain: float
    phase_deg: float


class LoopBeside(BaseModel):
    """The open loop with the branch and without it."""

    response: LoopResponse
    margins: MarginsOut


class CompensatorSheet(BaseModel):
    """The branch part by part (figure 11), the loop with it and without, and what it leaves of a motion.

    `whole` is the three filters together, `compensation` those with FF_V and FF_A behind them (re 1 s/m);
    `disturbance_db` is the force that a motion makes, with the branch over without it.
    """

    load_hz: float
    amplitude_n: float
    mean_n: float
    frequencies_hz: Curve
    lead: LoopResponse
    low_pass: LoopResponse
    notch: LoopResponse
    whole: LoopResponse
    compensation: LoopResponse
    with_branch: LoopBeside
    without_branch: LoopBeside
    disturbance_db: Curve
    tuning: Tuning | None
