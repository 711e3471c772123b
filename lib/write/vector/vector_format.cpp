#include "write/vector/vector_format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "options/provenance_text.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::writing {

std::string probe_name(GDALDriverH driver, const std::string& destination) {
    if (is_stream(destination)) {
        const char* extension = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSION, nullptr);
        return extension == nullptr ? "probe" : "probe." + std::string(extension);
    }
    const auto slash = destination.find_last_not_of('/');
    const std::string path = destination.substr(0, slash == std::string::npos ? 0 : slash + 1);
    const std::string file = path.substr(path.find_last_of('/') + 1);
    const auto dot = file.find('.', 1);
    return dot == std::string::npos ? "probe" : "probe" + file.substr(dot);
}

reading::DatasetOwner create_trial(GDALDriverH driver, const std::string& file) {
    return reading::DatasetOwner(GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
}

OGRLayerH add_trial_layer(GDALDatasetH dataset, const char* name, OGRSpatialReferenceH srs) {
    return GDALDatasetCreateLayer(dataset, name, srs, wkbMultiPolygon, nullptr);
}

bool add_trial_feature(OGRLayerH layer, const Position& place) {
    constexpr double size = 1e-4;
    const FieldOwner field(OGR_Fld_Create("id", OFTInteger64));
    OGR_L_CreateField(layer, field.get(), TRUE);
    const reading::FeatureOwner feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
    for (const Position& corner :
         {place, Position{place.x + size, place.y}, Position{place.x + size, place.y + size}, place})
        OGR_G_AddPoint_2D(ring, corner.x, corner.y);
    OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon);
    OGR_G_AddGeometryDirectly(polygon, ring);
    OGRGeometryH whole = OGR_G_CreateGeometry(wkbMultiPolygon);
    OGR_G_AddGeometryDirectly(whole, polygon);
    OGR_F_SetGeometryDirectly(feature.get(), whole);
    if (OGR_F_GetFieldCount(feature.get()) > 0)
        OGR_F_SetFieldInteger64(feature.get(), 0, 1);
    return OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE;
}

bool has_capability(GDALDriverH driver, const char* capability) {
    const char* value = GDALGetMetadataItem(driver, capability, nullptr);
    return value != nullptr && EQUAL(value, "YES");
}

bool has_native_transactions(GDALDatasetH dataset) {
    return GDALDatasetTestCapability(dataset, ODsCTransactions) != FALSE &&
           GDALDatasetTestCapability(dataset, ODsCEmulatedTransactions) == FALSE;
}

