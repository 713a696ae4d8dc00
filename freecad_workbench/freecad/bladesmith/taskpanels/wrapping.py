"""Labels with wrapped text in the task view, which asks no widget for its height by its width."""

from PySide import QtCore


class Wrapping(QtCore.QObject):
    """Keeps labels as high as their text is at their width; else other fields are squeezed."""

    def __init__(self, *labels):
        super().__init__()
        for label in labels:
            label.installEventFilter(self)

    def eventFilter(self, label, event):
        """Called by Qt: a label has another width."""
        if event.type() == QtCore.QEvent.Resize:
            self._fit(label)
        return False

    def set_text(self, label, text: str) -> None:
        """Shows a text."""
        label.setText(text)
        self._fit(label)

    def _fit(self, label):
        # A label's own minimum counts in its height for a width.
        label.setMinimumHeight(0)
        label.setMinimumHeight(max(label.heightForWidth(label.width()), 0))
