"""The metrics of this console, in a registry of their own: nothing of the process beside them."""

from collections.abc import Iterator

from prometheus_client import CollectorRegistry, generate_latest
from prometheus_client.core import Metric
from prometheus_client.registry import Collector

from app.metrics.facts import Sources
from app.metrics.families import families


class Metrics(Collector):
    """Counts nothing itself: each scrape looks at what is counted anyway."""

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._registry = CollectorRegistry()
        self._registry.register(self)

    def describe(self) -> Iterator[Metric]:
        """Nothing: so that to register looks at nothing."""
        return iter(())

    def collect(self) -> Iterator[Metric]:
        """As things are now."""
        return families(self._sources.facts())

    def text(self) -> bytes:
        """In Prometheus's text format."""
        return generate_latest(self._registry)
