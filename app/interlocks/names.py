"""Enumerations of the loop as the words that people write."""

from enum import IntEnum
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema


class ByName:
    """Annotates an IntEnum that documents write as the lower-case name of its member."""

    def __init__(self, members: type[IntEnum]) -> None:
        self.members = members
        self.names = [member.name.lower() for member in members]

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        words = core_schema.no_info_after_validator_function(
            lambda name: self.members[name.upper()], core_schema.literal_schema(self.names)
        )
        return core_schema.json_or_python_schema(
            json_schema=words,
            python_schema=core_schema.union_schema(
                [core_schema.is_instance_schema(self.members), words]
            ),
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda member: member.name.lower()
            ),
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "string", "enum": self.names}
