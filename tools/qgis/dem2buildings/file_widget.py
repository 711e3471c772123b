"""Widget of a file that is written on request. Processing shows its own output parameters before the advanced ones."""

from processing.gui.wrappers import WidgetWrapper
from qgis.gui import QgsFileWidget


class SavedFile(WidgetWrapper):
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
