"""What the requests about the audit give."""

import json
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, WithJsonSchema


def _read(text: str | None) -> Any:
    """What a row that somebody has garbled holds is shown as it is."""
    try:
        return None if text is None else json.loads(text)
    except ValueError:
        return text


Json = Annotated[Any, BeforeValidator(_read)]
Time = Annotated[str, WithJsonSchema({"type": "string", "format": "date-time"})]


class AuditEntry(BaseModel):
    """Who did what, when and why. `outcome` is "done", or "refused: " and the code of the refusal.

    `before` and `after` are what that kind of act changes; secrets are redacted.
    """

    model_config = ConfigDict(from_attributes=True)

    id: int
    at: Time
    who: str
    role: str
    credential: str
    action: str
    target: str
    why: str | None
    before: Json
    after: Json
    outcome: str
    previous_hash: str
    hash: str


class AuditPage(BaseModel):
    """Entries, the newest first; `next` is `before` of the page after this one."""

    entries: list[AuditEntry]
    next: int | None


class Verification(BaseModel):
    """Whether the chain is intact; `broken_id` is the first row that is not.

    `hash` is that of the newest row that is in order: kept elsewhere, it proves all rows up to it.
    `behind` is by how many rows the file of the chain's end lags, after a kill.
    """

    rows: int
    intact: bool
    broken_id: int | None
    detail: str
    hash: str
    behind: int
