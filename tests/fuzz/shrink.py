"""The smallest case that still differs: fewer rows, ranks, steps, settings, keys, groups of keys and particles."""

import copy
import time


def smaller(case):
    """Cases that are a little smaller than this one, the most promising first."""
    for k in range(len(case["rows"])):
        if len(case["rows"]) > 1:
            yield changed(case, lambda c: c.__setitem__("rows", [c["rows"][k]]))
    row = case["rows"][0]
    for key in ("shuffle", "restart", "cuts"):
        if key in row:
            yield changed(case, lambda c: c["rows"][0].pop(key))
    if "cuts" in row and row["cuts"] == "replay":
        yield changed(case, lambda c: c["rows"][0].__setitem__("cuts", "chaos"))
    for ranks in range(1, row["ranks"]):
        yield changed(case, lambda c: c["rows"][0].__setitem__("ranks", ranks))
    for k in range(len(row["set"])):
        yield changed(case, lambda c: c["rows"][0]["set"].pop(k))
    last = case["steps"][-1]
    for steps in sorted({1, 2, 3, 5, last // 2, last - 1}):
        if 0 < steps < last:
            yield changed(case, lambda c: shorten(c, steps))
    yield from fewer_particles(case)
    yield from fewer_keys(case)


def changed(case, change):
    out = copy.deepcopy(case)
    change(out)
    return out


def shorten(case, steps):
    case["steps"] = [s for s in case["steps"] if s < steps] + [steps]
    case["scene"]["time"]["steps"] = steps
    for row in case["rows"]:
        if "restart" in row and row["restart"]["at"] >= steps:
            row["restart"]["at"] = max(1, steps - 1)
            if steps < 2:
                del row["restart"]


def fewer_particles(case):
    rows = case.get("rows of start", [])
    share = 2
    while share <= 64 and len(rows) > 1:
        size = -(-len(rows) // share)
        for first in range(0, len(rows), size):
            yield changed(case, lambda c: c["rows of start"].__delitem__(slice(first, first + size)))
        if size == 1:
            break
        share *= 2


def fewer_keys(case):
    """Without one table, one entry of an array of tables, or one key."""
    def places(table, path):
        for key, value in list(table.items()):
            if path + [key] in (["time"], ["time", "steps"], ["group"], ["domain"], ["start"], ["kernel"]):
                pass
            else:
                yield path + [key]
            if isinstance(value, dict):
                yield from places(value, path + [key])
            if isinstance(value, list) and value and isinstance(value[0], dict):
                for k, inner in enumerate(value):
                    yield path + [key, k]
                    yield from places(inner, path + [key, k])

    def without(c, path):
        at = c["scene"]
        for step in path[:-1]:
            at = at[step]
        del at[path[-1]]

    for path in places(case["scene"], []):
        yield changed(case, lambda c: without(c, path))


def smallest(judge, case, verdict, seconds=240):
    """Takes each smaller case that still differs, in the same way by its first words, until none does."""
    end = time.monotonic() + seconds
    start = verdict.row
    if start is not None and start in case["rows"]:
        case = changed(case, lambda c: c.__setitem__("rows", [start]))
    counts, particles = dict(judge.counts), judge.particles
    again = True
    while again and time.monotonic() < end:
        again = False
        for candidate in smaller(case):
            if time.monotonic() > end:
                break
            try:
                found = judge.judge(candidate)
            except (KeyError, IndexError, TypeError, ValueError):
                continue  # no scene any more
            if found.kind == "differs" and kind_of(found.what) == kind_of(verdict.what) and (
                    judge.particles <= particles):
                case, verdict, particles, again = candidate, found, judge.particles, True
                break
    judge.counts = counts
    return case, verdict


def kind_of(what):
    """So that a difference of bits does not become a complaint about input."""
    return what.split(" ")[0]
