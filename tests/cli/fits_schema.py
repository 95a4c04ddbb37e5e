#!/usr/bin/env python3
"""fits_schema.py SCHEMA [REPORT…]: whether the schema is valid (JSON Schema 2020-12), and whether each report fits it."""
import json
import pathlib
import sys

import jsonschema

path = pathlib.Path(sys.argv[1]).resolve()
schema = json.loads(path.read_text())
jsonschema.Draft202012Validator.check_schema(schema)
# Schemas refer to each other by file name.
store = {s.name: json.loads(s.read_text()) for s in path.parent.glob("*.json")}
for s in store.values():
    if s.get("$ref", "report.json") not in store:
        sys.exit(f"{path.name}: no schema {s['$ref']}")
validator = jsonschema.Draft202012Validator(
    schema, resolver=jsonschema.RefResolver(base_uri=schema.get("$id", path.name), referrer=schema, store=store))
failed = False
for report in sys.argv[2:]:
    for error in validator.iter_errors(json.loads(pathlib.Path(report).read_text())):
        print(f"{report}: {'/'.join(map(str, error.absolute_path))}: {error.message}")
        failed = True
sys.exit(failed)
