"""The live stream: every sample, status and event to every browser, and no browser holds up another."""
