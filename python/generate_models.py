"""Makes src/flexbody/scene.py from the schema of scenes.

    python python/generate_models.py [--output FILE]

Run in the environment that tests/python/requirements.txt describes: the generator's version is part of the result.
"""

import argparse
import copy
import json
import re
import subprocess
import sys
from pathlib import Path

from datamodel_code_generator import DataModelType, InputFileType, LiteralType, PythonVersion, generate
from datamodel_code_generator.enums import StrictTypes, TargetPydanticVersion
from datamodel_code_generator.format import Formatter

HERE = Path(__file__).parent
SCHEMA = HERE.parent / "scenes" / "scene.schema.json"
MODELS = HERE / "src" / "flexbody" / "scene.py"
HEADER = '''"""Scenes as Python objects: what scenes/scene.schema.json says, with the same names.

Made by generate_models.py; changes here would be lost. Keys that are words of Python end in `_` (`from_`, `for_`).
What a scene must obey beyond this is checked by the program.
"""'''
# Keys that say which variant an object is.
TAGS = ["element", "kind"]


def tag_of(variant):
    """The key that says which variant this is, with its value."""
    for key in TAGS:
        value = variant.get("properties", {}).get(key, {}).get("const")
        if value is not None:
            return key, value
    return None, None


def told_apart(definition):
    """What is checked by its kind as a choice of variants."""
    if "allOf" not in definition:
        return definition

    def told(check):
        return [variant for key in ("then", "else") if key in check for variant in told(check[key])] or [check]

    variants = [variant for check in definition["allOf"] for variant in told(check)]
    return {"description": definition["description"], "oneOf": variants}


def words(definition):
    """A choice of strings, each with its meaning."""
    variants = definition["oneOf"]
    meanings = "\n".join(f"- `{variant['const']}`: {variant['description']}" for variant in variants)
    return {
        "description": f"{definition['description']}\n\n{meanings}",
        "type": "string",
        "enum": [variant["const"] for variant in variants],
    }


def merged(variants):
    """One model for the variants of one tag, which differ in what they are read at, and which keys go together."""
    if len(variants) == 1:
        return variants[0]
    one = copy.deepcopy(variants[0])
    common = set.intersection(*(set(variant["properties"]) for variant in variants))
    for variant in variants[1:]:
        one["properties"].update(copy.deepcopy(variant["properties"]))
    one["required"] = [key for key in one["required"] if key in common]
    one["x-either"] = [
        {
            "must": [key for key in variant["required"] if key not in common],
            "may": [key for key in variant["properties"] if key not in common and key not in variant["required"]],
        }
        for variant in variants
    ]
    return one


def tagged(definition, definitions):
    """Models of their own for the variants of a part."""
    by_value = {}
    for variant in definition["oneOf"]:
        tag, value = tag_of(variant)
        by_value.setdefault(value, []).append(variant)
    for variants in by_value.values():
        model = merged(variants)
        definitions[model["title"]] = model
    names = [variants[0]["title"] for variants in by_value.values()]
    return {
        "description": definition["description"],
        "oneOf": [{"$ref": f"#/$defs/{name}"} for name in names],
        "discriminator": {"propertyName": tag},
    }


def keyed(definition, definitions):
    """Models of the objects that stand under a key of their own, such as `{"line": {"from": ..., "to": ...}}`."""
    names = []
    for variant in definition["oneOf"]:
        ((key, inner),) = variant["properties"].items()
        if inner.get("type") == "object":
            model = {**inner, "description": variant["description"], "x-key": key}
        else:
            model = copy.deepcopy(variant)
            model["properties"][key].setdefault("description", variant["description"])
        model["title"] = variant["title"]
        definitions[variant["title"]] = model
        names.append(variant["title"])
    return {"description": definition["description"], "oneOf": [{"$ref": f"#/$defs/{name}"} for name in names]}


