"""open_dialog: a window with HTML, in the Qt that usdview uses."""

from typing import Any

from pxr.Usdviewq.qt import QtWidgets

__all__ = ["open_dialog"]

_WIDTH, _HEIGHT = 560, 420


def open_dialog(parent: Any, title: str, html: str) -> Any:
    """Return a window with HTML, open beside the main window."""
    dialog = QtWidgets.QDialog(parent)
    dialog.setWindowTitle(title)
    dialog.resize(_WIDTH, _HEIGHT)
    browser = QtWidgets.QTextBrowser(dialog)
    browser.setHtml(html)
    QtWidgets.QVBoxLayout(dialog).addWidget(browser)
    dialog.show()
    return dialog
