"""What the console writes to its log."""

import logging

# After it, uvicorn closes the stream with 1007.
_OF_A_CLIENT = "Invalid UTF-8 sequence received from client."


def begin_log() -> None:
    """Log to stderr, a line an entry; of the server and the migrations only what is wrong."""
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)-7s %(message)s")
    for chatty in ("uvicorn.error", "alembic"):
        logging.getLogger(chatty).setLevel(logging.WARNING)
    logging.getLogger("uvicorn.error").addFilter(_in_one_line)


def _in_one_line(record: logging.LogRecord) -> bool:
    """What a client sent wrong is no fault of ours: where uvicorn saw it fills no log."""
    if record.msg == _OF_A_CLIENT:
        record.levelno, record.levelname, record.exc_info = logging.WARNING, "WARNING", None
    return True
