#include "read/open_raster.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "read/fetch_gate.hpp"
#include "read/gdal_messages.hpp"
#include "read/source_files.hpp"

namespace d2b::reading {

namespace {

/// Keeps positions and their sums within 32 bits.
constexpr int longest_side = 1 << 30;

/// Smaller blocks are accepted whatever the length of the file.
constexpr std::uint64_t always_accepted_block = std::uint64_t{256} << 20;

/// Largest number of cell bytes per byte of a file. A plain file may hold eight cells per byte; among
/// compressions of TIFF, runs of Zstandard expand the most.
constexpr std::uint64_t max_expansion_plain = 8;
constexpr std::uint64_t max_expansion_packed = 100000;

struct Header {
    std::string_view driver;
    std::uint64_t cols = 0;
    std::uint64_t rows = 0;
    std::uint64_t bands = 0;
    std::uint64_t bytes_per_cell = 0;
};

Header header_of(const OpenRaster& raster) {
    GDALDatasetH const dataset = raster.dataset.get();
    const GDALDriverH driver = GDALGetDatasetDriver(dataset);
    return {driver == nullptr ? "" : GDALGetDriverShortName(driver),
            static_cast<std::uint64_t>(GDALGetRasterXSize(dataset)),
            static_cast<std::uint64_t>(GDALGetRasterYSize(dataset)),
            static_cast<std::uint64_t>(GDALGetRasterCount(dataset)),
            static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(GDALGetRasterDataType(raster.band)))};
}

/// Returns nothing if the length is unknown, as for streams.
std::optional<std::uint64_t> length_of_file(GDALDatasetH dataset) {
    VSIStatBufL status{};
    if (VSIStatExL(GDALGetDescription(dataset), &status, VSI_STAT_SIZE_FLAG) != 0)
        return {};
    return static_cast<std::uint64_t>(status.st_size);
}

std::string metadata(GDALMajorObjectH object, const char* name, const char* domain) {
    const char* value = GDALGetMetadataItem(object, name, domain);
    return value == nullptr ? "" : value;
}

[[noreturn]] void throw_truncated(const std::string& name, std::uint64_t bytes, const std::string& needed) {
    throw InputError("'" + name + "' has " + std::to_string(bytes) + " bytes, but its header promises " +
                     needed + "; it is truncated, so copy it again.");
}

/// Rejects truncated ENVI files. GDAL reads their missing end as zeros because such files may be sparse, and
/// those zeros must not become elevations.
void check_envi(const OpenRaster& raster, const Header& header, std::uint64_t bytes,
                const std::string& name) {
    const std::string compression = metadata(raster.dataset.get(), "file_compression", "ENVI");
    if (!compression.empty() && compression != "0")
        return;
    const std::uint64_t needed =
        header.cols * header.rows * header.bytes_per_cell;  // < 2^64: limited sides, 16 bytes per cell
    // Divides because multiplication could overflow: a header may claim any number of bands.
    if (bytes / header.bands < needed)
        throw_truncated(name, bytes,
                        header.bands == 1
                            ? std::to_string(needed)
                            : std::to_string(header.bands) + " times " + std::to_string(needed));
}

/// Counts the words of a text file, including its header, up to `enough`.
std::uint64_t count_words(GDALDatasetH dataset, std::uint64_t enough) {
    const GdalOwner<VSILFILE*, VSIFCloseL> file(VSIFOpenL(GDALGetDescription(dataset), "rb"));
    std::uint64_t words = 0;
    bool inside = false;
    std::vector<char> text(std::size_t{1} << 20);
    while (file && words < enough) {
        const std::size_t got = VSIFReadL(text.data(), 1, text.size(), file.get());
        if (got == 0)
            break;
        for (std::size_t i = 0; i < got; ++i) {
            const bool word = static_cast<unsigned char>(text[i]) > ' ';
            words += word && !inside ? 1 : 0;
            inside = word;
        }
    }
    return words;
}

/// Rejects truncated text grids, because GDAL searches for each missing row again and doubles the effort
/// every time: a few dozen missing rows take hours.
void check_text(const OpenRaster& raster, const Header& header, std::uint64_t bytes,
                const std::string& name) {
    const std::uint64_t cells = header.cols * header.rows;
    const std::uint64_t needed = 2 * cells - 1;  // one digit and one blank per cell
    if (bytes < needed)
        throw_truncated(name, bytes, std::to_string(needed) + " at least");
    if (const std::uint64_t words = count_words(raster.dataset.get(), cells); words < cells)
        throw InputError("'" + name + "' has at most " + std::to_string(words) +
                         " values, but its header promises " + std::to_string(cells) +
                         "; it is truncated, so copy it again.");
}

/// Rejects impossible blocks, because GDAL allocates a whole block, of all bands if they are interleaved.
void check_block(const OpenRaster& raster, const Header& header, std::uint64_t bytes,
                 const std::string& name) {
    int cols = 0;
    int rows = 0;
    GDALGetBlockSize(raster.band, &cols, &rows);
    GDALDatasetH const dataset = raster.dataset.get();
    const bool together = metadata(dataset, "INTERLEAVE", "IMAGE_STRUCTURE") == "PIXEL";
    const bool packed = !metadata(dataset, "COMPRESSION", "IMAGE_STRUCTURE").empty();
    // Doubles, because the product of four numbers of a damaged header may overflow.
    const double block = static_cast<double>(cols) * rows * static_cast<double>(header.bytes_per_cell) *
                         static_cast<double>(together ? header.bands : 1);
    const double most =
        static_cast<double>(bytes) * static_cast<double>(packed ? max_expansion_packed : max_expansion_plain);
    if (block > static_cast<double>(always_accepted_block) && block > most)
        throw InputError("'" + name + "' has " + std::to_string(bytes) +
                         " bytes and a header that claims a block of " + std::to_string(cols) + " x " +
                         std::to_string(rows) + " cells" +
                         (together ? " in " + std::to_string(header.bands) + " bands" : "") +
                         "; it is damaged or truncated, so copy it again.");
}

/// Rejects a raster with an impossible or unsupported header before anything is allocated or read: a side of
/// more than 2^30 cells, an ENVI file or text grid shorter than its cells need, a TIFF with a block larger
/// than its bytes can fill. GDAL itself would read missing cells as zeros, search for them for hours, or
/// allocate the claimed block.
/// @param name for messages @throws InputError
void validate_header(const OpenRaster& raster, const std::string& name) {
    const Header header = header_of(raster);
    if (header.cols > longest_side || header.rows > longest_side)
        throw InputError(
            "'" + name + "' has " + std::to_string(header.cols) + " columns and " +
            std::to_string(header.rows) + " rows; more than " + std::to_string(longest_side) +
            " of either are not supported, so cut it into parts, for example with gdal_translate -srcwin.");
    const std::optional<std::uint64_t> bytes = length_of_file(raster.dataset.get());
    if (!bytes)
        return;
    if (header.driver == "ENVI")
        check_envi(raster, header, *bytes, name);
    else if (header.driver == "AAIGrid")
        check_text(raster, header, *bytes, name);
    else if (header.driver == "GTiff")
        check_block(raster, header, *bytes, name);
}

constexpr int listed_subdatasets = 3;

void check_options(const ReadOptions& options) {
    for (const std::string& name : options.drivers)
        if (GDALGetDriverByName(name.c_str()) == nullptr)
            throw OptionError("-if " + name +
                              " is not a format of this GDAL; gdalinfo --formats lists them.");
    for (const std::string& option : options.open_options)
        if (option.find('=', 1) == std::string::npos)
            throw OptionError("-oo " + option + " must have the form NAME=VALUE.");
}

DatasetOwner open_dataset(const ReadOptions& options, const std::string& path, Warnings& warnings) {
    const GdalMessages messages(path, options.source);
    const StringList drivers(options.drivers);
    const StringList open_options(options.open_options);
    DatasetOwner dataset = open_guarded(path, GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                        drivers.get(), open_options.get());
    if (!dataset)
        throw InputError("'" + options.source + "' cannot be opened as a raster: " +
                         messages.reason_for(options.source) + open_failure_advice(path) + ".");
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
                         " holds complex numbers, which are not elevations; choose another band with -b.");
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
    validate_header(raster, options.source);
    return raster;
}

