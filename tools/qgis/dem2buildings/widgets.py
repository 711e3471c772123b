"""Widgets of parameters, where those of Processing do not fit."""

from processing.gui.wrappers import WidgetWrapper
from qgis.core import QgsProcessingContext
from qgis.gui import QgsExtentWidget, QgsFileWidget, QgsGui, QgsProjectionSelectionWidget
from qgis.PyQt import sip
from qgis.PyQt.QtWidgets import QAbstractSpinBox, QLineEdit


class SavedFile(WidgetWrapper):
    """A file that is written on request. Processing shows its own output parameters before the advanced ones."""

    def createWidget(self, files=""):
        """@param files a filter such as "PNG (*.png);;SVG (*.svg)" """
        widget = QgsFileWidget()
        widget.setStorageMode(QgsFileWidget.StorageMode.SaveFile)
        widget.setFilter(files)
        widget.lineEdit().setPlaceholderText("none")
        widget.fileChanged.connect(lambda: self.widgetValueHasChanged.emit(self))
        return widget

    def setValue(self, value):
        self.widget.setFilePath("" if value is None else str(value))

    def value(self):
        return self.widget.filePath()


class Automatic(WidgetWrapper):
    """A value that the program chooses if none is given. Processing calls it "Not set"."""

    def __new__(cls, parameter, dialog, row=0, col=0, text=""):
        # A model also takes values from elsewhere, with the widget of Processing.
        if type(dialog).__name__ != "ModelerParametersDialog":
            return super().__new__(cls, parameter, dialog, row, col, text=text)
        widget = QgsGui.processingGuiRegistry().createModelerParameterWidget(dialog.model, dialog.childId, parameter,
                                                                             dialog.context)
        widget.setDialog(dialog)
        return widget

    def createWidget(self, text=""):
        """@param text for the value that the program chooses"""
        self.context = QgsProcessingContext()
        self.inner = QgsGui.processingGuiRegistry().createParameterWidgetWrapper(self.parameterDefinition(), self.dialogType)
        widget = self.inner.createWrappedWidget(self.context)
        self.inner.widgetValueHasChanged.connect(lambda: self.widgetValueHasChanged.emit(self))
        # Processing hands over a mere QWidget.
        kind = widget.metaObject().className()
        if kind == "QgsExtentWidget":
            sip.cast(widget, QgsExtentWidget).setNullValueAllowed(True, text)
            self.inner.setParameterValue(None, self.context)  # shows the text
        elif kind == "QgsProjectionSelectionWidget":
            sip.cast(widget, QgsProjectionSelectionWidget).setNotSetText(text)
        else:
            # It is a box to type in, or has one beside a button.
            box = widget if isinstance(widget, QAbstractSpinBox) else widget.findChild(QAbstractSpinBox)
            box.setSpecialValueText(text)
            box.findChild(QLineEdit).setPlaceholderText(text)  # for the button that clears it
        return widget

    def setValue(self, value):
        self.inner.setParameterValue(value, self.context)

    def value(self):
        return self.inner.parameterValue()
