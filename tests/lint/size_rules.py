"""Sizes: a class with many members, or a long function, is several concepts that want names of their own."""

import re

from source_files import at, code, cpp

MOST_DATA, MOST_FUNCTIONS, MOST_LINES = 12, 20, 60
# Temporary: classes that are being split. Take a name out with its split; none may come in.
STILL_TOO_LARGE = set()

_CLASS = re.compile(r"(?:template\s*)?(?:class|struct|union)\s+(?:alignas\(\)\s*)?(\w+)")
_INITIALISED = re.compile(r"\)\s*(?:noexcept\s*)?:(?!:)")
_NO_MEMBER = re.compile(r"(?:template\s*)?(?:using|friend|typedef|static_assert|class|struct|union|enum)\b")
_ARRAY = re.compile(r"\(\s*[*&]+\s*(\w+)\s*\)(?=\s*\[)")  # a pointer or reference to one


def _plain(statement):
    """A declaration without attributes, template arguments and what is in parentheses."""
    s = re.sub(r"\[\[.*?\]\]", "", statement, flags=re.S)
    s = re.sub(r"\boperator\s*[^\s\w]+(?=\s*\()", "operator_", s).replace("->", "  ")
    s = _ARRAY.sub(r" \1", s)
    before = None
    while before != s:
        before = s
        s = re.sub(r"\((?:[^()]|\(\))+\)", "()", re.sub(r"<(?:[^<>()]|\(\))*>", "", s))
    return s.strip()


def _closing(source, begin):
    """Behind the brace that closes the one at `begin`."""
    depth = 0
    for brace in re.compile(r"[{}]").finditer(source, begin):
        depth += 1 if brace[0] == "{" else -1
        if depth == 0:
            return brace.end()
    return len(source)


def _opens(plain):
    """What a brace behind this text begins."""
    if re.match(r"(?:inline\s+)?namespace\b", plain) or plain == "extern":
        return "namespace"
    if _CLASS.match(plain) and not plain.endswith(")"):
        return "class"
    if "=" in plain or "()" not in plain or re.match(r"enum\b", plain):
        return "value"
    return "value" if _INITIALISED.search(plain) and re.search(r"\w$", plain) else "function"


class _Class:
    def __init__(self, name, begin):
        self.name, self.begin, self.data, self.functions = name, begin, 0, 0

    def add(self, statement):
        plain = _plain(statement)
        if not plain or _NO_MEMBER.match(plain) or re.search(r"=\s*(?:delete|default)$", plain):
            return
        if "()" in plain.split("=")[0].split("{")[0]:
            self.functions += 1
        elif not re.search(r"\bstatic\b", plain):
            self.data += 1 + re.sub(r"\{[^{}]*\}", "", plain).count(",")


def measure(source):
    """([class], [(name, begin, lines)]) of the functions, of C++ text without comments and literals."""
    source = re.sub(r"^[ \t]*#(?:\\\n|.)*", lambda m: re.sub(r"[^\n]", " ", m[0]), source, flags=re.M)
    classes, functions = [], []
    scopes = []  # classes and namespaces (None) around
    begin, statement, i = None, "", 0
    while i < len(source):
        c = source[i]
        if begin is None and not c.isspace() and c not in "{};":
            begin = i
        if c == "{":
            plain = _plain(statement)
            kind = _opens(plain)
            if kind in ("namespace", "class"):
                scopes.append(_Class(_CLASS.match(plain)[1], begin) if kind == "class" else None)
                begin, statement = None, ""
                i += 1
                continue
            end = _closing(source, i)
            if kind == "function":
                functions.append((plain.split("()")[0].split()[-1], begin, source.count("\n", begin, end) + 1))
                if scopes and scopes[-1]:
                    scopes[-1].add(plain)
                begin, statement = None, ""
            else:
                statement += "{}"
            i = end
            continue
        if c == "}":
            if scopes and (closed := scopes.pop()):
                classes.append(closed)
            begin, statement = None, ""
        elif c == ";":
            if scopes and scopes[-1]:
                scopes[-1].add(statement)
            begin, statement = None, ""
        elif c == ":" and statement.strip() in ("public", "private", "protected"):
            begin, statement = None, ""
        else:
            statement += c
        i += 1
    return classes, functions


def size(root):
    for path in cpp(root, "libdecomp", "libsph", "apps", "benchmarks"):
        source = code(path)
        classes, functions = measure(source)
        for c in classes:
            if c.name in STILL_TOO_LARGE:
                continue
            if c.data > MOST_DATA:
                yield f"{at(root, path, source, c.begin)}: {c.name} has {c.data} data members; split it along a concept"
            if c.functions > MOST_FUNCTIONS:
                yield f"{at(root, path, source, c.begin)}: {c.name} has {c.functions} functions; split it along a concept"
        for name, begin, lines in functions:
            if lines > MOST_LINES:
                yield f"{at(root, path, source, begin)}: {name} has {lines} lines; split it along a concept"
