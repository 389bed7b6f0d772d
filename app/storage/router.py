"""`/api/v1/storage`."""

from typing import Annotated

from fastapi import APIRouter, Query

from app.access.dependencies import Engineer, Viewer
from app.dependencies import StorageService
from app.problems import PROBLEMS, granted
from app.storage.rule import Limits
from app.storage.schemas import (
    RetentionChange,
    RetentionOut,
    RetentionPreview,
    StorageOut,
    Tag,
)

router = APIRouter(prefix="/api/v1/storage", tags=["storage"], responses=PROBLEMS)


@router.get("", operation_id="getStorage")
def get_storage(who: Viewer, storage: StorageService) -> StorageOut:
    """The disk, what runs use of it, and how long samples are kept."""
    return storage.overview()


@router.get("/retention/preview", operation_id="previewRetention")
def preview_retention(
    who: Viewer,
    storage: StorageService,
    keep_days: Annotated[float | None, Query(gt=0, le=36_500, allow_inf_nan=False)] = None,
    keep_bytes: Annotated[int | None, Query(ge=0, le=2**53)] = None,
    keep_tags: Annotated[list[Tag] | None, Query(max_length=100)] = None,
) -> RetentionPreview:
    """Which runs' samples a rule would remove now; the rule in force, where none is given."""
    if keep_days is None and keep_bytes is None:
        return storage.retention.preview()
    return storage.retention.preview(Limits(keep_days, keep_bytes, tuple(keep_tags or ())))


@router.put("/retention", operation_id="changeRetention")
def change_retention(who: Engineer, body: RetentionChange, storage: StorageService) -> RetentionOut:
    """Give another rule. It is applied once a day, and at once where `apply` is true."""
    return granted(storage.retention.change(body))
