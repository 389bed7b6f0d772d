"""What a monitoring system asks for: the console and its loop as Prometheus metrics."""
