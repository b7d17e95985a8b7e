"""Numbers as pictures: a scale of colours, a strip that says what they mean, a PNG.

The scale is made, not chosen by eye: its lightness in OKLab rises evenly from dark to bright, so it
keeps its order in grey and for every kind of colour vision, while its hue turns from violet by
green to yellow. NaN is the background; an infinite value is the brightest with a colour of its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from io import BytesIO

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont
from PIL.Image import Resampling

Array = npt.NDArray[np.float64]
Font = ImageFont.FreeTypeFont | ImageFont.ImageFont
Rgb = tuple[int, int, int]
STEPS = 256
BACKGROUND: Rgb = (20, 22, 26)
ENDLESS: Rgb = (255, 255, 255)
INK: Rgb = (225, 228, 232)
K_ENDS = (1 / 16, 64.0)
"""The ends of the scale of an error map, unless an error is larger."""
UNITS = {"depth": "units", "thickness": "units", "count": "intervals"}
LEAST_WIDTH = 480
"""Smaller pictures are enlarged, each pixel to a square, so that the strip can be read."""
STRIP = 40


@dataclass(frozen=True, slots=True)
class Scale:
    """What the strip below a picture says: a title, the numbers at its ends, and if it is log."""

    title: str
    low: float
    high: float
    unit: str = ""
    logarithmic: bool = False
    whole: bool = False

    def place(self, values: Array) -> Array:
        """Return where values lie on the scale, 0 to 1; NaN stays NaN."""
        low, high = self.low, self.high
        with np.errstate(all="ignore"):
            if self.logarithmic:
                values, low, high = np.log2(values), math.log2(low), math.log2(high)
            at: Array = (values - low) / (high - low if high > low else 1.0)
        return np.clip(at, 0.0, 1.0)

    @property
    def places(self) -> tuple[float, ...]:
        if self.high <= self.low:
            return (0.0,)
        steps = int(self.high - self.low) if self.whole and self.high - self.low <= 10 else 2
        return tuple(i / steps for i in range(steps + 1))

    def at(self, place: float) -> str:
        """Return the number at a place of the scale, as it is written."""
        if self.logarithmic:
            value = self.low * (self.high / self.low) ** place
        else:
            value = self.low + (self.high - self.low) * place
        return f"{value:.0f}" if self.whole else shown(value, self.low, self.high)


def shown(value: float, low: float, high: float) -> str:
    """Return a number with as many digits as tell it from others between low and high."""
    width, size = abs(high - low), max(abs(low), abs(high))
    more = math.ceil(math.log10(size / width)) if 0 < width < size < math.inf else 0
    return f"{value:.{min(4 + more, 17)}g}"


@cache
def colours() -> tuple[Rgb, ...]:
    return tuple(_colour(i / (STEPS - 1)) for i in range(STEPS))


def _colour(x: float) -> Rgb:
    """Return the colour at x, its chroma no more than what can be shown there."""
    lightness, hue = 0.26 + 0.68 * x, math.radians(300 - 195 * x)
    low, high = 0.0, 0.12
    for _ in range(20):
        middle = (low + high) / 2
        inside = all(0 <= c <= 1 for c in _linear(lightness, middle, hue))
        low, high = (middle, high) if inside else (low, middle)
    red, green, blue = (_encoded(min(max(c, 0.0), 1.0)) for c in _linear(lightness, low, hue))
    return red, green, blue


def _linear(lightness: float, chroma: float, hue: float) -> tuple[float, float, float]:
    """Return linear RGB of a colour in OKLab (Ottosson 2020)."""
    a, b = chroma * math.cos(hue), chroma * math.sin(hue)
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    middle = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    return (
        4.0767416621 * long - 3.3077115913 * middle + 0.2309699292 * short,
        -1.2684380046 * long + 2.6097574011 * middle - 0.3413193965 * short,
        -0.0041960863 * long - 0.7034186147 * middle + 1.7076147010 * short,
    )


def _encoded(c: float) -> int:
    """Return a linear component as sRGB has it, 0 to 255."""
    return round(255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055))


def of_scene(values: Array, show: str, note: str = "") -> Image.Image:
    """Return the picture of what is shown of a scene; the note goes into its title."""
    if show == "normal":
        return directions(values, "outward normal: x y z from -1 to 1 as red green blue")
    low, high = extremes(values) or (0.0, 1.0)
    if show == "error":
        title = f"backward error k{note}"
        return heat(values, Scale(title, K_ENDS[0], max(high, K_ENDS[1]), logarithmic=True))
    if show == "count":
        seen = np.where(values > 0, values, np.nan)
        return heat(seen, Scale(show + note, 0, max(high, 1.0), UNITS[show], whole=True))
    return heat(values, Scale(show + note, low, high, UNITS[show]))


def extremes(values: Array) -> tuple[float, float] | None:
    """Return the least and the largest finite value; None if there is none."""
    finite = values[np.isfinite(values)]
    return (float(finite.min()), float(finite.max())) if finite.size else None


def heat(values: Array, scale: Scale) -> Image.Image:
    at = scale.place(values)
    table = np.array([*colours(), BACKGROUND, ENDLESS], np.uint8)
    index = np.where(np.isnan(at), STEPS, np.nan_to_num(at) * (STEPS - 1)).round().astype(int)
    index = np.where(np.isposinf(values), STEPS + 1, index)
    return _with_strip(_enlarged(Image.fromarray(table[index])), scale)


def directions(normals: Array, title: str) -> Image.Image:
    """Return a picture of unit vectors: x, y and z from -1 to 1 as red, green and blue."""
    missing = np.isnan(normals).any(axis=2, keepdims=True)
    rgb = np.where(missing, BACKGROUND, (np.nan_to_num(normals) + 1) * 127.5)
    return _with_strip(_enlarged(Image.fromarray(rgb.round().astype(np.uint8))), title)


def png(image: Image.Image) -> bytes:
    data = BytesIO()
    image.save(data, format="PNG", compress_level=3)
    return data.getvalue()


def _enlarged(image: Image.Image) -> Image.Image:
    """Return the picture, each pixel a square where it is small."""
    times = max(1, -(-LEAST_WIDTH // image.width))
    size = (image.width * times, image.height * times)
    return image if times == 1 else image.resize(size, Resampling.NEAREST)


def _with_strip(image: Image.Image, scale: Scale | str) -> Image.Image:
    """Return the picture over a strip: a title, and where there is a scale its bar and numbers."""
    whole = Image.new("RGB", (image.width, image.height + STRIP), BACKGROUND)
    whole.paste(image, (0, 0))
    draw = ImageDraw.Draw(whole)
    if isinstance(scale, str):
        draw.text((10, image.height + STRIP // 2), scale, INK, _font(), anchor="lm")
    else:
        _bar(draw, scale, image.width, image.height)
    return whole


def _bar(draw: ImageDraw.ImageDraw, scale: Scale, width: int, top: int) -> None:
    """Draw the title, and the bar with its numbers to the right of it."""
    font, middle = _font(), top + STRIP // 2
    title = f"{scale.title} [{scale.unit}]" if scale.unit else scale.title
    draw.text((10, middle), title, INK, font, anchor="lm")
    left, right = 30 + math.ceil(draw.textlength(title, font)), width - 30
    for x in range(left, right):
        colour = colours()[round((STEPS - 1) * (x - left) / max(right - 1 - left, 1))]
        draw.line([(x, top + 8), (x, top + 20)], colour)
    for place in scale.places:
        x = round(left + place * (right - left))
        anchor = "lt" if place == 0 else "rt" if place == 1 else "mt"
        draw.text((x, top + 24), scale.at(place), INK, font, anchor=anchor)


def _font() -> Font:
    return ImageFont.load_default(13)
