"""A model as a document: YAML that this version and every other YAML reader understand, or JSON."""

import json
from typing import Any

import yaml
from pydantic import BaseModel

from app.documents.tree import CORE_FLOAT


class _Dumper(yaml.SafeDumper):
    """Quotes what YAML 1.1 or 1.2 would read as something other than text."""


_ODD_BREAKS = set("\x85\u2028\u2029")  # PyYAML folds them like line ends, unless quoted twice


def _text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = '"' if _ODD_BREAKS & set(text) else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style)


_Dumper.add_representer(str, _text)
_Dumper.add_implicit_resolver("tag:yaml.org,2002:float", CORE_FLOAT, list("-+0123456789."))


def to_data(model: BaseModel) -> dict[str, Any]:
    """Plain data. What is None is left out; defaults are kept, so that they stay as they were."""
    return model.model_dump(mode="json", by_alias=True, exclude_none=True)


def to_yaml(model: BaseModel) -> str:
    """The document as YAML."""
    return data_to_yaml(to_data(model))


def data_to_yaml(data: Any) -> str:
    """Plain data as YAML."""
    return yaml.dump(
        data,
        Dumper=_Dumper,
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=None,  # a block with nothing nested stands on one line
        width=100,
    )


def to_json(model: BaseModel) -> str:
    """The document as JSON."""
    return json.dumps(to_data(model), indent=2, ensure_ascii=False, allow_nan=False)
