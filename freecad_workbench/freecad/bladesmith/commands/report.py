"""``Bladesmith_OpenReport``: the page about the selected morph in the browser."""

from ..taskpanels.report_page import ReportPage
from .names import icon
from .result import chosen_result


class OpenReport:
    """Draws the page beside the window and opens it."""

    def __init__(self):
        self._page = ReportPage()
        self._page.busy.connect(self._take_busy)
        self._busy = False

    def GetResources(self):
        """Texts and icon."""
        return {
            "Pixmap": icon("Bladesmith_OpenReport"),
            "MenuText": "Open report",
            "ToolTip": "Opens the page about a morph: verdict, figures and pictures",
        }

    def IsActive(self):
        """With one computed morph, and no page being drawn."""
        return not self._busy and chosen_result() is not None

    def Activated(self):
        """Opens the page of the selected morph."""
        self._page.draw(chosen_result())

    def _take_busy(self, busy: bool):
        self._busy = busy
