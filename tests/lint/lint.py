#!/usr/bin/python3
"""Rules of the source that no compiler checks. `lint.py` checks the tree above it; `lint.py --self-test` checks that
each rule finds what its fixture (fixtures/<rule>/, a small tree of its own) does wrong, and nothing in
fixtures/clean/. Design sections 2, 4 and 8."""

import argparse
import pathlib
import sys

import includes
import numbers_rules
import recipe_rules
import size_rules
import text_rules

HERE = pathlib.Path(__file__).resolve().parent
RULES = {
    "include": includes.check,
    "mpi_sum": numbers_rules.mpi_sum,
    "fast_math": numbers_rules.fast_math,
    "libm": numbers_rules.libm,
    "format": text_rules.clang_format,
    "length": text_rules.length,
    "size": size_rules.size,
    "machine_path": text_rules.machine_path,
    "todo": text_rules.todo,
    "header": text_rules.header,
    "scene": text_rules.scene,
    "recipe": recipe_rules.recipe,
}


def lint(root):
    """[(rule, message)] for the tree at `root`."""
    return [(rule, message) for rule, check in RULES.items() for message in check(root)]


def self_test():
    wrong = [f"clean: {rule}: {message}" for rule, message in lint(HERE / "fixtures" / "clean")]
    for rule in RULES:
        found = lint(HERE / "fixtures" / rule)
        marked = text_rules.marked(HERE / "fixtures" / rule)
        wrong += [f"{rule}: also finds {other}: {message}" for other, message in found if other != rule]
        places = {message.split(": ")[0] for other, message in found if other == rule}
        wrong += [f"{rule}: does not find {place}" for place in sorted(marked - places)]
        wrong += [f"{rule}: finds {place}, which is right" for place in sorted(places - marked)]
        if not marked:
            wrong.append(f"{rule}: its fixture has no line marked 'wrong'")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--root", type=pathlib.Path, default=HERE.parent.parent)
    options = parser.parse_args()
    found = self_test() if options.self_test else [f"{m} [{rule}]" for rule, m in lint(options.root)]
    if found:
        sys.exit("\n".join(found))
    print(f"{len(RULES)} rules")


if __name__ == "__main__":
    main()
