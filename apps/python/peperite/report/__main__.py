import argparse
import os
import sys

from ..drawing.command import Parser, refusing
from . import __doc__ as text
from . import write


def main():
    os.environ["MPLBACKEND"] = "Agg"
    parser = Parser(prog="report", description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", metavar="DIR", nargs="+", help="folder of a run")
    for folder in parser.parse_args().runs:
        print(write(folder))


if __name__ == "__main__":
    sys.exit(refusing(main))
