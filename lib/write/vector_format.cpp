#include "write/vector_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include <cpl_string.h>
#include <ogr_api.h>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "write/format_probe.hpp"

namespace d2b {

namespace {

std::string metadata(GDALDriverH driver, const char* item) {
    const char* value = GDALGetMetadataItem(driver, item, nullptr);
    return value == nullptr ? std::string() : std::string(value);
}

/// True if the driver creates vector layers; excludes drivers in memory, because they would lose the result.
bool can_create(GDALDriverH driver) {
    const std::string name = GDALGetDriverShortName(driver);
    return name != "Memory" && name != "MEM" && metadata(driver, GDAL_DCAP_VECTOR) == "YES" &&
           metadata(driver, GDAL_DCAP_CREATE) == "YES" && metadata(driver, GDAL_DCAP_CREATE_LAYER) == "YES";
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

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// True if the name ends in an extension of the driver, which may have several parts ("shp.zip").
bool extension_fits(GDALDriverH driver, const std::string& name) {
    const CPLStringList extensions(CSLTokenizeString2(metadata(driver, GDAL_DMD_EXTENSIONS).c_str(), " ", 0));
    std::vector<std::string> known(extensions.List(), extensions.List() + extensions.Count());
    known.push_back(metadata(driver, GDAL_DMD_EXTENSION));
    const std::string file = lower(name);
    return std::any_of(known.begin(), known.end(), [&file](const std::string& extension) {
        return !extension.empty() && file.size() > extension.size() && file.ends_with(lower(extension)) &&
               file[file.size() - extension.size() - 1] == '.';
    });
}

GDALDriverH driver_by_name(const std::string& name) {
    GDALDriverH driver = GDALGetDriverByName(name.c_str());
    if (driver == nullptr)
        throw OptionError("There is no format \"" + name +
                          "\" in this GDAL; -f takes, among others: " + some_formats() + ".");
    if (!can_create(driver))
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
    throw OptionError(
        "The name \"" + destination +
        "\" does not tell its format; give it an extension such as .gpkg, or say the format with "
        "-f: " +
        some_formats() + ", ...");
}

/// Rejects drivers of vector tiles (MVT, PMTiles, MBTiles), recognized by their zoom levels.
void refuse_tiles(GDALDriverH driver, const std::string& destination) {
    const std::string options = metadata(driver, GDAL_DMD_CREATIONOPTIONLIST);
    if (options.find("name='MAXZOOM'") == std::string::npos &&
        options.find("name=\"MAXZOOM\"") == std::string::npos)
        return;
    throw OptionError("\"" + destination + "\" would hold tiles (format " + GDALGetDriverShortName(driver) +
                      "), which cut polygons at their borders and move corners onto a coarse grid, so that "
                      "nothing can be read back as it was; write a GeoPackage, and make tiles of it with "
                      "ogr2ogr.");
}

}  // namespace

VectorFormat format_for(const WriteOptions& options) {
    if (options.destination.empty())
        throw OptionError("The name of the destination is empty; give a file, e.g. buildings.gpkg.");
    GDALAllRegister();
    VectorFormat format;
    format.driver =
        options.format.empty() ? driver_by_destination(options.destination) : driver_by_name(options.format);
    format.name = GDALGetDriverShortName(format.driver);
    refuse_tiles(format.driver, options.destination);
    FormatProbe probe = probe_format(format.driver, options.destination);
    // GDAL 3.10 writes all layers of a CSV to stdout, one after the other.
    const bool is_one_table = format.name == "CSV" && is_stream(options.destination);
    format.several_layers = probe.several_layers && !is_one_table;
    format.transactions = probe.transactions;
    format.keeps_crs = probe.keeps_crs;
    format.folder = probe.folder;
    format.suffixes = std::move(probe.suffixes);
    return format;
}

DatasetOwner open_dataset(const VectorFormat& format, const std::string& path, unsigned access) {
    const std::array<const char*, 2> only{format.name.c_str(), nullptr};
    const auto open = [&](const std::string& name) {
        return open_gated(name, GDAL_OF_VECTOR | access, only.data());
    };
    DatasetOwner dataset = open(path);
    // GDAL takes a sequence of one feature for plain GeoJSON unless the prefix is given.
    return !dataset && format.name == "GeoJSONSeq" ? open("GeoJSONSeq:" + path) : std::move(dataset);
}

bool is_stream(const std::string& destination) {
    if (destination.starts_with("/vsistdout"))
        return true;
    struct stat status {};
    return !destination.starts_with("/vsi") && ::stat(destination.c_str(), &status) == 0 &&
           !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

bool is_connection(GDALDriverH driver, const std::string& destination) {
    const std::string prefix = metadata(driver, GDAL_DMD_CONNECTION_PREFIX);
    return !prefix.empty() && lower(destination).starts_with(lower(prefix));
}

bool keeps_virtual_files(GDALDriverH driver) {
    return metadata(driver, GDAL_DCAP_VIRTUALIO) == "YES";
}

bool has_layer_option(GDALDriverH driver, const std::string& name) {
    const std::string list = metadata(driver, GDAL_DS_LAYER_CREATIONOPTIONLIST);
    return list.find("name='" + name + "'") != std::string::npos ||
           list.find("name=\"" + name + "\"") != std::string::npos;
}

}  // namespace d2b
