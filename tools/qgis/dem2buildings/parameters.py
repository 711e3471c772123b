"""Parameters of the dialog, made of the program's table of options, and command lines made of them."""

import re

from osgeo import ogr
from qgis.core import (QgsProcessingException, QgsProcessingFeedback, QgsProcessingParameterBoolean,
                       QgsProcessingParameterCrs, QgsProcessingParameterDefinition, QgsProcessingParameterEnum,
                       QgsProcessingParameterExtent, QgsProcessingParameterMapLayer, QgsProcessingParameterNumber,
                       QgsProcessingParameterRasterLayer, QgsProcessingParameterString,
                       QgsProcessingParameterVectorLayer, QgsProviderRegistry, QgsRasterLayer, QgsVectorFileWriter)

# Options that the dialog replaces: it shows progress, its file dialog has asked whether to replace a file, and a layer that
# is chosen has its name.
LEFT_OUT = {"q", "json", "sweep", "help", "help_all", "version", "overwrite", "f", "srcwin", "projwin", "if", "cutline_layer",
            "mask_layer", "split_layer", "footprints_layer", "exclude_layer", "corrections_layer"}
# The option that names the layer of another one, where that is not its name with _layer.
LAYER_OF = {"split_by": "split_layer"}
# Sections in the order in which they are asked for; the table says which option is in which.
SECTIONS = ("Basic", "Ground", "Trees", "Detail", "Output", "Advanced")
TERRAIN = "_model"
# The first item of a choice, and the text of a number, that the program decides if it is not given.
AUTOMATIC = "automatic"
# Only this parameter of a Basic option is shown at first; the other one is for those who need it.
ADVANCED_PARTS = {"ground"}


def offered(table):
    """The options that the dialog has, section by section."""
    options = [option for option in table if not option["hidden"] and option["name"] not in LEFT_OUT]
    return sorted(options, key=lambda option: SECTIONS.index(option["section"]))


def speaker(table):
    """A function that puts the names of the dialog into a text of the program: "-lod" is nothing to who sees none."""
    titles = {name: option["title"] for option in table for name in (option["name"], *option["aliases"])}

    def spoken(text):
        return re.sub(r"(?<![\w-])-([a-z0-9_]+)",
                      lambda found: f'"{titles[found[1]]}"' if found[1] in titles else found[0], text)
    return spoken


def help_of(option, spoken):
    """The dialog's help on an option, without the sentences on how it is typed on a command line."""
    text = " ".join(part for part in (option["help"], option["details"]) if part)
    sentences = re.split(r"(?<=\.) (?=[A-Z])", text)
    typing = re.compile(r"needs its path|numbers that follow|^Given as for")
    return spoken(" ".join(sentence for sentence in sentences if not typing.search(sentence)))


def default_of(option):
    """The value that the option has if it is not given, or that it has in the default preset; "" if there is none."""
    return option["default"] or option["usual"]


def _show_if_not_given(parameter, text):
    """Names the value that the program then chooses. Processing says "Not set"."""
    parameter.setMetadata({"widget_wrapper": {"class": f"{__package__}.widgets.Automatic", "text": text}})


def _number(option):
    kinds = QgsProcessingParameterNumber
    whole = option["kind"] == "whole"
    default = default_of(option)
    parameter = kinds(option["name"], _label(option), kinds.Integer if whole else kinds.Double, optional=not default)
    if default:
        parameter.setDefaultValue(float(default))
    else:
        _show_if_not_given(parameter, AUTOMATIC)
    for bound, setter in (("lowest", parameter.setMinimum), ("highest", parameter.setMaximum)):
        if bound in option:
            setter(option[bound])
    return parameter


def _label(option, title=None):
    # An extent has its CRS beside it.
    unit = f" [{option['unit'].replace('m2', 'm²')}]" if option["unit"] and option["kind"] != "extent" else ""
    section = "" if option["section"] in ("Basic", "Advanced") else f"{option['section']}: "
    return section + (title or option["title"]) + unit


def _words(option):
    """The words of a choice in the order of the dialog; None for the item of those without a default."""
    return option["choices"] if default_of(option) in option["choices"] else [None, *option["choices"]]


def _choice(option):
    words = _words(option)
    default = default_of(option) if words == option["choices"] else None
    titles = [AUTOMATIC] * (len(words) - len(option["choices"])) + option["choice_titles"]
    return QgsProcessingParameterEnum(option["name"], _label(option), titles, defaultValue=words.index(default))


def _form(values):
    """How the text of an option is written, in the words of its synopsis; "" if it is any text."""
    if re.fullmatch(r"<\w+>", values):
        return ""
    if values.endswith("...]"):
        return "numbers with blanks between them"
    *first, last = re.sub("[<>]", "", values).replace("|" if "|" in values else " ", "\n").split("\n")
    return f"{', '.join(first)} {'or' if '|' in values else 'and'} {last}" if first else last


def _text(option):
    form = _form(option["values"])
    return QgsProcessingParameterString(option["name"], _label(option, option["title"] + (f": {form}" if form else "")),
                                        optional=True)


def _endings(option):
    """Endings of the names of files that an option writes; none for other options."""
    return option["kind"].split(":")[1].split(",") if option["kind"].startswith("file:") else []


def _files(option):
    """The names of the files that an option writes as the dialog has them, with their endings: one for all, or where the
    option may be given again, as `-surface`, one a format."""
    if option["repeatable"]:
        return {f"{option['name']}_{ending.replace('.', '')}": [ending] for ending in _endings(option)}
    return {option["name"]: _endings(option)}


