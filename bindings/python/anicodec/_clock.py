# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The clock of a clip whose source tells the time of each step."""
from __future__ import annotations

from fractions import Fraction
from typing import Any, Dict, List, Optional, Sequence

import numpy as np

from .errors import InputError


def set_clock(places: Sequence[str], times: Sequence[Optional[float]], fps: Any, options: Dict[str, Any]) -> List[str]:
    """Sets rate, start and times among the options, where all steps tell them; notes of what is lost. places: of the steps, for messages."""
    known = [moment for moment in times if moment is not None]
    if len(known) < len(times) or not known:
        options["fps"] = fps
        return []
    if not np.isfinite(known).all():
        raise InputError(f"{places[int(np.argmin(np.isfinite(known)))]}: its time is not finite")
    for before, after, place in zip(known, known[1:], places[1:]):
        if not after > before:
            raise InputError(f"{place}: its time {after:g} is not after {before:g}, that of the step before")
    if fps is not None:
        options["fps"] = fps
        return [f"the steps' times, {known[0]:g} to {known[-1]:g}, are not kept, as the rate is given"] if len(known) > 1 else []
    options.setdefault("start_time", known[0])
    if len(known) == 1:
        options["fps"] = None
        return []
    seconds = np.array(known) - known[0]
    rate = Fraction((len(known) - 1) / seconds[-1]).limit_denominator(100000)
    if rate <= 0 or rate.numerator >= 2**32:
        raise InputError(f"the steps' times, {known[0]:g} to {known[-1]:g}, need another rate: --fps (fps=)")
    options["fps"] = rate
    if np.abs(np.arange(len(known)) / float(rate) - seconds).max() > 1e-6 * seconds[-1] / (len(known) - 1):
        options.setdefault("times", seconds)
    return []
