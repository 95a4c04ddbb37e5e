#!/usr/bin/env python3
"""fits_schema.py SCHEMA [REPORT…]: whether the schema is valid (JSON Schema 2020-12), and whether each report fits it."""
import json
import pathlib
import sys

import jsonschema

path = pathlib.Path(sys.argv[1]).resolve()
schema = json.loads(path.read_text())
jsonschema.Draft202012Validator.check_schema(schema)


def bundle(node):
    """Schemas refer to each other by file name: such a reference becomes one into $defs."""
    if isinstance(node, dict):
        return {k: "#/$defs/" + v if k == "$ref" and not v.startswith("#") else bundle(v)
                for k, v in node.items() if k != "$id"}
    return [bundle(v) for v in node] if isinstance(node, list) else node


shared = {s.name: bundle(json.loads(s.read_text())) for s in path.parent.glob("*.json") if s != path}
whole = bundle(schema)
whole.setdefault("$defs", {}).update(shared)
if whole.get("$ref", "").removeprefix("#/$defs/") not in ("", *shared):
    sys.exit(f"{path.name}: no schema {schema['$ref']}")
validator = jsonschema.Draft202012Validator(whole)
failed = False
for report in sys.argv[2:]:
    for error in validator.iter_errors(json.loads(pathlib.Path(report).read_text())):
        print(f"{report}: {'/'.join(map(str, error.absolute_path))}: {error.message}")
        failed = True
sys.exit(failed)
