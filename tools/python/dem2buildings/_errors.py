"""The errors of this package. Each is one sentence that names the fault and its remedy."""


class Error(Exception):
    """All errors of this package."""


class OptionError(Error, ValueError):
    """An option has a value that it cannot have, or does not go together with another one."""


class InputError(Error):
    """An input cannot be read, or not be used as a DEM."""


class OutputError(Error, OSError):
    """The result cannot be written; the destination keeps its old content."""


class Cancelled(Error):
    """The progress function returned False; nothing was written."""


for _error in (Error, OptionError, InputError, OutputError, Cancelled):
    _error.__module__ = "dem2buildings"
