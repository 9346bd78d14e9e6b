"""Every shipped file passes its schema and begins with the line that tells an editor so; with any one of
its keys misspelt, or a value that is out of place, it does not pass."""

import copy
import json
import pathlib
import sys
import unittest

import jsonschema
import yaml

CONFIG = pathlib.Path(sys.argv.pop(1)) / "config"
KINDS = ("mission", "sub_mission", "robot", "world", "template", "experiment")
# Maps whose keys the schema cannot know: they are OMPL's, or a sub-mission's.
OPEN_MAPS = ("parameters", "with", "categories")


def files_of(kind):
    folders = [CONFIG / (kind + "s")] + ([CONFIG / "templates_extra"] if kind == "template" else [])
    return [file for folder in folders for file in sorted(folder.glob("*.yaml"))]


def validator_of(kind):
    schema = json.loads((CONFIG / "schema" / (kind + ".schema.json")).read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def paths_of_keys(value, path=()):
    """Every key of every map, as the way to it from the top."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield path + (key,)
            if key not in OPEN_MAPS:
                yield from paths_of_keys(inner, path + (key,))
    if isinstance(value, list):
        for index, inner in enumerate(value):
            yield from paths_of_keys(inner, path + (index,))


def with_key_misspelt(value, path):
    changed = copy.deepcopy(value)
    inner = changed
    for step in path[:-1]:
        inner = inner[step]
    inner[path[-1] + "x"] = inner.pop(path[-1])
    return changed


class ShippedFiles(unittest.TestCase):
    def test_there_are_some_of_every_kind(self):
        for kind in KINDS:
            self.assertTrue(files_of(kind), kind)

    def test_each_passes_its_schema(self):
        for kind in KINDS:
            validator = validator_of(kind)
            for file in files_of(kind):
                for error in validator.iter_errors(yaml.safe_load(file.read_text())):
                    self.fail(f"{file}: {list(error.path)}: {error.message}")

    def test_each_names_its_schema_for_editors(self):
        for kind in KINDS:
            line = f"# yaml-language-server: $schema=../schema/{kind}.schema.json"
            for file in files_of(kind):
                self.assertEqual(file.read_text().splitlines()[0], line, f"{file}: first line")

    def test_none_passes_with_any_key_misspelt(self):
        for kind in KINDS:
            validator = validator_of(kind)
            for file in files_of(kind):
                content = yaml.safe_load(file.read_text())
                for path in paths_of_keys(content):
                    changed = with_key_misspelt(content, path)
                    self.assertFalse(validator.is_valid(changed), f"{file}: {path} misspelt passes")


class Mission(unittest.TestCase):
    """One thing changed in a mission that passes."""

    def passes(self, **changes):
        content = yaml.safe_load((CONFIG / "missions" / "office.yaml").read_text())
        content.update(changes)
        return validator_of("mission").is_valid(content)

    def test_unchanged_passes(self):
        self.assertTrue(self.passes())

    def test_short_forms_of_steps_pass(self):
        steps = ["explore", {"explore": None}, {"wait": 2}, {"goto": "nearest square"}, {"drive": [[1, 2], [3, 4]]}]
        self.assertTrue(self.passes(steps=steps))

    def test_nodes_pass_with_what_they_need(self):
        for node in (
            {"sequence": ["explore", {"wait": 2}]},
            {"name": "either", "fallback": [{"goto": "L1"}, {"reactive_fallback": ["wait"]}]},
            {"parallel": ["wait"]},
            {"parallel": {"succeed_when": 1, "fail_when": "all", "do": ["wait", "explore"]}},
            {"repeat": {"times": "forever", "do": ["wait", "explore"]}},
            {"retry": {"times": 3, "do": {"not": {"force_success": ["wait"]}}}},
            {"timeout": {"after_s": 2.5, "do": "wait"}},
            {"mission": "a.yaml"},
            {"mission": {"file": "a.yaml", "with": {"anything": [1, 2]}}},
            {"at_place": {"at_m": [1, 2]}},
            {"landmark_known": "square"},
        ):
            self.assertTrue(self.passes(steps=[node]), node)

    def test_nodes_that_the_program_refuses_fail(self):
        for node in (
            {"sequence": []},
            {"sequence": "wait"},
            {"fallback": ["save"]},
            {"name": "alone"},
            {"name": "two", "wait": 1, "explore": None},
            {"parallel": {"succeed_when": "most", "do": ["wait"]}},
            {"repeat": {"do": "wait"}},
            {"retry": {"times": 0, "do": "wait"}},
            {"timeout": {"after_s": 0, "do": "wait"}},
            {"not": None},
            {"at_place": {"within_m": 1}},
            {"explored": 95},
            {"timeout": {"after_s": "$patience_s", "do": "wait"}},
        ):
            self.assertFalse(self.passes(steps=[node]), node)

    def test_parameters_pass_in_sub_missions(self):
        steps = [{"timeout": {"after_s": "$patience_s", "do": "$what"}}, {"drive": ["$from", [1, 2]]}]
        self.assertTrue(validator_of("sub_mission").is_valid({"steps": steps}))
        self.assertFalse(validator_of("sub_mission").is_valid({"steps": [{"wait": "patience_s"}]}))

    def test_a_step_that_needs_settings_cannot_be_bare(self):
        self.assertFalse(self.passes(steps=["save"]))

    def test_two_behaviours_in_one_step_fail(self):
        self.assertFalse(self.passes(steps=[{"wait": 2, "save": "a.cairn"}]))

    def test_an_unknown_module_fails(self):
        self.assertFalse(self.passes(detector={"plugin": "template_macher"}))

    def test_a_module_of_another_kind_fails(self):
        self.assertFalse(self.passes(localizer={"plugin": "bayes_map"}))

    def test_a_setting_of_another_module_fails(self):
        self.assertFalse(self.passes(sensor={"plugin": "simulated_robot", "cell_m": 0.05}))

    def test_settings_of_a_module_within_a_module_are_checked(self):
        self.assertTrue(self.passes(planner={"plugin": "hybrid", "route": {"plugin": "ompl", "algorithm": "BITstar"}}))
        self.assertFalse(self.passes(planner={"plugin": "hybrid", "route": {"plugin": "ompl", "algoritm": "BITstar"}}))

    def test_values_out_of_place_fail(self):
        self.assertFalse(self.passes(seed="seven"))
        self.assertFalse(self.passes(seed=-1))
        self.assertFalse(self.passes(start={"at_m": [1, 2, 3]}))
        self.assertFalse(self.passes(detector={"plugin": "template_matcher", "tau_match": 1.5}))
        self.assertFalse(self.passes(detector={"plugin": "template_matcher", "mu": "sobol"}))


class OneOf(unittest.TestCase):
    def test_a_template_has_one_outline(self):
        validator = validator_of("template")
        circle = {"category": "round", "circle": {"diameter_m": 0.3}}
        self.assertTrue(validator.is_valid(circle))
        self.assertFalse(validator.is_valid({"category": "round"}))
        self.assertFalse(validator.is_valid(circle | {"polygon_m": [[0, 0], [1, 0], [0, 1]]}))


if __name__ == "__main__":
    unittest.main()
