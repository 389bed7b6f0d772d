"""YAML and JSON documents that people write, read into frozen models or usefully refused."""
