"""What all tests share: property tests know no deadline, for compiling and noisy machines break any."""

from hypothesis import settings

settings.register_profile("forcerig", deadline=None)
settings.load_profile("forcerig")
