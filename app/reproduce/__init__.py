"""The figures of the paper, computed by the very tick on the virtual rig, beside the paper's numbers."""
