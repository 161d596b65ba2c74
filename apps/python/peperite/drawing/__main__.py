import sys

from . import draw, parser
from .command import refusing, show

if __name__ == "__main__":
    sys.exit(refusing(lambda: show(draw(parser().parse_args()))))
