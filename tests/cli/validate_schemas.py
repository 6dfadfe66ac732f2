"""Checks the schemas that plastron prints against cases and results, with an independent validator:
    validate_schemas.py PROGRAM SOURCES SCRATCH
All cases and templates must validate, cases with mistakes of form must not, nor must results that were tampered with."""

import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

import jsonschema

program, sources, scratch = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
failures = []

# Mistakes that only the reader can see: of names, of numbers beside each other, of expressions.
beyond_a_schema = {"range-lame", "range-formulation"}
of_form = ("unknown-", "type-", "range-", "missing-", "obstacle-two-shapes", "obstacle-no-shape", "domain-", "step-unknown",
           "step-single", "single-bracket", "double-bracket", "step-move-nothing", "gravity-without-acceleration")


def plastron(*arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def validator(*of):
    schema = json.loads(plastron("schema", *of))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def expect(is_valid, validator, value, name):
    errors = [error.message for error in validator.iter_errors(value)]
    if is_valid and errors:
        failures.append(f"{name}: {errors[0][:300]}")
    if not is_valid and not errors:
        failures.append(f"{name} has a mistake and validates")


def parsed(path):
    try:
        return tomllib.loads(path.read_text())
    except (tomllib.TOMLDecodeError, UnicodeDecodeError):
        return None


cases = validator()
good = sorted(sources.glob("cases/*/case.toml")) + sorted(sources.glob("apps/plastron/templates/*.toml"))
assert len(good) > 15
for path in good:
    expect(True, cases, parsed(path), path)
wrong = [p for p in sorted(sources.glob("tests/config/wrong/*.toml"))
         if p.stem.startswith(of_form) and p.stem not in beyond_a_schema and parsed(p) is not None]
assert len(wrong) > 20
for path in wrong:
    expect(False, cases, parsed(path), path)

shutil.rmtree(scratch, ignore_errors=True)
results = validator("results")
for template, settings in (("dome", ["mesh.refinements=0"]), ("plate", ["mesh.refinements=0"]),
                           ("rollers", ["mesh.refinements=0", 'shell.formulation="mixed"'])):
    case = scratch / f"{template}.toml"
    plastron("new", str(case), "--template", template)
    plastron("run", str(case), "--output", str(scratch / template), "-q", *(f"--set={s}" for s in settings))
    written = json.loads((scratch / template / "results.json").read_text())
    expect(True, results, written, f"results of {template}")
    for change in ({"status": "perfect"}, {"energy": "much"}, {"ranks": 1.5}, {"levels": {}}, {"obstacles": [{}]}):
        expect(False, results, {**written, **change}, f"results of {template} with {change}")
    expect(False, results, {key: value for key, value in written.items() if key != "energy"}, f"{template} without energy")

print("\n".join(str(failure) for failure in failures))
sys.exit(1 if failures else 0)
