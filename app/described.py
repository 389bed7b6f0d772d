"""The OpenAPI document, as the interface really is: a problem comes as one, by its own media type."""

from typing import Any

from fastapi import FastAPI

from app.problems import MEDIA_TYPE


class Described(FastAPI):
    """FastAPI believes that a problem comes as whatever a granted request does."""

    def openapi(self) -> dict[str, Any]:
        """The document, made once."""
        document = super().openapi()
        for operations in document["paths"].values():
            for operation in operations.values():
                refused = operation["responses"]["default"]
                (shape,) = refused["content"].values()
                refused["content"] = {MEDIA_TYPE: shape}
        return document
