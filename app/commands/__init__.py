"""The commands of `forcerig`; `app.cli` says which there are. Imported when one is given."""