DemInfo describe_raster(const OpenRaster& raster, const std::string& name) {
    DemInfo info;
    info.name = name;
    info.rows = GDALGetRasterYSize(raster.dataset.get());
    info.cols = GDALGetRasterXSize(raster.dataset.get());
    info.window = {0, 0, info.rows, info.cols};
    if (const GDALDriverH driver = GDALGetDatasetDriver(raster.dataset.get()))
        info.driver = GDALGetDriverShortName(driver);
    if (const char* unit = GDALGetRasterUnitType(raster.band))
        info.band_unit = unit;
    int known = FALSE;
    if (const double scale = GDALGetRasterScale(raster.band, &known); known != FALSE)
        info.scale = scale;
    if (const double offset = GDALGetRasterOffset(raster.band, &known); known != FALSE)
        info.offset = offset;
    const double nodata = GDALGetRasterNoDataValue(raster.band, &known);
    if (known != FALSE && std::isfinite(nodata))
        info.nodata = nodata * info.scale + info.offset;
    return info;
}

OpenRaster open_first_band(const std::string& name, const std::string& path, Warnings& warnings) {
    ReadOptions options;
    options.source = name;
    OpenRaster raster{open_dataset(options, path, warnings), nullptr};
    raster.band = pick_band(raster.dataset.get(), options);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(raster.band)) != FALSE)
        throw InputError("Band 1 of '" + name + "' holds complex numbers; give a raster of real numbers.");
    validate_header(raster, name);
    return raster;
}

}  // namespace d2b::reading
