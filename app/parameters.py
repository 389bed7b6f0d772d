"""What requests of many kinds take in their path and query."""

from typing import Annotated

from fastapi import Path, Query

from app.definitions.preview import MOST_POINTS

LARGEST = 2**53  # that JavaScript holds exactly

Number = Annotated[int, Path(ge=1, le=LARGEST)]
Limit = Annotated[int, Query(ge=1, le=200)]
Before = Annotated[
    int | None, Query(ge=1, le=LARGEST, description="the last number of the page before")
]

Channels = Annotated[str, Query(max_length=2000, description="names, with commas between")]
Points = Annotated[int, Query(ge=1, le=MOST_POINTS)]
Elapsed = Annotated[float, Query(ge=0, le=1e9, allow_inf_nan=False)]  # s, from a beginning
Apart = Annotated[float, Query(ge=-1e9, le=1e9, allow_inf_nan=False)]  # s, negative before


def names_in(channels: str) -> list[str]:
    """The names that `Channels` has commas between."""
    return [name.strip() for name in channels.split(",") if name.strip()]
