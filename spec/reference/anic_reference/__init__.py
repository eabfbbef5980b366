# SPDX-License-Identifier: CC0-1.0
"""A decoder of the .anic format that follows the chapters of its specification."""
