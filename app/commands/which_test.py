"""The test that a command was given: a file, or the id of one in the library."""

from pathlib import Path

from app.definitions.definition import Definition
from app.definitions.library import library
from app.definitions.reading import load_definition
from app.documents.messages import nearest
from app.documents.refusal import Problem, refuse
from app.errors import Code, Refusal


def find_definition(test: str) -> Definition | Refusal:
    """The definition in a file, or of the library where the name is no file but an id there."""
    path = Path(test)
    if path.exists() or path.suffix or len(path.parts) > 1:
        return load_definition(path)
    examples = library()
    if test in examples:
        return examples[test]
    guess = nearest(test, examples) or f"; in the library: {', '.join(examples)}"
    problem = Problem("", test, f"no such file, and no such test in the library{guess}")
    return refuse(Code.UNKNOWN_TEST, test, [problem])
