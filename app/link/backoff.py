"""How long to wait before a loop that died is started again."""

from dataclasses import dataclass

FIRST_S = 0.25
LONGEST_S = 30.0
GOOD_LIFE_S = 20.0


@dataclass
class Backoff:
    """Doubles its pause with each short life; a good life takes it back to the first."""

    pause_s: float = 0.0

    def died(self, lived_s: float) -> float:
        """The pause after a life of so many seconds."""
        longer_s = min(max(FIRST_S, 2.0 * self.pause_s), LONGEST_S)
        self.pause_s = FIRST_S if lived_s >= GOOD_LIFE_S else longer_s
        return self.pause_s
