#!/usr/bin/python3
"""No fused multiply-add is in what was compiled: their rounding is other than that of machines without, and g++ makes some in
spite of -ffp-contract=off.

    fused.py OBJDUMP LIBRARY [LIBRARY ...]
"""
import re
import subprocess
import sys

FUSED = re.compile(r"^\s+[0-9a-f]+:\s+(?:vfn?m(?:add|sub)|f(?:n?m(?:add|sub|la|ls|ad|sb)|cmla)\b)", re.M)
FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$", re.M)


def main():
    found = []
    objdump, *libraries = sys.argv[1:]
    for library in libraries:
        text = subprocess.run([objdump, "-d", "-C", "--no-show-raw-insn", library], check=True, capture_output=True, text=True).stdout
        assert FUNCTION.search(text), f"{library}: nothing that objdump knows"
        for part in re.split(r"\n(?=[0-9a-f]+ <)", text):
            if FUSED.search(part):
                name = FUNCTION.search(part)
                found.append(f"{library}: {name[1] if name else '?'}")
    print("\n".join(found[:20]) or "none")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
