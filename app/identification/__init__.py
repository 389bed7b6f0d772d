"""Identification: the physical parameters of the rig model, fitted to what was recorded of the rig."""
