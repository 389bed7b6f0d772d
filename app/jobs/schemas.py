"""What is told of a job."""

from datetime import datetime
from typing import Any

from pydantic import BaseModel

from app.jobs.jobs import Job, JobState


class JobOut(BaseModel):
    """How far long work is; `reason` says why nothing came of it."""

    id: str
    title: str
    made_at: datetime
    state: JobState
    share: float
    seconds_left: float | None
    reason: str | None

    @staticmethod
    def of(job: Job[Any]) -> "JobOut":
        fields = {name: getattr(job, name) for name in JobOut.model_fields}
        return JobOut.model_validate(fields)
