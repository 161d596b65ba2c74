#!/usr/bin/python3
"""apps/scene.schema.json as editors read it: every scene of the repository fits, and what is wrong does not.

    test_schema.py --source .
"""
import argparse
import json
import tomllib
from pathlib import Path

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float)}
BOUNDS = {"minimum": lambda x, b: x >= b, "maximum": lambda x, b: x <= b,
          "exclusiveMinimum": lambda x, b: x > b, "exclusiveMaximum": lambda x, b: x < b}
READ = {"$schema", "title", "description", "default", "type", "enum", "anyOf", "properties", "additionalProperties",
        "required", "items", "minItems", "maxItems", *BOUNDS}


def is_of(value, name):
    if isinstance(value, bool) or name == "boolean":
        return isinstance(value, bool) and name == "boolean"
    return isinstance(value, TYPES[name]) or (name == "integer" and isinstance(value, float) and value.is_integer())


def problems(schema, value, path="scene"):
    """What a validator of JSON schema finds, of the words that this schema has."""
    assert set(schema) <= READ, f"{path}: this test does not know {set(schema) - READ}"
    if "anyOf" in schema and all(list(problems(s, value, path)) for s in schema["anyOf"]):
        yield f"{path}: is none of anyOf"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{path}: is no word of {schema['enum']}"
    types = schema.get("type", list(TYPES))
    if not any(is_of(value, t) for t in ([types] if isinstance(types, str) else types)):
        yield f"{path}: is no {types}"
    elif isinstance(value, dict):
        yield from (f"{path}: lacks {key}" for key in schema.get("required", []) if key not in value)
        for key, inner in value.items():
            if key in schema["properties"]:
                yield from problems(schema["properties"][key], inner, f"{path}.{key}")
            else:
                yield f"{path}: has no {key}"
    elif isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{path}: has {len(value)} items"
        for k, item in enumerate(value):
            yield from problems(schema.get("items", {}), item, f"{path}.{k}")
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield from (f"{path}: {name} is {schema[name]}" for name, good in BOUNDS.items()
                    if name in schema and not good(value, schema[name]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", required=True, type=Path)
    source = parser.parse_args().source
    schema = json.loads((source / "apps" / "scene.schema.json").read_text())
    scenes = [path for folder in ("apps", "benchmarks", "tests/scenes", "tests/every_key", "tests/compilers")
              for path in (source / folder).rglob("*.toml")]
    assert len(scenes) > 60, scenes
    for path in scenes:
        assert not list(problems(schema, tomllib.loads(path.read_text()))), (path, list(problems(
            schema, tomllib.loads(path.read_text()))))
    bad = 0
    for path in sorted((source / "tests" / "bad_scenes").glob("*.toml")):
        try:
            bad += bool(list(problems(schema, tomllib.loads(path.read_text()))))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError):
            pass
    # Unknown keys, types, words and bounds; which keys go together no schema says.
    assert bad > 140, f"{bad} bad scenes are found"
    good = tomllib.loads((source / "tests" / "every_key" / "matter.toml").read_text())
    for table, key, value, says in (("time", "dtt", 1, "has no dtt"), ("time", "dt", -1, "exclusiveMinimum"),
                                    ("decomposition", "balance", "best", "no word"), ("domain", "lower", [0], "1 items")):
        wrong = good | {table: good[table] | {key: value}}
        assert any(says in problem for problem in problems(schema, wrong)), says
    print(f"{len(scenes)} scenes fit, {bad} bad ones do not")


if __name__ == "__main__":
    main()