namespace {

bool add_layer(GDALDatasetH dataset, const char* name) {
    const reading::CrsOwner srs(OSRNewSpatialReference(nullptr));
    OSRSetWellKnownGeogCS(srs.get(), "WGS84");
    OGRLayerH layer = add_trial_layer(dataset, name, srs.get());
    return layer != nullptr && add_trial_feature(layer, {});
}

void write_two_layers(const std::string& file, VectorFormat& format) {
    const reading::DatasetOwner dataset = create_trial(format.driver, file);
    format.transactions = dataset && has_native_transactions(dataset.get());
    format.multiple_layers = dataset && add_layer(dataset.get(), "one") &&
                             GDALDatasetTestCapability(dataset.get(), ODsCCreateLayer) != FALSE &&
                             add_layer(dataset.get(), "two");
}

void read_back(const std::string& file, VectorFormat& format) {
    const reading::DatasetOwner dataset = open_dataset(format, file, GDAL_OF_READONLY);
    if (!dataset)
        return;
    format.multiple_layers = format.multiple_layers && GDALDatasetGetLayerCount(dataset.get()) > 1;
    // By its files, because GDAL 3.10 shows no index as a layer.
    if (format.folder)
        for (const std::string& name : names_in(file))
            if (const std::string stem = std::filesystem::path(name).stem().string();
                stem != "one" && stem != "two")
                format.indices.push_back(stem);
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
    format.preserves_crs = layer != nullptr && OGR_L_GetSpatialRef(layer) != nullptr;
}

/// Finds the properties of a format by writing two layers with one feature each into /vsimem/ under a name
/// with the extension of the destination. Capabilities are not enough, because the Shapefile, CSV and
/// FlatGeobuf drivers hold several layers in a folder but one in a file, and some accept a second layer and
/// put it elsewhere.
void probe(VectorFormat& format, const std::string& destination) {
    const reading::GdalMessages quiet;
    if (is_connection(format.driver, destination) || !has_capability(format.driver, GDAL_DCAP_VIRTUALIO)) {
        format.multiple_layers = has_capability(format.driver, GDAL_DCAP_MULTIPLE_VECTOR_LAYERS);
        return;
    }
    const std::string name = probe_name(format.driver, destination);
    // GeoPackage is known, and a trial takes longer than a small raster.
    if (format.name == "GPKG") {
        const std::size_t dot = name.find('.');
        format.multiple_layers = format.transactions = format.in_memory = true;
        if (dot != std::string::npos)
            format.suffixes = {name.substr(dot)};
        return;
    }
    const VsimemFolder memory;
    const std::string file = memory.file(name);
    write_two_layers(file, format);
    VSIStatBufL status{};
    format.in_memory = VSIStatL(file.c_str(), &status) == 0;
    format.folder = format.in_memory && VSI_ISDIR(status.st_mode);
    if (!format.folder)
        for (const std::string& each : names_in(memory.file("")))
            if (each.starts_with("probe."))
                format.suffixes.push_back(each.substr(5));
    read_back(file, format);
}

std::string metadata(GDALDriverH driver, const char* item) {
    const char* value = GDALGetMetadataItem(driver, item, nullptr);
    return value == nullptr ? std::string() : std::string(value);
}

/// True if the driver creates vector layers; excludes drivers in memory, because they would lose the result.
bool can_create(GDALDriverH driver) {
    const std::string name = GDALGetDriverShortName(driver);
    return name != "Memory" && name != "MEM" && has_capability(driver, GDAL_DCAP_VECTOR) &&
           has_capability(driver, GDAL_DCAP_CREATE) && has_capability(driver, GDAL_DCAP_CREATE_LAYER);
}

/// Lists common formats only, because all of them would fill the screen.
std::string some_formats() {
    std::string text;
    for (const char* name :
         {"GPKG", "ESRI Shapefile", "GeoJSON", "FlatGeobuf", "GML", "KML", "SQLite", "CSV"}) {
        GDALDriverH driver = GDALGetDriverByName(name);
        if (driver != nullptr && can_create(driver))
            text += (text.empty() ? "" : ", ") + std::string(name);
    }
    return text;
}

/// True if the name ends in an extension of the driver, which may have several parts ("shp.zip").
bool extension_fits(GDALDriverH driver, const std::string& name) {
    const CPLStringList extensions(CSLTokenizeString2(metadata(driver, GDAL_DMD_EXTENSIONS).c_str(), " ", 0));
    std::vector<std::string> known(extensions.List(), extensions.List() + extensions.Count());
    known.push_back(metadata(driver, GDAL_DMD_EXTENSION));
    const std::string file = to_lower(name);
    return std::any_of(known.begin(), known.end(), [&file](const std::string& extension) {
        return !extension.empty() && file.size() > extension.size() && file.ends_with(to_lower(extension)) &&
               file[file.size() - extension.size() - 1] == '.';
    });
}

GDALDriverH driver_by_name(const std::string& name) {
    GDALDriverH driver = GDALGetDriverByName(name.c_str());
    if (EQUAL(name.c_str(), "CityGML") || EQUAL(name.c_str(), "CityJSON"))
        throw OptionError(
            "-f " + name +
            " is not a format of layers; -surface writes CityJSON (.city.json), and citygml-tools "
            "from-cityjson makes CityGML of it.");
    if (driver == nullptr || !can_create(driver))
        throw OptionError("Format \"" + name +
                          "\" cannot hold a new vector dataset; -f takes, among others: " + some_formats() +
                          ".");
    return driver;
}

GDALDriverH driver_by_destination(const std::string& destination) {
    for (int i = 0; i < GDALGetDriverCount(); ++i) {
        GDALDriverH driver = GDALGetDriver(i);
        if (can_create(driver) && (is_connection(driver, destination) || extension_fits(driver, destination)))
            return driver;
    }
    if (const std::string begin = to_lower(destination.substr(0, destination.find(':')));
        begin == "pg" || begin == "postgresql")
        throw OptionError(
            "\"" + redacted_destination(destination) +
            "\" is in PostgreSQL, which this program was built without; write a GeoPackage, and "
            "load it with ogr2ogr.");
    throw OptionError(
        "The name \"" + destination +
        "\" does not show its format; give it an extension such as .gpkg, or give the format with -f: " +
        some_formats() + ", ...");
}

/// Rejects drivers of vector tiles (MVT, PMTiles, MBTiles), recognized by their zoom levels.
void reject_vector_tiles(GDALDriverH driver, const std::string& destination) {
    const std::string options = metadata(driver, GDAL_DMD_CREATIONOPTIONLIST);
    if (options.find("name='MAXZOOM'") == std::string::npos &&
        options.find("name=\"MAXZOOM\"") == std::string::npos)
        return;
    throw OptionError(
        "\"" + destination + "\" would hold tiles (format " + GDALGetDriverShortName(driver) +
        "), which cut polygons at their borders and move corners onto a coarse grid, so nothing can be read "
        "back unchanged; write a GeoPackage, and make tiles of it with ogr2ogr.");
}

}  // namespace

