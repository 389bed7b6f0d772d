"""Who is at work. A request's access sets it; the console's own threads are nobody else."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Actor:
    """Somebody as the audit names them: `id` is the credential that they came with."""

    name: str
    role: str
    id: str


CONSOLE = Actor("console", "console", "console")

# Set it in an async dependency: one that runs in a thread would set it in a copy. A thread that
# works for a request needs the request's context (`contextvars.copy_context().run`).
actor: ContextVar[Actor] = ContextVar("actor", default=CONSOLE)


@contextmanager
def acting(who: Actor) -> Iterator[None]:
    """What is done in this block is done by them."""
    before = actor.set(who)
    try:
        yield
    finally:
        actor.reset(before)
