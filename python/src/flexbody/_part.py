"""What all models of a scene have in common. The names of the models are in `flexbody.scene`."""

import json
from pathlib import Path
from typing import Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_serializer, model_validator

# Keys that say which variant an object is; always written.
TAGS = ("element", "kind")


def key_of(name):
    """The key in JSON: those that are words of Python have a `_` behind."""
    return name.removesuffix("_")


def under_one_of(*keys):
    """Lets only objects through that stand under one of some keys, such as `{"line": {"from": ..., "to": ...}}`."""

    def check(value):
        if not isinstance(value, dict) or (len(value) == 1 and next(iter(value)) in keys):
            return value
        expected = ", ".join(f"`{key}`" for key in keys)
        found = ", ".join(f"`{key}`" for key in value) or "nothing"
        raise ValueError(f"expected one of the keys {expected}, found {found}")

    return BeforeValidator(check)


def said(value):
    """A default without what is null in it."""
    if isinstance(value, dict):
        return {key: said(item) for key, item in value.items() if item is not None}
    return value


def listed(keys):
    return " and ".join(f"`{key}`" for key in keys)


class Part(BaseModel):
    """A part of a scene. Keys that were not said are not written; what is None counts as not said."""

    model_config = ConfigDict(
        extra="forbid",
        alias_generator=key_of,
        validate_by_name=True,
        validate_by_alias=True,
        serialize_by_alias=True,
        validate_assignment=True,
        use_attribute_docstrings=True,
        allow_inf_nan=False,
        protected_namespaces=(),
    )

    @classmethod
    def _extra(cls, name):
        return (cls.model_config.get("json_schema_extra") or {}).get(name)

    @model_validator(mode="before")
    @classmethod
    def _unwrap(cls, data: Any) -> Any:
        """Takes an object from under its key; arrays (numpy) become lists."""
        if not isinstance(data, dict):
            return data
        key = cls._extra("x-key")
        if key and set(data) == {key} and isinstance(data[key], dict):
            data = data[key]
        if cls.__name__ == "Scene":
            # Where the schema is means nothing but to editors.
            data = {key: value for key, value in data.items() if key != "$schema"}
        return {key: value.tolist() if hasattr(value, "tolist") else value for key, value in data.items()}

    @model_validator(mode="after")
    def _is_one_of_its_kinds(self) -> "Part":
        """Of keys that exclude each other those of one choice are said."""
        choices = self._extra("x-either")
        if not choices:
            return self
        of_choices = {key for choice in choices for key in choice["must"] + choice["may"]}
        found = {key_of(name) for name in self._written()} & of_choices
        if not any(set(choice["must"]) <= found <= set(choice["must"] + choice["may"]) for choice in choices):
            expected = ", or ".join(
                listed(choice["must"]) + (f" (and, if need be, {listed(choice['may'])})" if choice["may"] else "")
                for choice in choices
            )
            raise ValueError(f"expected {expected}, found {listed(sorted(found)) or 'none of them'}")
        return self

    def _written(self):
        """Names of what was said, and of tags."""
        return {
            name
            for name in type(self).model_fields
            if getattr(self, name) is not None and (name in self.model_fields_set or name in TAGS)
        }

    @model_serializer(mode="wrap")
    def _as_said(self, handler) -> dict[str, Any]:
        written = self._written()
        data = {}
        for name, field in type(self).model_fields.items():
            data_key = key_of(name)
            if name in written:
                data[data_key] = None
            elif isinstance(field.default, list | dict):
                # May have been added to in place.
                data[data_key] = said(field.default)
        found = {key_of(name): value for name, value in handler(self).items()}
        kept = {
            key: found[key]
            for key, default in data.items()
            if key in found and found[key] is not None and found[key] != default
        }
        key = self._extra("x-key")
        return {key: kept} if key else kept

    @classmethod
    def from_json(cls, text):
        """Reads it from JSON text."""
        return cls.model_validate_json(text)

    @classmethod
    def from_file(cls, path):
        """Reads it from a JSON file."""
        return cls.model_validate_json(Path(path).read_text(encoding="utf-8"))

    def to_dict(self):
        """What was said, as plain lists and dictionaries."""
        return self.model_dump(mode="json")

    def to_json(self):
        """What was said, as JSON text; numbers keep all their bits."""
        return json.dumps(self.to_dict(), indent=2, ensure_ascii=False, allow_nan=False) + "\n"

    def to_file(self, path):
        """Writes it to a JSON file."""
        Path(path).write_text(self.to_json(), encoding="utf-8", newline="\n")
