"""What is refused, in one line."""


class Error(Exception):
    """What is wrong with a file, a folder or an argument."""

    def __init__(self, text):
        super().__init__(" ".join(str(text).split()))  # what others say may have lines


class InputError(Error):
    """Of a scene: file, line, key, what is wrong, what would be right."""


class GuardError(Error):
    """The physics went wrong: particle, field, place, step."""


class OutputError(Error):
    """A file cannot be written."""