def _file(option, name, endings):
    """A text with a widget of its own, because Processing always shows its parameters of files that are written."""
    title = f"{option['title']} (.{endings[0]})" if option["repeatable"] else None
    parameter = QgsProcessingParameterString(name, _label(option, title), optional=True)
    files = ";;".join(f"{ending.upper()} (*.{ending})" for ending in endings)
    parameter.setMetadata({"widget_wrapper": {"class": f"{__package__}.widgets.SavedFile", "files": files}})
    return parameter


SIMPLE = {"raster": QgsProcessingParameterRasterLayer, "vector": QgsProcessingParameterVectorLayer,
          "dataset": QgsProcessingParameterMapLayer, "crs": QgsProcessingParameterCrs,
          "extent": QgsProcessingParameterExtent}
# What an option that is not given stands for.
NOT_GIVEN = {"crs": "as the raster", "extent": "whole raster"}


def make(option):
    """The parameters of an option: one, or for the terrain a choice and a raster, and for surfaces a file a format."""
    kind, name = option["kind"], option["name"]
    if kind == "switch":
        return [QgsProcessingParameterBoolean(name, _label(option), defaultValue=False)]
    if kind in ("whole", "number"):
        return [_number(option)]
    if kind == "choice":
        return [_choice(option)]
    if kind == "terrain":
        model = QgsProcessingParameterRasterLayer(name + TERRAIN, _label(option, "Terrain model (DTM), if there is one"), optional=True)
        return [_choice(option), model]
    if kind in SIMPLE:
        parameter = SIMPLE[kind](name, _label(option), optional=True)
        if kind in NOT_GIVEN:
            _show_if_not_given(parameter, NOT_GIVEN[kind])
        return [parameter]
    if kind.startswith("file:"):
        return [_file(option, *file) for file in _files(option).items()]
    return [_text(option)]


def all_of(table):
    """All parameters of the dialog, the advanced ones marked."""
    spoken = speaker(table)
    parameters = []
    for option in offered(table):
        for parameter in make(option):
            if option["section"] != "Basic" or parameter.name() in ADVANCED_PARTS:
                parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
            # The option of the terrain has two parameters.
            parameter.setHelp("Elevations of the bare ground, as a raster. Without it "
                              f'"{option["title"]}" decides.' if parameter.name() == option["name"] + TERRAIN else
                              help_of(option, spoken))
            parameters.append(parameter)
    return parameters


def _plain(value):
    """A number as the program reads it."""
    return str(int(value)) if float(value) == int(value) else repr(float(value))


def _file_of(layer, name):
    """The name by which GDAL opens a layer."""
    if layer is None:
        raise QgsProcessingException(f"There is no layer that {name} names.")
    return layer.source().split("|")[0]


def _polygons(algorithm, option, given, context):
    """File and layer of the chosen polygons: a filtered layer, or one in no file, is written into one first."""
    layer = algorithm.parameterAsLayer(given, option["name"], context)
    if layer is None or isinstance(layer, QgsRasterLayer):
        return [_file_of(layer, option["name"])]
    place, name = algorithm.parameterAsCompatibleSourceLayerPathAndLayerName(
        given, option["name"], context, QgsVectorFileWriter.supportedFormatExtensions(), "gpkg",
        QgsProcessingFeedback())
    number = QgsProviderRegistry.instance().decodeUri("ogr", layer.source()).get("layerId")
    if not name and number is not None:
        dataset = ogr.Open(place)  # must outlive its layer
        name = dataset.GetLayer(int(number)).GetName()
    names_it = LAYER_OF.get(option["name"], option["name"] + "_layer")
    return [place.split("|")[0], *(["-" + names_it, name] if name else [])]


def _values(algorithm, option, given, context):
    """The texts behind an option; None where it is as the program has it anyway."""
    name, kind = option["name"], option["kind"]
    if given.get(name) in (None, "") and not (kind == "terrain" and given.get(name + TERRAIN)):
        return None
    if kind == "switch":
        return [] if algorithm.parameterAsBool(given, name, context) else None
    if kind == "terrain" and given.get(name + TERRAIN):
        return [_file_of(algorithm.parameterAsRasterLayer(given, name + TERRAIN, context), name)]
    if kind in ("choice", "terrain"):
        word = _words(option)[algorithm.parameterAsEnum(given, name, context)]
        return None if word in (None, default_of(option)) else [word]
    if kind in ("whole", "number"):
        text = _plain(algorithm.parameterAsDouble(given, name, context))
        return None if default_of(option) and float(default_of(option)) == float(text) else [text]
    if kind == "numbers":
        return algorithm.parameterAsString(given, name, context).replace(",", " ").split()
    if kind == "crs":
        crs = algorithm.parameterAsCrs(given, name, context)
        return [crs.authid() or crs.toWkt()]
    if kind == "raster":
        return [_file_of(algorithm.parameterAsRasterLayer(given, name, context), name)]
    if kind in ("vector", "dataset"):
        return _polygons(algorithm, option, given, context)
    return [algorithm.parameterAsString(given, name, context)]


def command_line(algorithm, table, given, dem, context):
    """The options of a run. @param dem the raster, in whose CRS an extent is"""
    words = []
    for option in offered(table):
        if option["kind"].startswith("file:"):
            for name in _files(option):
                if given.get(name) not in (None, ""):
                    words += ["-" + option["name"], algorithm.parameterAsString(given, name, context)]
            continue
        if option["kind"] == "extent":
            if not given.get(option["name"]):
                continue
            box = algorithm.parameterAsExtent(given, option["name"], context, dem.crs())
            values = [repr(edge) for edge in (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum())]
        else:
            values = _values(algorithm, option, given, context)
        if values is not None:
            words += ["-" + option["name"], *values]
    return words
