"""The few colours of every figure: greys, and a dark blue, an ochre and a red that differ in grey too."""

INK, GREY, PALE, GRID = "#1a1a1a", "#7d8287", "#c3c8cc", "#e3e6e8"
MEASURED, ASKED, PREDICTED, LIMIT = "#12476b", "#1a1a1a", "#b06a00", "#a01c1c"
