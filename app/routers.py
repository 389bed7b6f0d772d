"""Every router of the interface, in the order in which their routes are looked through."""

from fastapi import APIRouter

from app.access.credentials_router import router as credentials_router
from app.access.router import router as auth_router
from app.access.sign_in_page import router as sign_in_router
from app.access.users_router import router as users_router
from app.audit.router import router as audit_router
from app.authority.router import router as lease_router
from app.catalogue.router import router as tests_router
from app.catalogue.texts_router import router as texts_router
from app.comparison.router import router as comparison_router
from app.controller.preview_router import router as controller_preview_router
from app.controller.router import router as controller_router
from app.drills.router import router as drills_router
from app.exports.router import router as exports_router
from app.first_outs.again_router import router as first_outs_again_router
from app.first_outs.router import router as first_outs_router
from app.health import router as health_router
from app.histories.router import router as histories_router
from app.identification.router import router as identification_router
from app.interlocks.router import router as interlocks_router
from app.live.router import router as live_router
from app.metrics.router import router as metrics_router
from app.prediction.router import router as predictions_router
from app.reports.router import router as reports_router
from app.rig_configuration.router import router as rig_configuration_router
from app.rigs.router import router as rig_router
from app.run_analysis.router import router as run_analysis_router
from app.runs.predicted_router import router as predicted_router
from app.runs.response_router import router as response_router
from app.runs.results_router import router as results_router
from app.runs.router import router as runs_router
from app.runs.samples_router import router as samples_router
from app.scene.router import router as scene_router
from app.sheets.router import router as sheets_router
from app.storage.router import router as storage_router
from app.system.router import router as system_router

ROUTERS: tuple[APIRouter, ...] = (
    health_router,
    metrics_router,
    rig_router,
    lease_router,
    texts_router,
    predictions_router,
    tests_router,
    histories_router,
    reports_router,
    comparison_router,  # before the runs: theirs would take its paths for numbers
    runs_router,
    samples_router,
    exports_router,
    results_router,
    response_router,
    predicted_router,
    run_analysis_router,
    storage_router,
    first_outs_router,
    drills_router,
    first_outs_again_router,
    audit_router,
    system_router,
    interlocks_router,
    controller_router,
    controller_preview_router,
    sheets_router,
    rig_configuration_router,
    identification_router,
    live_router,
    scene_router,
    auth_router,
    users_router,
    credentials_router,
    sign_in_router,
)
