"""Example tests as YAML; `app.definitions.library` reads them."""
