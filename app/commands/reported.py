"""The report of a simulation, for `forcerig simulate --report`."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from app.errors import Code, Refusal
from app.prediction.simulation import Simulating
from app.reports.branding import branding
from app.reports.orders import Format
from app.settings import Settings

FORMATS = {f".{form.value}": form for form in Format}


@dataclass(frozen=True)
class Reporting:
    """Where the ticks are written to while the test runs, if anywhere, and the report afterwards."""

    test: str
    kept: Path | None
    recorded: Path | None
    report: Path | None

    def write(self, simulating: Simulating) -> Refusal | None:
        """The report, where one was asked for."""
        if self.report is None or self.recorded is None:
            return None
        from app.reports.collect import collect  # what draws takes half a second to load
        from app.reports.making import write
        from app.reports.of_simulation import subject_of_simulation

        settings = Settings()
        look = branding(settings.report_logo, settings.report_template)
        if isinstance(look, Refusal):
            return look
        subject = subject_of_simulation(simulating, self.test, self.recorded, self.kept)
        form = FORMATS[self.report.suffix.lower()]
        try:
            return write(collect(subject), look, form, self.report)
        except OSError as error:
            detail = f"--report: cannot write {self.report}: {error.strerror}"
            return Refusal(Code.INVALID_REQUEST, detail)


@contextmanager
def reporting(test: str, out: Path | None, report: Path | None) -> Iterator[Reporting]:
    """The ticks are in the file that was asked for, else in one that is gone afterwards."""
    if report is None or out is not None:
        yield Reporting(test, out, out, report)
        return
    with TemporaryDirectory(prefix="forcerig-report-") as folder:
        yield Reporting(test, None, Path(folder) / "run.parquet", report)
