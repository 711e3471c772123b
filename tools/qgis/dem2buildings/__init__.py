"""A provider of the Processing toolbox that runs dem2buildings."""


def classFactory(_iface):  # the name that QGIS calls
    from .plugin import Plugin
    return Plugin()
