"""Extract buildings from a DEM."""

import html
import pathlib
import shlex

from qgis.core import (QgsProcessingAlgorithm, QgsProcessingContext, QgsProcessingException,
                       QgsProcessingLayerPostProcessorInterface, QgsProcessingOutputVectorLayer,
                       QgsProcessingParameterBoolean, QgsProcessingParameterDefinition,
                       QgsProcessingParameterFileDestination, QgsProcessingParameterRasterLayer, QgsProject,
                       QgsVectorLayer)
from qgis.PyQt.QtGui import QIcon

from . import parameters, program

INPUT, OUTPUT, LOAD = "INPUT", "OUTPUT", "LOAD"
ICON = str(pathlib.Path(__file__).with_name("icon.svg"))
LAYERS = ("buildings", "contours", "roofs", "doubtful", "rejected", "problems", "missing")


def icon():
    return QIcon(ICON)


def written_layers(options):
    """The layers that a command line writes: the kind and the name of each."""
    chosen = options[options.index("-layers") + 1] if "-layers" in options else "both"
    prefix = options[options.index("-nln") + 1] if "-nln" in options else None
    layers = []
    for name in LAYERS:
        main = name in ("buildings", "contours")
        switch = {"roofs": "-roofs", "missing": "-footprints"}.get(name, f"-write_{name}")
        if (main and chosen not in (name, "both")) or (not main and switch not in options):
            continue
        alone = name == "buildings" or chosen == name
        layers.append((name, name if prefix is None else prefix if alone else f"{prefix}_{name}"))
    return layers


class WithItsStyle(QgsProcessingLayerPostProcessorInterface):
    """Processing loads layers without the style that their file holds, and into no group. A group for each file keeps
    the layers of a batch apart, which have the same names."""

    # Processing owns and ends the C++ object, but Python must hold on to its own in front, or nothing of this
    # class is left when it is called, after the end of the algorithm.
    kept = []

    @classmethod
    def make(cls, group):
        cls.kept.append(cls())
        cls.kept[-1].group = group
        return cls.kept[-1]

    def postProcessLayer(self, layer, context, _feedback):
        layer.loadDefaultStyle()
        layer.triggerRepaint()
        self.move_to_group(layer, context.project() or QgsProject.instance())

    def move_to_group(self, layer, project):
        root = project.layerTreeRoot()
        node = root.findLayer(layer.id())
        if node is None or node.parent().name() == self.group:
            return
        group = root.findGroup(self.group) or root.insertGroup(0, self.group)
        # The first layers of a file lie on top, as in its list.
        group.addChildNode(node.clone())
        node.parent().removeChildNode(node)


class ExtractBuildings(QgsProcessingAlgorithm):
    def createInstance(self):
        return ExtractBuildings()

    def name(self):
        return "extractbuildings"

    def displayName(self):
        return "Extract buildings from a DEM"

    def tags(self):
        return ["buildings", "dem", "dsm", "footprints", "heights", "3d", "lidar"]

    def shortHelpString(self):
        try:
            table = program.options()
        except program.NotFound as error:
            return str(error)
        spoken = parameters.speaker(table)
        lines = ["Finds the buildings in an elevation raster (a surface model, DSM). Writes one polygon per building "
                 "with its heights, and the contours of its parts from low to high. An existing GeoPackage keeps its "
                 "other layers."]
        section = None
        for option in parameters.offered(table):
            heading = "" if option["section"] == section else f"<h4>{option['section']}</h4>"
            section = option["section"]
            lines.append(f"{heading}<b>{html.escape(option['title'])}.</b> "
                         f"{html.escape(parameters.help_of(option, spoken), quote=False)}")
        return "<br><br>".join(lines)

    def icon(self):
        return icon()

    def svgIconPath(self):
        return ICON

    def canExecute(self):
        try:
            program.options()
            return True, ""
        except program.NotFound as error:
            return False, str(error)

    def initAlgorithm(self, _configuration=None):
        self.addParameter(QgsProcessingParameterRasterLayer(INPUT, "Elevation raster (DSM)"))
        try:
            for parameter in parameters.all_of(program.options()):
                self.addParameter(parameter)
        except program.NotFound:
            pass  # canExecute() says why
        load = QgsProcessingParameterBoolean(LOAD, "Load the layers into the project", defaultValue=True)
        load.setFlags(load.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
        load.setHelp("Switch it off in a model or a batch that uses the layers itself.")
        self.addParameter(load)
        self.addParameter(QgsProcessingParameterFileDestination(OUTPUT, "Buildings", "GeoPackage (*.gpkg)"))
        for name in LAYERS:
            self.addOutput(QgsProcessingOutputVectorLayer(name.upper(), name))

    def processAlgorithm(self, given, context, feedback):
        dem = self.parameterAsRasterLayer(given, INPUT, context)
        if dem is None:
            raise QgsProcessingException(self.invalidRasterError(given, INPUT))
        target = self.parameterAsFileOutput(given, OUTPUT, context)
        options = parameters.command_line(self, program.options(), given, dem, context)
        if "-append" not in options:
            options.append("-overwrite")
        words = [*options, "--", dem.source(), target]
        feedback.pushCommandInfo(shlex.join([program.find(), *words]))
        status, *said = program.run(words, feedback)
        errors, summary = map(parameters.speaker(program.options()), said)
        if feedback.isCanceled():
            if status == 0:
                feedback.pushWarning(f"It was finished before it could be cancelled: {summary}")
            return {}
        if status != 0:
            raise QgsProcessingException(errors.strip() or f"dem2buildings ended with status {status}.")
        for line in errors.splitlines():
            feedback.pushWarning(line)
        feedback.pushInfo(summary)
        return self.load(target, options, context, self.parameterAsBool(given, LOAD, context))

    def load(self, target, options, context, is_shown):
        """Puts the layers of this run into the project, in their style; others that the file holds are none of it."""
        results = {OUTPUT: target}
        for name, table in written_layers(options):
            place = f"{target}|layername={table}"
            if not QgsVectorLayer(place, table, "ogr").isValid():
                # A file that is one layer, whatever its name.
                place = target
                if len(results) > 1 or not QgsVectorLayer(place, table, "ogr").isValid():
                    continue
            results[name.upper()] = place
            if context.project() is None or not is_shown:
                continue
            details = QgsProcessingContext.LayerDetails(table, context.project(), name.upper())
            details.setPostProcessor(WithItsStyle.make(pathlib.Path(target).stem))
            context.addLayerToLoadOnCompletion(place, details)
        return results
