#include "read/open_raster.hpp"

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/header_claims.hpp"
#include "read/source_advice.hpp"

namespace d2b {

namespace {

constexpr int listed_subdatasets = 3;

void check_options(const ReadOptions& options) {
    for (const std::string& name : options.drivers)
        if (GDALGetDriverByName(name.c_str()) == nullptr)
            throw OptionError("-if " + name +
                              " names no format of this GDAL; gdalinfo --formats lists them.");
    for (const std::string& option : options.open_options)
        if (option.find('=', 1) == std::string::npos)
            throw OptionError("-oo " + option + " must have the form NAME=VALUE.");
}

DatasetOwner open_dataset(const ReadOptions& options, const std::string& path, Warnings& warnings) {
    const GdalMessages messages(path, options.source);
    const StringList drivers(options.drivers);
    const StringList open_options(options.open_options);
    DatasetOwner dataset = open_gated(path, GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                      drivers.get(), open_options.get());
    if (!dataset)
        throw InputError("'" + options.source + "' cannot be opened as a raster: " +
                         messages.reason_for(options.source) + unopened_advice(path) + ".");
    messages.pass_all(warnings);
    return dataset;
}

/// Lists the first few sub-datasets by name, or returns "".
std::string subdatasets_text(GDALDatasetH dataset) {
    std::string names;
    for (int i = 1;; ++i) {
        const std::string key = "SUBDATASET_" + std::to_string(i) + "_NAME";
        const char* name = GDALGetMetadataItem(dataset, key.c_str(), "SUBDATASETS");
        if (name == nullptr)
            return names;
        if (i > listed_subdatasets)
            return names + " and others";
        names += (i == 1 ? "" : ", ") + std::string(name);
    }
}

GDALRasterBandH pick_band(GDALDatasetH dataset, const ReadOptions& options) {
    const int count = GDALGetRasterCount(dataset);
    if (count == 0) {
        const std::string names = subdatasets_text(dataset);
        if (names.empty())
            throw InputError("'" + options.source + "' has no raster band; give another source.");
        throw InputError("'" + options.source +
                         "' only holds sub-datasets; give one of them as the source: " + names + ".");
    }
    if (options.band < 1 || options.band > count)
        throw InputError("'" + options.source + "' has no band " + std::to_string(options.band) +
                         "; its bands are numbered from 1 to " + std::to_string(count) + ".");
    return GDALGetRasterBand(dataset, options.band);
}

void check_kind(GDALRasterBandH band, const ReadOptions& options, Warnings& warnings) {
    const std::string name = "Band " + std::to_string(options.band) + " of '" + options.source + "'";
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)) != FALSE)
        throw InputError(name +
                         " holds complex numbers, which are no elevations; choose another band with -b.");
    if (GDALGetRasterColorInterpretation(band) == GCI_PaletteIndex &&
        GDALGetRasterColorTable(band) != nullptr)
        warnings.add(name + " holds indices into a colour table; they are taken as elevations.");
}

}  // namespace

OpenRaster open_raster(const ReadOptions& options, const std::string& path, Warnings& warnings) {
    check_options(options);
    OpenRaster raster{open_dataset(options, path, warnings), nullptr};
    raster.band = pick_band(raster.dataset.get(), options);
    check_kind(raster.band, options, warnings);
    check_claims(raster, options.source);
    return raster;
}

OpenRaster open_first_band(const std::string& name, const std::string& path, Warnings& warnings) {
    ReadOptions options;
    options.source = name;
    OpenRaster raster{open_dataset(options, path, warnings), nullptr};
    raster.band = pick_band(raster.dataset.get(), options);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(raster.band)) != FALSE)
        throw InputError("Band 1 of '" + name + "' holds complex numbers; give a raster of real numbers.");
    check_claims(raster, name);
    return raster;
}

}  // namespace d2b
