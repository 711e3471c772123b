#include "read/open_raster.hpp"

#include <string_view>

#include <cpl_vsi.h>

#include "core/error.hpp"
#include "read/gdal_messages.hpp"

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

DatasetOwner open_dataset(const ReadOptions& options, const std::string& path, Context& context) {
    const GdalMessages messages;
    const StringList drivers(options.drivers);
    const StringList open_options(options.open_options);
    DatasetOwner dataset(GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                    drivers.get(), open_options.get(), nullptr));
    if (!dataset)
        throw InputError("'" + options.source +
                         "' cannot be opened as a raster: " + messages.reason_for(path) + ".");
    messages.pass_all(context);
    return dataset;
}

/// The first few sub-datasets by name, or "".
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

void check_kind(GDALRasterBandH band, const ReadOptions& options, Context& context) {
    const std::string name = "Band " + std::to_string(options.band) + " of '" + options.source + "'";
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)) != FALSE)
        throw InputError(name +
                         " holds complex numbers, which are no elevations; choose another band with -b.");
    if (GDALGetRasterColorInterpretation(band) == GCI_PaletteIndex &&
        GDALGetRasterColorTable(band) != nullptr)
        context.warn(name + " holds indices into a colour table; they are taken as elevations.");
}

/// GDAL reads what is missing at the end of an ENVI file as zeros, since such files may be sparse. Zeros that
/// nobody measured must not become elevations.
void check_length(GDALDatasetH dataset, const ReadOptions& options) {
    const char* compression = GDALGetMetadataItem(dataset, "file_compression", "ENVI");
    const bool plain = compression == nullptr || std::string_view(compression) == "0";
    const GDALDriverH driver = GDALGetDatasetDriver(dataset);
    if (driver == nullptr || std::string_view(GDALGetDriverShortName(driver)) != "ENVI" || !plain)
        return;
    const int bytes = GDALGetDataTypeSizeBytes(GDALGetRasterDataType(GDALGetRasterBand(dataset, 1)));
    const GUIntBig needed = static_cast<GUIntBig>(GDALGetRasterXSize(dataset)) *
                            static_cast<GUIntBig>(GDALGetRasterYSize(dataset)) *
                            static_cast<GUIntBig>(GDALGetRasterCount(dataset)) * static_cast<GUIntBig>(bytes);
    VSIStatBufL status{};
    if (VSIStatExL(GDALGetDescription(dataset), &status, VSI_STAT_SIZE_FLAG) == 0 &&
        static_cast<GUIntBig>(status.st_size) < needed)
        throw InputError("'" + options.source + "' has " + std::to_string(status.st_size) +
                         " bytes where its header " + "promises " + std::to_string(needed) +
                         "; it is truncated, so copy it again.");
}

/// A text grid has a digit and a blank a cell. GDAL would look for what is missing again and again: for hours
/// where the header speaks of a million rows.
void check_text_length(GDALDatasetH dataset, const ReadOptions& options) {
    const GDALDriverH driver = GDALGetDatasetDriver(dataset);
    if (driver == nullptr || std::string_view(GDALGetDriverShortName(driver)) != "AAIGrid")
        return;
    const GUIntBig needed = 2 * static_cast<GUIntBig>(GDALGetRasterXSize(dataset)) *
                                static_cast<GUIntBig>(GDALGetRasterYSize(dataset)) -
                            1;
    VSIStatBufL status{};
    if (VSIStatExL(GDALGetDescription(dataset), &status, VSI_STAT_SIZE_FLAG) == 0 &&
        static_cast<GUIntBig>(status.st_size) < needed)
        throw InputError("'" + options.source + "' has " + std::to_string(status.st_size) +
                         " bytes where its header promises " + std::to_string(needed) +
                         " at least; it is truncated, so copy it again.");
}

}  // namespace

OpenRaster open_raster(const ReadOptions& options, const std::string& path, Context& context) {
    check_options(options);
    OpenRaster raster{open_dataset(options, path, context), nullptr};
    raster.band = pick_band(raster.dataset.get(), options);
    check_kind(raster.band, options, context);
    check_length(raster.dataset.get(), options);
    check_text_length(raster.dataset.get(), options);
    return raster;
}

OpenRaster open_first_band(const std::string& name, const std::string& path, Context& context) {
    ReadOptions options;
    options.source = name;
    OpenRaster raster{open_dataset(options, path, context), nullptr};
    raster.band = pick_band(raster.dataset.get(), options);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(raster.band)) != FALSE)
        throw InputError("Band 1 of '" + name + "' holds complex numbers; give a raster of real numbers.");
    check_length(raster.dataset.get(), options);
    check_text_length(raster.dataset.get(), options);
    return raster;
}

}  // namespace d2b