VectorFormat format_for(const WriteOptions& options) {
    if (options.destination.empty())
        throw OptionError("The name of the destination is empty; give a file, e.g. buildings.gpkg.");
    reading::register_formats();
    VectorFormat format;
    format.driver =
        options.format.empty() ? driver_by_destination(options.destination) : driver_by_name(options.format);
    format.name = GDALGetDriverShortName(format.driver);
    reject_vector_tiles(format.driver, options.destination);
    probe(format, options.destination);
    // GDAL 3.10 writes all layers of a CSV to stdout, one after the other.
    if (format.name == "CSV" && is_stream(options.destination))
        format.multiple_layers = false;
    // Entities of a drawing name their layers, and OGR has all in one.
    if (format.name == "DXF")
        format.multiple_layers = true;
    return format;
}

reading::DatasetOwner open_dataset(const VectorFormat& format, const std::string& path, unsigned access) {
    const std::array<const char*, 2> only{format.name.c_str(), nullptr};
    const auto open = [&](const std::string& name) {
        return reading::open_guarded(name, GDAL_OF_VECTOR | access, only.data());
    };
    reading::DatasetOwner dataset = open(path);
    // GDAL takes a sequence of one feature for plain GeoJSON unless the prefix is given.
    return !dataset && format.name == "GeoJSONSeq" ? open("GeoJSONSeq:" + path) : std::move(dataset);
}

bool is_stream(const std::string& destination) {
    if (destination.starts_with("/vsistdout"))
        return true;
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(destination, error);
    return !destination.starts_with("/vsi") && std::filesystem::exists(status) &&
           !std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status);
}

bool is_connection(GDALDriverH driver, const std::string& destination) {
    const std::string prefix = metadata(driver, GDAL_DMD_CONNECTION_PREFIX);
    return !prefix.empty() && to_lower(destination).starts_with(to_lower(prefix));
}

bool has_layer_option(GDALDriverH driver, const std::string& name) {
    const std::string list = metadata(driver, GDAL_DS_LAYER_CREATIONOPTIONLIST);
    return list.find("name='" + name + "'") != std::string::npos ||
           list.find("name=\"" + name + "\"") != std::string::npos;
}

}  // namespace d2b::writing
