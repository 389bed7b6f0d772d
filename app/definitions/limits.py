"""What the rig can do and what a test may ask for, declared once."""

from pydantic import Field

from app.documents.fields import Document


class RigLimits(Document):
    """Limits that a definition is held against before anything moves."""

    force_limit_n: float = Field(default=50_000.0, gt=0, description="rated force, either way")
    stroke_limit_m: float = Field(default=0.03, gt=0, description="unit under test, either way")
    velocity_limit_m_s: float = Field(default=0.2, gt=0, description="unit under test")
    loop_rate_hz: float = Field(default=4000.0, gt=0)
    force_rate_limit_n_s: float = Field(default=2e6, gt=0, description="except in a step or a sine")
    force_bandwidth_hz: float = Field(
        default=150.0, gt=0, description="of a time history: the servovalve is down 3 dB at 187 Hz"
    )
    motion_bandwidth_hz: float = Field(
        default=12.0, gt=0, description="of a time history: the position servo's natural frequency"
    )
    force_rate_floor_n_s: float = Field(default=1.0, gt=0, description="slower is a hold")
    velocity_floor_m_s: float = Field(default=1e-6, gt=0, description="slower is a hold")
    duration_limit_s: float = Field(default=366 * 86_400.0, gt=0)
    cycle_limit: int = Field(default=2**31 - 1, gt=0, description="of a block; telemetry is int32")
    repeat_limit: int = Field(default=10_000_000, gt=0)
    block_limit: int = Field(default=1000, gt=0, description="in one list; telemetry is int16")
    sample_limit: int = Field(default=100_000, gt=0, description="in a test itself; more in a file")
    response_limit: int = Field(default=2000, gt=0, description="amplitudes times frequencies")
    multisine_limit_s: float = Field(default=100.0, gt=0, description="period of a multisine")

    @property
    def period_s(self) -> float:
        """One tick of the loop."""
        return 1.0 / self.loop_rate_hz

    @property
    def frequency_limit_hz(self) -> float:
        """Half the loop rate: what the loop can still tell from something slower."""
        return 0.5 * self.loop_rate_hz


RIG = RigLimits()
