"""The control law of the paper, as small pure kernels: PID, feed-forward, kinematic compensation."""
