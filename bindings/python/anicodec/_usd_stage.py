# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Stages of USD as a whole: opening, skins, time codes."""
from __future__ import annotations

import contextlib
import os
import re
from fractions import Fraction
from typing import Any, Iterator, List, Sequence, Tuple

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdSkel, UsdUtils

from .errors import InputError

MATERIALS = "materialBind"  #: family of the subsets that have a material
PARTS = "part"  #: family of the subsets that are parts of a mesh


def opened(stage: Any) -> Usd.Stage:
    """The stage, or that of a path. Raises InputError where parts of it are missing."""
    if not isinstance(stage, Usd.Stage):
        path = os.fspath(stage)
        if not os.path.exists(path):
            raise FileNotFoundError(2, "there is no such file", path)
        try:
            stage = Usd.Stage.Open(path)
        except Exception as error:
            raise InputError(f"{path}: {_reason(error)}") from None
    # Layers that are missing, and cycles, are warnings to USD: it goes on without what they held.
    errors = stage.GetCompositionErrors() if hasattr(stage, "GetCompositionErrors") else []
    if errors:
        told = " ".join(str(errors[0]).split())
        raise InputError(f"{stage.GetRootLayer().GetDisplayName()}: {told}")
    return stage


@contextlib.contextmanager
def warnings_as_notes(notes: List[str]) -> Iterator[None]:
    """Turns what USD warns of meanwhile, as of a value clip that is missing, into notes, each once."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        told = (" ".join(one.commentary.split()) for one in delegate.TakeUncoalescedDiagnostics())
        notes.extend(text for text in dict.fromkeys(told) if text not in notes)
        del delegate


def _reason(error: Exception) -> str:
    """The first thing that USD says went wrong, without its places in USD's own source."""
    lines = str(error).strip().splitlines()
    told = re.search(r" at line \d+ in file \S+ : '(.*)", lines[0]) if lines else None
    return (told.group(1).rstrip("'") if told else lines[0].strip()) if lines else type(error).__name__


def bake_skins(stage: Usd.Stage, codes: Sequence[float], rate: float) -> Usd.Stage:
    """The stage, or a copy of it in which points move, with samples at the codes of frames: so many a second."""
    if not any(prim.IsA(UsdSkel.Root) for prim in stage.Traverse(Usd.TraverseInstanceProxies())):
        return stage
    copy = Usd.Stage.Open(stage.Flatten())
    # Skins are baked at samples of what moves them, and at frames of the stage.
    copy.SetTimeCodesPerSecond(stage.GetTimeCodesPerSecond())
    copy.SetFramesPerSecond(rate)
    copy.SetStartTimeCode(codes[0])
    copy.SetEndTimeCode(codes[-1])
    while any([prim.SetInstanceable(False) for prim in copy.Traverse() if prim.IsInstance()]):
        pass  # instances in instances
    if not UsdSkel.BakeSkinning(copy.Traverse(), Gf.Interval.GetFullInterval()):
        raise InputError("the skins of the stage cannot be baked")
    return copy


def resting_skins(stage: Usd.Stage) -> List[str]:
    """A note for each skin that USD leaves at rest."""
    return [f"{prim.GetPath()}: the skin has no SkelRoot above it, and rests" for prim in stage.Traverse()
            if prim.HasAPI(UsdSkel.BindingAPI) and UsdSkel.BindingAPI(prim).GetJointIndicesPrimvar().HasValue() and not UsdSkel.Root.Find(prim)]


def other_variants(stage: Usd.Stage) -> List[str]:
    """A note for each set of variants that has more than the one that was read."""
    notes = []
    for prim in stage.Traverse():
        for name in prim.GetVariantSets().GetNames():
            choices = prim.GetVariantSet(name)
            others = [other for other in choices.GetVariantNames() if other != choices.GetVariantSelection()]
            if others:
                notes.append(f"{prim.GetPath()}: variant {name}={choices.GetVariantSelection()} is encoded, not {', '.join(others)}")
    return notes


def snapped_rate(rate: float) -> Fraction:
    """A rate as it is meant: 23.976022856742713 and 23.976 are 24000/1001."""
    for whole in (24, 30, 48, 60, 96, 120):
        meant = Fraction(whole * 1000, 1001)
        if abs(rate - float(meant)) < 2e-6 * rate:
            return meant
    return Fraction(rate).limit_denominator(100000)


def _sampled_codes(stage: Usd.Stage) -> np.ndarray:
    """All codes with a time sample or the knot of a spline, ascending."""
    codes: set = set()
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        for attribute in prim.GetAuthoredAttributes():
            codes.update(attribute.GetTimeSamples())
            if hasattr(attribute, "HasSpline") and attribute.HasSpline():
                codes.update(attribute.GetSpline().GetKnots().keys())
    return np.array(sorted(codes), float)


def _between(samples: np.ndarray, start: float, step: float) -> np.ndarray:
    """The samples that no frame meets."""
    frames = (samples - start) / step
    return samples[np.abs(frames - np.round(frames)) > 1e-4]


def time_codes(stage: Usd.Stage, fps: Any, notes: List[str]) -> Tuple[List[float], Fraction, bool]:
    """The time code of each frame, frames per second, and whether that rate has them all."""
    per_second, frames_per_second = stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()
    if not 0 < per_second < 1e9:
        raise InputError(f"the stage has {per_second:g} time codes per second")
    samples = _sampled_codes(stage)
    if stage.HasAuthoredTimeCodeRange():
        start, end = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    else:
        start, end = (samples[0], samples[-1]) if len(samples) else (0.0, 0.0)
    if not np.isfinite([start, end]).all():
        raise InputError(f"the stage has no frames from {start:g} to {end:g}")
    samples = samples[(samples >= start) & (samples <= end)]
    if fps is not None:
        rates = [fps]
    elif stage.HasAuthoredMetadata("framesPerSecond") or per_second > 240:  # codes that are ticks, not frames
        rates = [frames_per_second, per_second, *(frames_per_second * parts for parts in range(2, 17))]
    else:
        rates = [per_second, frames_per_second, *(per_second * parts for parts in range(2, 17))]
    try:
        rates = [Fraction(rate) for rate in rates]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise InputError(f"fps must be a number or a text as '30000/1001', not {fps!r}") from None
    steps = [per_second / float(rate) for rate in rates if rate > 0]
    if len(steps) < len(rates):
        raise InputError(f"fps must be greater than 0, not {fps!r}")
    best = next((i for i, step in enumerate(steps) if len(_between(samples, start, step)) == 0), 0)
    step = steps[best]
    count = int(np.floor((end - start) / step + 1e-6)) + 1
    if count < 1 or count >= 2**24:
        raise InputError(f"the stage has no frames from {start:g} to {end:g}")
    codes = [start + frame * step for frame in range(count)]
    between = _between(samples, start, step)
    even = fps is not None or len(between) == 0
    if len(between) and even:
        notes.append(f"{len(between)} time samples of the stage stand between the frames; without fps= each is a frame")
    elif len(between):
        codes = sorted([*codes, *between.tolist()])
    return codes, snapped_rate(float(rates[best])), even


def identifier(text: str) -> str:
    return text if Sdf.Path.IsValidIdentifier(text) else Tf.MakeValidIdentifier(text)
