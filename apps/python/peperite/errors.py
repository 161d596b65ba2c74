"""What is refused, in one line."""


class Error(Exception):
    """What is wrong with a file, a folder or an argument."""
