"""Enumerations of the loop as the words that people write."""

from collections.abc import Mapping
from enum import IntEnum
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from app.documents.fields import wrong
from app.documents.messages import nearest


class ByName:
    """Annotates an IntEnum that documents write as the lower-case name of its member.

    `gone` says of names that there are no more what to write instead.
    """

    def __init__(self, members: type[IntEnum], gone: Mapping[str, str] | None = None) -> None:
        self.type = members
        self.gone = gone or {}
        self.members = {member.name.lower(): member for member in members}

    def read(self, value: Any) -> IntEnum:
        """The member of this name, or the member itself."""
        if isinstance(value, str) and value in self.members:
            return self.members[value]
        if isinstance(value, self.type):
            return value
        if isinstance(value, str) and value in self.gone:
            raise wrong("", self.gone[value], value=value)
        guess = nearest(value, self.members) if isinstance(value, str) else ""
        raise wrong("", f"must be one of {', '.join(self.members)}{guess}", value=value)

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        written = core_schema.plain_serializer_function_ser_schema(lambda m: m.name.lower())
        return core_schema.no_info_plain_validator_function(self.read, serialization=written)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "string", "enum": list(self.members)}
