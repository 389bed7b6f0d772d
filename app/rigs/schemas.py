"""What the requests about the rig take and give; the status is on the live stream too."""

from enum import StrEnum

from pydantic import BaseModel, ConfigDict

from app.authority.schemas import Epoch, LeaseOut
from app.storage.schemas import StorageState
from rtcore.modes import Mode


class ModeWord(StrEnum):
    """State of the loop; `starting` until its first sign of life, `lost` without one."""

    TRIPPED = "tripped"
    OFF = "off"
    PRESSURISING = "pressurising"
    READY = "ready"
    RUNNING = "running"
    HOLDING = "holding"
    STOPPING = "stopping"
    STARTING = "starting"
    LOST = "lost"

    @staticmethod
    def of(mode: Mode) -> "ModeWord":
        return ModeWord(mode.name.lower())


class RigCommand(StrEnum):
    """What an operator may ask of the rig. Starting a run is its own request."""

    RESET = "reset"
    PRESSURISE = "pressurise"
    DEPRESSURISE = "depressurise"
    TARE = "tare"
    HOLD = "hold"
    RESUME = "resume"
    STOP = "stop"
    SHUTDOWN = "shutdown"


class CommandRequest(BaseModel):
    """A command to the rig. Without `lease` it bears the epoch that the caller holds."""

    model_config = ConfigDict(extra="forbid")

    command: RigCommand
    lease: Epoch | None = None


class CommandDone(BaseModel):
    """The loop has taken the command in this tick."""

    command: RigCommand
    tick: int


class Trip(BaseModel):
    """A detector that has tripped; `first` for the one that took the load off first.

    What `blocks` keeps the rig from being pressurised, started or resumed; an indication does not.
    """

    code: str
    text: str
    tick: int
    first: bool
    blocks: bool


class Condition(BaseModel):
    """A real-time condition of the loop: whether it was had, and what was got or why not."""

    name: str
    had: bool
    reason: str


class LoopHealth(BaseModel):
    """The loop process. Times are over its whole life; null beyond the histogram's 1 ms."""

    alive: bool
    data_age_s: float | None
    tick: int
    rate_hz: float | None
    pid: int | None
    deadlines_missed: int
    realtime: bool
    wakeup_latency_p50_s: float | None
    wakeup_latency_p99_s: float | None
    wakeup_latency_max_s: float | None
    tick_time_p50_s: float | None
    tick_time_p99_s: float | None
    tick_time_max_s: float | None
    conditions: list[Condition]


class RunProgress(BaseModel):
    """The run under way; `block` counts from 0, -1 outside of every block.

    `elapsed_s` and `duration_s` are of its program: that stands still in a hold, and jumps where a frequency
    response goes on early. `recorded_s` is how much of the run is recorded.
    """

    id: int
    test_name: str
    block: int
    blocks: int
    cycle: int
    cycles: int | None
    elapsed_s: float
    duration_s: float | None
    recorded_s: float


class RecorderOut(BaseModel):
    """The recorder; `trouble` says why it cannot write, null where it can."""

    recording: bool
    lost_ticks: int
    bytes: int
    trouble: str | None


class CommandReasons(BaseModel):
    """Why a command cannot be given now, null where it can."""

    reset: str | None
    pressurise: str | None
    depressurise: str | None
    tare: str | None
    start: str | None
    hold: str | None
    resume: str | None
    stop: str | None
    shutdown: str | None


class Limits(BaseModel):
    """What the detectors in force allow; the supply's is what the pump gives. Null for no limit."""

    force_n: float | None
    force_error_n: float | None
    displacement_m: float | None
    velocity_m_s: float | None
    supply_pressure_pa: float | None


class Permissive(BaseModel):
    """Something that has to be so for a test to start; `text` says what it needs where it is not."""

    name: str
    met: bool
    text: str


class ResumePreview(BaseModel):
    """The setpoints that Resume would lead through, from that moment on: least and greatest of each."""

    time_s: list[float]
    force_min_n: list[float]
    force_max_n: list[float]
    displacement_min_m: list[float]
    displacement_max_m: list[float]
    block: int
    cycle: int
    text: str


class Chain(BaseModel):
    """The hard-wired chain; null where nothing is known of it."""

    closed: bool | None


class RigStatus(BaseModel):
    """Everything that is always on the screen.

    `injected` names the faults that the simulated rig has been given. `lease` is null where nobody is in command,
    `stop_url` where Stop has no path of its own.
    """

    mode: ModeWord
    mode_since_s: float | None
    readings: dict[str, float | None]
    limits: Limits
    trips: list[Trip]
    loop: LoopHealth
    run: RunProgress | None
    recorder: RecorderOut
    storage: StorageState
    permissives: list[Permissive]
    commands: CommandReasons
    chain: Chain
    injected: list[str]
    lease: LeaseOut | None
    stop_url: str | None


class ChannelOut(BaseModel):
    """A channel of the telemetry; `dtype` as NumPy writes it."""

    name: str
    unit: str
    dtype: str
    doc: str
