"""The system itself: how the loop keeps time, what the machine is fit for, what runs here."""
