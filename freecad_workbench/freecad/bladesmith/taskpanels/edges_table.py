"""The table of a report's edges: sortable, worst first."""

from PySide import QtCore, QtGui

from ..colours.scale import number
from .words import translate

_SORTED_BY = QtCore.Qt.UserRole
_GAP_COLUMN = 1


def _columns() -> list:
    """Heading, explanation, value of an edge to sort by, and its text or None for the value's."""
    return [
        (translate("Edge"), "", lambda e: e.index, None),
        (
            translate("Gap, µm"),
            translate("Largest distance among its curve and its traces on both faces"),
            lambda e: e.gap_mm.after * 1e3,
            None,
        ),
        (
            translate("Opened, °"),
            translate("How much the angle of a tangent joint grew"),
            lambda e: e.angle_deg.after - e.angle_deg.before if e.tangent else -1.0,
            lambda e: number(max(e.angle_deg.after - e.angle_deg.before, 0)) if e.tangent else "–",
        ),
        (
            translate("Angle, °"),
            translate("Largest angle between the normals of both faces"),
            lambda e: e.angle_deg.after,
            None,
        ),
        (
            translate("Faces"),
            translate("The faces that it joins"),
            lambda e: e.faces[0] * 1_000_000 + e.faces[1],
            lambda e: f"{e.faces[0]}, {e.faces[1]}",
        ),
        (
            translate("Gap before, µm"),
            translate("The gap of the input"),
            lambda e: e.gap_mm.before * 1e3,
            None,
        ),
    ]


class EdgesModel(QtCore.QAbstractTableModel):
    """Edges by row. Those in ``opened`` are emphasised."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self._columns = _columns()
        self.edges: list = []
        self._opened: set = set()

    def show(self, edges: list, opened: list) -> None:
        """Takes the edges of a report, and those of them that are no longer tangent."""
        self.beginResetModel()
        self.edges, self._opened = edges, {edge.index for edge in opened}
        self.endResetModel()

    def rowCount(self, parent=None):
        """Number of edges."""
        return 0 if parent is not None and parent.isValid() else len(self.edges)

    def columnCount(self, _parent=None):
        """Number of columns."""
        return len(self._columns)

    def headerData(self, section, orientation, role=QtCore.Qt.DisplayRole):
        """Headings, and what they mean."""
        if orientation == QtCore.Qt.Horizontal:
            heading, tip, _value, _text = self._columns[section]
            return {QtCore.Qt.DisplayRole: heading, QtCore.Qt.ToolTipRole: tip}.get(role)
        return None

    def data(self, index, role=QtCore.Qt.DisplayRole):
        """Text, value to sort by, alignment, emphasis."""
        edge = self.edges[index.row()]
        _heading, _tip, value, text = self._columns[index.column()]
        if role == QtCore.Qt.DisplayRole:
            return text(edge) if text else number(value(edge))
        if role == _SORTED_BY:
            return float(value(edge))
        if role == QtCore.Qt.TextAlignmentRole:
            return int(QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter)
        if role == QtCore.Qt.ForegroundRole and edge.index in self._opened:
            return QtGui.QBrush(QtGui.QColor("#c62828"))
        return None


class EdgesView(QtGui.QTableView):
    """The table; ``chosen`` gets the numbers of the selected edges."""

    chosen = QtCore.Signal(list)

    def __init__(self, parent=None):
        super().__init__(parent)
        self.model_of_edges = EdgesModel(self)
        self._sorted = QtCore.QSortFilterProxyModel(self)
        self._sorted.setSourceModel(self.model_of_edges)
        self._sorted.setSortRole(_SORTED_BY)
        self.setModel(self._sorted)
        self.setSortingEnabled(True)
        self.sortByColumn(_GAP_COLUMN, QtCore.Qt.DescendingOrder)
        self.setSelectionBehavior(QtGui.QAbstractItemView.SelectRows)
        self.setAlternatingRowColors(True)
        self.setShowGrid(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(self.fontMetrics().height() + 6)
        self.horizontalHeader().setStretchLastSection(True)
        self.setMinimumHeight(130)
        self.selectionModel().selectionChanged.connect(self._tell)

    def show_edges(self, edges: list, opened: list) -> None:
        """Fills the table."""
        self.model_of_edges.show(edges, opened)
        self.resizeColumnsToContents()

    def chosen_edges(self) -> list[int]:
        """Numbers of the edges in the selected rows."""
        rows = [self._sorted.mapToSource(i).row() for i in self.selectionModel().selectedRows()]
        return [self.model_of_edges.edges[row].index for row in rows]

    def choose(self, number_: int) -> None:
        """Selects the row of an edge alone."""
        found = [edge.index for edge in self.model_of_edges.edges].index(number_)
        row = self._sorted.mapFromSource(self.model_of_edges.index(found, 0)).row()
        self.selectRow(row)

    def _tell(self, *_):
        self.chosen.emit(self.chosen_edges())
