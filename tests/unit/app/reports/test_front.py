"""The first page: what it says of the rig that a run was made on."""

from datetime import UTC, datetime

from app.reports.sections.front import _rig
from app.revisions.kind import Revision
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.record import frozen

MADE_AT = datetime(2026, 3, 1, tzinfo=UTC)


def test_a_certificate_that_no_longer_held_on_the_day_of_the_run_is_called_overdue() -> None:
    dates = {"gain": 6e3, "calibrated_on": "2025-02-01", "due_on": "2026-02-01"}
    document = RigConfiguration.model_validate({"calibrations": {"load_cell": dates}})
    kept = frozen(Revision(4, document, "Ann", "New cell", MADE_AT))
    told = dict(_rig(kept, MADE_AT))
    assert told["Overdue"] == "calibration of load cell overdue since 2026-02-01"
    assert told["Rig configuration"] == "revision 4"
    assert dict(_rig(kept, datetime(2026, 1, 31, tzinfo=UTC)))["Overdue"] == ""
