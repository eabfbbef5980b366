# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The exceptions of the package. Each is one of Python's too, so that either may be caught."""


class AnicodecError(Exception):
    """The base of all of them."""


class InputError(AnicodecError, ValueError):
    """Arrays or options make no sense, or a target cannot be reached."""


class CorruptError(AnicodecError, ValueError):
    """Bytes that are no .anic file, or a damaged one."""


class UnsupportedError(AnicodecError, NotImplementedError):
    """A version of the format, or a feature, that this build does not have."""


class FrameError(AnicodecError, IndexError):
    """There is no such frame."""


class AbsentError(AnicodecError, LookupError):
    """The mesh is not there at this time."""


class LimitError(AnicodecError, MemoryError):
    """More memory than there is, or than was allowed."""


class Cancelled(AnicodecError):
    """A progress callback returned False."""


class InternalError(AnicodecError, RuntimeError):
    """A defect of the library."""
