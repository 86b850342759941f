"""Checks config/ by the printed schemas with a validator of others.

other_validator.py SOFOF CONFIG prints "K of N files"; those that are refused go to
stderr."""
import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema


def kind_of(file, text):
    if file.name == "policies.toml":
        return "entrants"
    if "\n[[lane]]" in text:
        return "map"
    return "sweep" if "\nscenario = " in text else "scenario"


def main():
    sofof, config = sys.argv[1:]
    checks = {}
    for kind in ("scenario", "map", "sweep", "entrants"):
        text = subprocess.run([sofof, "schema", kind], check=True,
                              capture_output=True).stdout
        schema = json.loads(text)
        jsonschema.Draft7Validator.check_schema(schema)
        checks[kind] = jsonschema.Draft7Validator(schema)
    good, files = 0, sorted(pathlib.Path(config).rglob("*.toml"))
    for file in files:
        text = file.read_text()
        wrong = list(checks[kind_of(file, text)].iter_errors(
            tomllib.loads(text)))
        good += not wrong
        for one in wrong:
            print(f"{file}: {one.message[:200]}", file=sys.stderr)
    print(f"{good} of {len(files)} files")


if __name__ == "__main__":
    main()
