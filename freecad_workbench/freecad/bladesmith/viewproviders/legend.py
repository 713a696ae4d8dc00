"""Pictures that lie flat on the 3-D view: the colour bar, and the mark at the worst spot.

Drawn by Qt, so that text is smooth and may hold any character, then shown by Coin as pixels.
"""

from dataclasses import dataclass

import numpy
from pivy import coin
from PySide import QtCore, QtGui

_CARD, _INK, _FAINT = "#f4ffffff", "#1d242c", "#5b6672"
_MARGIN, _BAR_WIDTH, _BAR_HEIGHT, _TICK = 14, 20, 240, 5
_RING, _ACCENT = 34, "#e6007e"


@dataclass(frozen=True)
class LegendText:
    """What a colour bar says: title, line below it, and (place from 0 to 1, text) for each tick."""

    title: str
    subtitle: str
    ticks: list


def legend_image(colours: numpy.ndarray, text: LegendText) -> QtGui.QImage:
    """A colour bar, upright, on a light card; ``colours`` (n, 3) from its lower end."""
    title, small = _font(10, bold=True), _font(9)
    wide = [_width(title, text.title), _width(small, text.subtitle)]
    labels = max(_width(small, label) for _, label in text.ticks)
    wide.append(_BAR_WIDTH + 2 * _TICK + 4 + labels)
    top = _MARGIN + 2 * QtGui.QFontMetrics(title).height() + 10
    image = _blank(max(wide) + 2 * _MARGIN, top + _BAR_HEIGHT + _MARGIN + 6)
    painter = _painter(image)
    _card(painter, image)
    _write(painter, title, _INK, _MARGIN, _MARGIN + QtGui.QFontMetrics(title).ascent(), text.title)
    line = _MARGIN + QtGui.QFontMetrics(title).height() + QtGui.QFontMetrics(small).ascent() + 1
    _write(painter, small, _FAINT, _MARGIN, line, text.subtitle)
    rows = (numpy.clip(colours[::-1], 0, 1) * 255).round().astype(int)
    edges = numpy.rint(numpy.linspace(0, _BAR_HEIGHT, len(rows) + 1)).astype(int)
    for colour, start, end in zip(rows.tolist(), edges.tolist(), edges[1:].tolist()):
        painter.fillRect(_MARGIN, top + start, _BAR_WIDTH, end - start, QtGui.QColor(*colour))
    painter.setPen(QtGui.QColor(_FAINT))
    painter.setBrush(QtCore.Qt.NoBrush)
    painter.drawRect(_MARGIN, top, _BAR_WIDTH, _BAR_HEIGHT)
    middle = QtGui.QFontMetrics(small).capHeight() // 2
    right = _MARGIN + _BAR_WIDTH
    for place, label in text.ticks:
        y = top + round((1 - place) * _BAR_HEIGHT)
        painter.setPen(QtGui.QColor(_FAINT))
        painter.drawLine(right + 1, y, right + _TICK, y)
        _write(painter, small, _INK, right + 2 * _TICK, y + middle, label)
    painter.end()
    return image


def mark_image(text: str) -> QtGui.QImage:
    """A ring with its centre in the picture's, and text beside it on a card."""
    font = _font(9, bold=True)
    metrics = QtGui.QFontMetrics(font)
    lines = text.split("\n")
    width = max(_width(font, line) for line in lines) + 16
    height = metrics.height() * len(lines) + 10
    reach = _RING // 2 + 14
    image = _blank(2 * (reach + width), 2 * (_RING // 2 + height + 8))
    x, y = image.width() // 2, image.height() // 2
    painter = _painter(image)
    card = QtCore.QRectF(x + reach, y - _RING // 2 - height + 4, width, height)
    corner = QtCore.QPointF(card.left(), card.bottom() - 6)
    angle = QtCore.QPointF(x + 0.36 * _RING, y - 0.36 * _RING)
    centre = QtCore.QPointF(x, y)
    for colour, thick in (("#ffffff", 5.0), (_ACCENT, 2.4)):
        painter.setPen(QtGui.QPen(QtGui.QColor(colour), thick))
        painter.drawEllipse(centre, _RING / 2, _RING / 2)
        painter.drawLine(angle, corner)
        painter.drawPoint(centre)
    painter.setPen(QtGui.QPen(QtGui.QColor(_ACCENT), 1.6))
    painter.setBrush(QtGui.QColor(_CARD))
    painter.drawRoundedRect(card, 4, 4)
    for k, line in enumerate(lines):
        row = card.top() + 5 + k * metrics.height() + metrics.ascent()
        _write(painter, font, _INK, card.left() + 8, row, line)
    painter.end()
    return image


def to_coin(image: QtGui.QImage, node: coin.SoImage) -> None:
    """Gives a picture's pixels, with transparency, to Coin's node."""
    node.image.setValue(coin.SbVec2s(image.width(), image.height()), 4, pixels(image))


def pixels(image: QtGui.QImage) -> bytes:
    """Red, green, blue, alpha of each pixel by rows, the lowest row first as OpenGL has it."""
    flipped = image.convertToFormat(QtGui.QImage.Format_RGBA8888).mirrored(False, True)
    return bytes(flipped.constBits())


def _font(points: int, bold: bool = False) -> QtGui.QFont:
    font = QtGui.QFont(QtGui.QApplication.font())
    font.setPixelSize(round(points * 1.34))
    font.setBold(bold)
    return font


def _width(font: QtGui.QFont, text: str) -> int:
    return QtGui.QFontMetrics(font).boundingRect(text).width() + 2


def _blank(width: int, height: int) -> QtGui.QImage:
    image = QtGui.QImage(width, height, QtGui.QImage.Format_ARGB32_Premultiplied)
    image.fill(0)
    return image


def _painter(image: QtGui.QImage) -> QtGui.QPainter:
    painter = QtGui.QPainter(image)
    painter.setRenderHints(QtGui.QPainter.Antialiasing | QtGui.QPainter.TextAntialiasing)
    return painter


def _card(painter: QtGui.QPainter, image: QtGui.QImage) -> None:
    painter.setPen(QtGui.QPen(QtGui.QColor("#40000000"), 1))
    painter.setBrush(QtGui.QColor(_CARD))
    whole = QtCore.QRectF(0.5, 0.5, image.width() - 1, image.height() - 1)
    painter.drawRoundedRect(whole, 7, 7)
    painter.setRenderHint(QtGui.QPainter.Antialiasing, False)


def _write(painter, font, colour: str, x: float, y: float, text: str) -> None:
    painter.setFont(font)
    painter.setPen(QtGui.QColor(colour))
    painter.drawText(QtCore.QPointF(x, y), text)
