"""What `forcerig doctor` says, without the probe: a second loop would take time from the first."""

from app.link.life import Life
from app.system.schemas import Diagnosis, FindingOut
from app.system.timing import figures
from rtcore.doctor import of_conditions, of_wakeups, verdict_of
from rtcore.machine import findings

_OF_THE_LOOP = (
    "Wake-ups are those of the running loop since its start, with its margin. No probe was started, as "
    "it would disturb the loop: stop the console and run `forcerig doctor` for wake-ups without margin "
    "and for the time that a host takes."
)
_NO_LOOP = "No loop runs, so no wake-ups are judged: run `forcerig doctor`, which measures them with a probe."


def diagnose(life: Life | None) -> Diagnosis:
    """Look at the machine, and at the loop that runs on it."""
    found = list(findings())
    if life is not None:
        counted = figures(life)
        found += of_conditions(counted.conditions)
        if counted.ticks:
            found.append(of_wakeups("wakeups_of_the_loop", counted))
    verdict, sentence = verdict_of(found)
    return Diagnosis(
        verdict=verdict.value,
        sentence=sentence,
        findings=[
            FindingOut(name=name, seen=seen, grade=grade.name.lower(), advice=advice)
            for name, seen, grade, advice in found
        ],
        measured=_NO_LOOP if life is None else _OF_THE_LOOP,
    )
