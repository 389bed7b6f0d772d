"""`/docs`: the REST interface on a page of its own, which needs no other site and no script."""

from html import escape
from typing import Any

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem }
h2 { border-bottom: 1px solid #999; margin-top: 2rem }
code, pre { font: 13px/1.4 ui-monospace, monospace }
summary { cursor: pointer } .method { display: inline-block; width: 4.5rem; font-weight: 600 }
table { border-collapse: collapse } td, th { text-align: left; padding: 0.1rem 1rem 0.1rem 0;
vertical-align: top }
"""


def docs_page(openapi: dict[str, Any]) -> str:
    """An OpenAPI document as HTML."""
    title = f"{escape(openapi['info']['title'])} {escape(openapi['info']['version'])}"
    groups: dict[str, list[str]] = {}
    for path, operations in openapi["paths"].items():
        for method, operation in operations.items():
            tag = operation.get("tags", ["other"])[0]
            groups.setdefault(tag, []).append(_operation(method, path, operation))
    sections = [f"<h2>{escape(tag)}</h2>{''.join(parts)}" for tag, parts in groups.items()]
    schemas = openapi.get("components", {}).get("schemas", {})
    types = [_schema(name, schema) for name, schema in schemas.items()]
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>'
        f"<style>{_STYLE}</style><h1>{title}</h1>"
        f'<p>{escape(openapi["info"].get("description", ""))} As <a href="/openapi.json">OpenAPI'
        f"</a>.</p>{''.join(sections)}<h2>Types</h2>{''.join(types)}</html>"
    )


def _operation(method: str, path: str, operation: dict[str, Any]) -> str:
    rows = [
        (p["name"], f"{p['in']}: {_type(p['schema'])}", p.get("description", ""))
        for p in operation.get("parameters", [])
    ]
    for body in operation.get("requestBody", {}).get("content", {}).values():
        rows.append(("body", _type(body["schema"]), ""))
    for status, answer in operation["responses"].items():
        types = [_type(c["schema"]) for c in answer.get("content", {}).values() if "schema" in c]
        rows.append((status, ", ".join(types), answer.get("description", "")))
    return (
        f'<details><summary><span class="method">{method.upper()}</span><code>{escape(path)}</code>'
        f" {escape(operation.get('summary', ''))}</summary>"
        f"<p>{escape(operation.get('description', ''))}</p>{_table(rows)}</details>"
    )


def _schema(name: str, schema: dict[str, Any]) -> str:
    rows = [
        (field, _type(inner), inner.get("description", ""))
        for field, inner in schema.get("properties", {}).items()
    ]
    if "enum" in schema:
        rows.append(("one of", ", ".join(str(value) for value in schema["enum"]), ""))
    return (
        f'<details id="{escape(name)}"><summary><code>{escape(name)}</code></summary>'
        f"<p>{escape(schema.get('description', ''))}</p>{_table(rows)}</details>"
    )


def _type(schema: dict[str, Any]) -> str:
    """A schema in a word or two."""
    if "$ref" in schema:
        return str(schema["$ref"]).rsplit("/", 1)[-1]
    if "anyOf" in schema:
        return " | ".join(_type(option) for option in schema["anyOf"])
    if schema.get("type") == "array":
        return f"{_type(schema.get('items', {}))}[]"
    return str(schema.get("const", schema.get("type", "any")))


def _table(rows: list[tuple[str, str, str]]) -> str:
    cells = "".join(
        f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows
    )
    return f"<table>{cells}</table>"
