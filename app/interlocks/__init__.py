"""The interlocks: which detectors watch the rig, and what the loop gets of them."""
