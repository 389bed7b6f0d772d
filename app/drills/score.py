"""How a drill went: what is kept of it besides its samples."""

from pydantic import BaseModel


class Expectation(BaseModel):
    """Something that had to be so, whether it was, and what was seen."""

    name: str
    met: bool
    text: str


class Peak(BaseModel):
    """The greatest magnitude of a channel from the fault on; null where nothing of it can be believed."""

    channel: str
    unit: str
    value: float | None
    limit: float | None
    after_s: float | None  # when, from the fault


class Score(BaseModel):
    """Ticks count from the one in which the loop took the fault; null where it did not come to that."""

    first_out: str | None
    action: str | None
    reaction_ticks: int | None  # until the first detector that took the load off
    safe_ticks: int | None  # until the valve was at null and the supply off
    mode_after: str
    peaks: list[Peak]
    expectations: list[Expectation]

    @property
    def passed(self) -> bool:
        """Whether everything was as it had to be."""
        return all(expectation.met for expectation in self.expectations)
