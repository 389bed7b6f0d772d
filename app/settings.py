"""Settings of the backend: from the command line, or from environment variables `FORCERIG_…`."""

from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

VERSION = version("forcerig")


class Settings(BaseSettings):
    """Where the console listens, where it keeps its data, and how it starts the loop."""

    model_config = SettingsConfigDict(env_prefix="FORCERIG_", frozen=True, extra="forbid")

    host: str = "127.0.0.1"
    port: Annotated[int, Field(ge=0, le=65535)] = 8000  # 0: any free one
    stop_port: Annotated[int, Field(ge=0, le=65535)] | None = None  # None: the one after `port`
    data_dir: Path = Path("data")
    database_url: str | None = None  # None: SQLite in the data directory
    tls_cert: Path | None = None  # with its key: the console speaks HTTPS
    tls_key: Path | None = None
    plain_http: bool = False  # without TLS, even where other machines reach it
    allowed_hosts: tuple[str, ...] = ()  # names besides localhost under which browsers come
    rig_file: Path | None = None  # of the simulated rig; None: the rig of the paper
    rig_configuration_file: Path | None = (
        None  # what is known of the rig; None: the newest revision
    )
    controller_file: Path | None = None  # None: as shipped, as for the interlocks
    interlocks_file: Path | None = None
    report_logo: Path | None = None  # SVG, PNG or JPEG, on the first page of reports
    report_template: Path | None = None  # typst; None: ours (app/reports/template/report.typ)
    seed: Annotated[int, Field(ge=0)] = 0
    margin_us: Annotated[int, Field(ge=0, le=1_000)] = 60
    reserve_bytes: Annotated[int, Field(ge=0)] = 256_000_000  # of the disk, never for samples
    cpu: Annotated[int, Field(ge=0)] | None = None  # the processor that the loop keeps to itself

    @property
    def database_address(self) -> str:
        """The URL of the database."""
        return self.database_url or f"sqlite:///{self.data_dir.resolve() / 'forcerig.sqlite'}"

    @property
    def runs_dir(self) -> Path:
        """Where the samples of the runs are kept, a folder a run."""
        return self.data_dir.resolve() / "runs"

    @property
    def first_outs_dir(self) -> Path:
        """Where the black boxes of the first-outs are kept, a folder each."""
        return self.data_dir.resolve() / "first-outs"

    @property
    def drills_dir(self) -> Path:
        """Where the samples of the drills are kept, a file each."""
        return self.data_dir.resolve() / "drills"

    @property
    def exports_dir(self) -> Path:
        """Where exports are made, and kept for a while."""
        return self.data_dir.resolve() / "exports"

    @property
    def histories_dir(self) -> Path:
        """Where time histories are kept, a folder each."""
        return self.data_dir.resolve() / "histories"
