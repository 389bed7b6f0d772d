"""The figures that can be reproduced, by name."""

from collections.abc import Mapping

from app.reproduce import figure_5, figure_6, figure_7, figure_9, figure_11, figure_12
from app.reproduce.made import Make

FIGURES: Mapping[str, Make] = {
    "figure-5": figure_5.make,
    "figure-6": figure_6.make,
    "figure-7": figure_7.make,
    "figure-9": figure_9.make,
    "figure-11": figure_11.make,
    "figure-12": figure_12.make,
}
