"""The report of every family against its published schema."""

import json

import jsonschema
import pytest
from conftest import ROOT, centrode

# A missed goal, tables of pins, infinite figures, places of teeth.
NAMES = (
    "feeder-2022",
    "three-arm-2021",
    "moving-box-2018",
    "transplanter-pair-2021",
    "jansen-leg",
    "spiral-shaft-2018",
)


@pytest.fixture(scope="module")
def schema():
    return json.loads(centrode("schema", "report").stdout)


def unknown(value, schema, root):
    """Keys of a value that its schema does not know."""
    schema = root["$defs"][schema["$ref"].rsplit("/", 1)[1]] if "$ref" in schema else schema
    if isinstance(value, list):
        return [key for item in value for key in unknown(item, schema.get("items", {}), root)]
    if not isinstance(value, dict) or "properties" not in schema:
        return []
    known = schema["properties"]
    below = [key for name in value.keys() & known.keys() for key in unknown(value[name], known[name], root)]
    return [*(value.keys() - known.keys()), *below]


@pytest.mark.parametrize("name", NAMES)
def test_a_report_has_what_the_schema_says_and_nothing_else(name, schema):
    design = ROOT / "tests" / "designs" / f"{name}.toml"
    report = json.loads(centrode("check", design, "--json", check=False).stdout)
    jsonschema.Draft202012Validator(schema).validate(report)
    assert not unknown(report, schema, schema)


def test_a_report_with_a_word_for_a_number_is_refused_unless_the_word_is_infinity(schema):
    report = {
        "ok": True,
        "findings": [],
        "values": {"limit": "Infinity", "minimum": "-Infinity"},
        "units": {},
        "given": {},
    }
    jsonschema.validate(report, schema)
    for wrong in ("infinite", None):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({**report, "values": {"limit": wrong}}, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**report, "findings": [{"rule": "undercut"}]}, schema)
