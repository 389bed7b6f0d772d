"""Who may come in: users and roles, sessions and tokens."""
