# SPDX-License-Identifier: CC0-1.0
"""Reference decoder of .anic files, written from the specification. Chapters are named in each module."""