def prepared(schema):
    """The schema as the generator makes good models of it, and the unions whose members stand under keys."""
    definitions = {}
    unions = {}
    # Models do not say where their schema is.
    schema["properties"].pop("$schema")
    for name, definition in schema["$defs"].items():
        definition = told_apart(definition)
        for choice in definition.get("anyOf", []):
            if "$ref" not in choice:
                choice["title"] = name + named(choice)
        variants = definition.get("oneOf", [])
        if variants and all("const" in variant for variant in variants):
            definition = words(definition)
        elif variants and all(tag_of(variant)[0] for variant in variants):
            definition = tagged(definition, definitions)
        elif variants:
            unions[name] = [next(iter(variant["properties"])) for variant in variants]
            definition = keyed(definition, definitions)
        assert name not in definitions, name
        definitions[name] = definition
    return {**schema, "$defs": definitions}, unions


def named(choice):
    """The last part of the name of one of several forms of a value."""
    if choice["type"] != "array":
        return {"number": "Number", "integer": "Count", "string": "Expression"}[choice["type"]]
    return "Rows" if choice["items"].get("type") == "array" else "Components"


def said(value):
    """What must be said is not null."""
    if isinstance(value.get("type"), list):
        (kind,) = (kind for kind in value["type"] if kind != "null")
        return {**value, "type": kind}
    choices = [choice for choice in value.get("anyOf", []) if choice != {"type": "null"}]
    return {"description": value.get("description"), **choices[0]} if len(choices) == 1 else value


def tidy(model):
    """What must be said comes first, lists are empty where nothing is said."""
    # The base of all models refuses unknown keys; said once, it is not repeated in every class.
    model.pop("additionalProperties", None)
    required = model.get("required", [])
    properties = model.get("properties", {})
    for key, value in properties.items():
        if key in required:
            properties[key] = said(value)
        elif value.get("type") == "array":
            value.setdefault("default", [])
    order = sorted(properties, key=lambda key: required.index(key) if key in required else len(required))
    if properties:
        model["properties"] = {key: properties[key] for key in order}


def generated(schema):
    """The module as text."""
    schema, unions = prepared(copy.deepcopy(schema))
    for model in [schema, *schema["$defs"].values()]:
        tidy(model)
    text = generate(
        json.dumps(schema),
        input_file_type=InputFileType.JsonSchema,
        output_model_type=DataModelType.PydanticV2BaseModel,
        target_python_version=PythonVersion.PY_310,
        target_pydantic_version=TargetPydanticVersion.V2_11,
        base_class="flexbody._part.Part",
        custom_file_header=HEADER,
        use_title_as_name=True,
        use_type_alias=True,
        use_schema_description=True,
        use_field_description=True,
        use_annotated=True,
        strict_nullable=True,
        field_constraints=True,
        enum_field_as_literal=LiteralType.All,
        use_one_literal_as_default=True,
        strict_types=list(StrictTypes),
        model_extra_keys={"x-key", "x-either"},
        no_alias=True,
        use_double_quotes=True,
        use_union_operator=True,
        use_standard_collections=True,
        collapse_root_models=False,
        formatters=[Formatter.RUFF_FORMAT],
        disable_timestamp=True,
    )
    text = str(text)
    for name, keys in unions.items():
        # Members are told apart by the key that they stand under.
        pattern = rf'^{name} = TypeAliasType\(\s*"{name}",\s*(.*?),?\s*\)$'
        among = ", ".join(f'"{key}"' for key in keys)
        alias = rf'{name} = TypeAliasType("{name}", Annotated[\g<1>, under_one_of({among})])'
        text, count = re.subn(pattern, alias, text, flags=re.DOTALL | re.MULTILINE)
        assert count == 1, name
    text = text.replace("from flexbody._part import Part", "from flexbody._part import Part, under_one_of")
    return formatted(text)


def formatted(text):
    command = [
        sys.executable,
        "-m",
        "ruff",
        "format",
        "--line-length",
        "120",
        "--isolated",
        "--stdin-filename",
        "scene.py",
        "-",
    ]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=True, encoding="utf-8").stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=MODELS)
    arguments = parser.parse_args()
    text = generated(json.loads(SCHEMA.read_text(encoding="utf-8")))
    arguments.output.write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
