#include "write/format_probe.hpp"

#include <sys/stat.h>

#include <cpl_vsi.h>

#include "read/gdal_messages.hpp"
#include "write/trial_dataset.hpp"
#include "write/vector_format.hpp"

namespace d2b {

namespace {

bool add_layer(GDALDatasetH dataset, const char* name) {
    const CrsOwner srs(OSRNewSpatialReference(nullptr));
    OSRSetWellKnownGeogCS(srs.get(), "WGS84");
    OGRLayerH layer = add_trial_layer(dataset, name, srs.get());
    return layer != nullptr && add_trial_feature(layer, {});
}

bool writes_two(GDALDriverH driver, const std::string& file, bool& transactions) {
    const DatasetOwner dataset(GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    transactions = dataset && GDALDatasetTestCapability(dataset.get(), ODsCTransactions) != FALSE &&
                   GDALDatasetTestCapability(dataset.get(), ODsCEmulatedTransactions) == FALSE;
    return dataset && add_layer(dataset.get(), "one") &&
           GDALDatasetTestCapability(dataset.get(), ODsCCreateLayer) != FALSE &&
           add_layer(dataset.get(), "two");
}

void read_back(GDALDriverH driver, const std::string& file, FormatProbe& result) {
    const DatasetOwner dataset = reopen_trial(driver, file);
    if (!dataset)
        return;
    result.several_layers = result.several_layers && GDALDatasetGetLayerCount(dataset.get()) > 1;
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), 0);
    result.keeps_crs = layer != nullptr && OGR_L_GetSpatialRef(layer) != nullptr;
}

}  // namespace

FormatProbe probe_format(GDALDriverH driver, const std::string& destination) {
    const GdalMessages quiet;
    FormatProbe result;
    if (is_connection(driver, destination) || !says_yes(driver, GDAL_DCAP_VIRTUALIO)) {
        result.several_layers = says_yes(driver, GDAL_DCAP_MULTIPLE_VECTOR_LAYERS);
        return result;
    }
    const std::string name = trial_name(driver, destination);
    // GeoPackage is known, and a trial takes longer than a small raster.
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
