"""Runs the migrations on the connection that the app gives, in its one transaction."""

from alembic import context

import app.access.models
import app.audit.models
import app.catalogue.models
import app.controller.models
import app.drills.models
import app.first_outs.models
import app.identification.models
import app.interlocks.models
import app.rig_configuration.models
import app.runs.models
import app.storage.models  # noqa: F401
from app.db import Base

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=Base.metadata,
    render_as_batch=True,
)
with context.begin_transaction():
    context.run_migrations()
