#include "write/format_probe.hpp"

#include <array>
#include <cstdint>
#include <sys/stat.h>

#include <cpl_vsi.h>

#include "read/gdal_messages.hpp"
#include "write/ogr_handles.hpp"
#include "write/vector_format.hpp"

namespace d2b {

namespace {

/// A folder of /vsimem/ of its own; the address of a living object is unique in the process.
class MemoryFolder {
  public:
    MemoryFolder() : path_("/vsimem/d2b_probe_" + std::to_string(reinterpret_cast<std::uintptr_t>(this))) {
        VSIMkdir(path_.c_str(), 0755);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;
    ~MemoryFolder() { VSIRmdirRecursive(path_.c_str()); }
    /// Of the files called probe.* alone: a driver may have put others there.
    [[nodiscard]] std::vector<std::string> suffixes() const {
        std::vector<std::string> found;
        const CPLStringList names(VSIReadDir(path_.c_str()));
        for (int i = 0; i < names.Count(); ++i) {
            const std::string name = names[i];
            if (name.starts_with("probe."))
                found.push_back(name.substr(5));
        }
        return found;
    }
    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

/// The part of the name that decides how a driver lays its files out. A stream is always one file.
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

bool add_layer(GDALDatasetH dataset, const char* name) {
    const SrsHandle srs(OSRNewSpatialReference(nullptr));
    OSRSetWellKnownGeogCS(srs.get(), "WGS84");
    OGRLayerH layer = GDALDatasetCreateLayer(dataset, name, srs.get(), wkbMultiPolygon, nullptr);
    if (layer == nullptr)
        return false;
    const FieldHandle field(OGR_Fld_Create("id", OFTInteger64));
    OGR_L_CreateField(layer, field.get(), TRUE);
    const FeatureHandle feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    std::string wkt = "MULTIPOLYGON (((0 0,1 0,1 1,0 0)))";
    char* text = wkt.data();
    OGRGeometryH geometry = nullptr;
    if (OGR_G_CreateFromWkt(&text, nullptr, &geometry) == OGRERR_NONE)
        OGR_F_SetGeometryDirectly(feature.get(), geometry);
    if (OGR_F_GetFieldCount(feature.get()) > 0)
        OGR_F_SetFieldInteger64(feature.get(), 0, 1);
    return OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE;
}

bool writes_two(GDALDriverH driver, const std::string& file, bool& transactions) {
    const DatasetHandle dataset(GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    transactions = dataset && GDALDatasetTestCapability(dataset.get(), ODsCTransactions) != FALSE &&
                   GDALDatasetTestCapability(dataset.get(), ODsCEmulatedTransactions) == FALSE;
    return dataset && add_layer(dataset.get(), "one") &&
           GDALDatasetTestCapability(dataset.get(), ODsCCreateLayer) != FALSE &&
           add_layer(dataset.get(), "two");
}

void read_back(GDALDriverH driver, const std::string& file, FormatProbe& result) {
    const char* name = GDALGetDriverShortName(driver);
    const std::array<const char*, 2> only{name, nullptr};
    const DatasetHandle dataset(GDALOpenEx(file.c_str(), GDAL_OF_VECTOR, only.data(), nullptr, nullptr));
    if (!dataset)
        return;
    result.several_layers = result.several_layers && GDALDatasetGetLayerCount(dataset.get()) > 1;
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
    result.keeps_crs = layer != nullptr && OGR_L_GetSpatialRef(layer) != nullptr;
}

bool says_yes(GDALDriverH driver, const char* capability) {
    const char* value = GDALGetMetadataItem(driver, capability, nullptr);
    return value != nullptr && EQUAL(value, "YES");
}

}  // namespace

FormatProbe probe_format(GDALDriverH driver, const std::string& destination) {
    const GdalMessages quiet;
    FormatProbe result;
    if (is_connection(driver, destination) || !says_yes(driver, GDAL_DCAP_VIRTUALIO)) {
        result.several_layers = says_yes(driver, GDAL_DCAP_MULTIPLE_VECTOR_LAYERS);
        return result;
    }
    const std::string name = probe_name(driver, destination);
    // The format of most runs has no surprises, and a trial takes longer than a small raster.
    if (EQUAL(GDALGetDriverShortName(driver), "GPKG")) {
        const std::size_t dot = name.find('.');
        result.several_layers = result.transactions = true;
        if (dot != std::string::npos)
            result.suffixes = {name.substr(dot)};
        return result;
    }
    const MemoryFolder memory;
    const std::string file = memory.file(name);
    result.several_layers = writes_two(driver, file, result.transactions);
    VSIStatBufL status{};
    result.folder = VSIStatL(file.c_str(), &status) == 0 && VSI_ISDIR(status.st_mode);
    if (!result.folder)
        result.suffixes = memory.suffixes();
    read_back(driver, file, result);
    return result;
}

}  // namespace d2b
