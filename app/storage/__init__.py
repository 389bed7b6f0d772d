"""Storage: room on the disk, how long samples are kept, backups."""
