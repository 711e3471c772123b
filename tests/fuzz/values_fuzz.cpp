// Any small raster is read, in pieces and as a part, as a slow reference says of each cell whether it is
// valid.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "fuzz/bytes.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::test {
namespace {

constexpr const char* path = "/vsimem/values.tif";
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Type of stored elevations, with the ends of the range; a float is one that has fractions.
struct Type {
    GDALDataType type;
    double lowest, highest;
    bool fractions = false;
};
constexpr std::array types{Type{GDT_Byte, 0, 255},
                           Type{GDT_UInt16, 0, 65535},
                           Type{GDT_Int16, -32768, 32767},
                           Type{GDT_UInt32, 0, 4294967295.},
                           Type{GDT_Int32, -2147483648., 2147483647.},
                           Type{GDT_Float32, -infinity, infinity, true},
                           Type{GDT_Float64, -infinity, infinity, true}};

/// Numbers with a meaning in some file, and their neighbours.
constexpr std::array interesting{0.,
                                 1.,
                                 7.,
                                 254.,
                                 255.,
                                 100.,
                                 -9999.,
                                 9999.,
                                 -32768.,
                                 65535.,
                                 -1.,
                                 0.1,
                                 0.3,
                                 -0.,
                                 2.5,
                                 1e30,
                                 -1e30,
                                 3.4028234663852886e38,
                                 -3.4028234663852886e38,
                                 -3.4028235e38,
                                 infinity,
                                 -infinity,
                                 std::numeric_limits<double>::quiet_NaN(),
                                 1e-300,
                                 1.7e308,
                                 -1.7e308};

enum class Holes { none, nodata, mask, alpha };

/// A raster with all that decides which of its cells are valid.
struct Case {
    Type type{};
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    Holes holes = Holes::none;
    double nodata = 0;  ///< of Holes::nodata, as it is declared
    double scale = 1;
    double offset = 0;
    std::vector<double> stored{};      ///< a value a cell
    std::vector<std::uint8_t> mask{};  ///< 0 where a cell is not valid, of Holes::mask and Holes::alpha
    CPLStringList creation{};
};

/// As a cell of the type holds it. Beyond the largest float lies how programs write it.
double stored_as(const Type& type, double value) {
    if (value == -3.4028235e38 && type.fractions)  // GDAL compares doubles as loosely
        return -3.4028234663852886e38;
    if (type.type == GDT_Float32)
        return std::abs(value) > 3.4028234663852886e38 ? std::copysign(infinity, value)
                                                       : static_cast<double>(static_cast<float>(value));
    if (type.fractions)
        return value;
    return std::isnan(value) ? 0 : std::clamp(std::nearbyint(value), type.lowest, type.highest);
}

double value_of(Bytes& bytes) {
    return interesting[bytes.below(interesting.size())];
}

CPLStringList layout_of(Bytes& bytes) {
    CPLStringList creation;
    if (bytes.below(2) == 0) {
        for (const char* option : {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"})
            creation.AddString(option);
    } else {
        creation.SetNameValue("BLOCKYSIZE", std::to_string(1 + bytes.below(8)).c_str());
    }
    creation.SetNameValue("COMPRESS", std::array{"NONE", "LZW", "DEFLATE"}[bytes.below(3)]);
    // Not of the other byte order: GDAL 3.6 writes strips of NoData alone in this one.
    creation.SetNameValue("BIGTIFF", bytes.below(4) == 0 ? "YES" : "NO");
    return creation;
}

Case case_of(Bytes& bytes) {
    Case c;
    c.type = types[bytes.below(types.size())];
    c.rows = static_cast<std::int32_t>(1 + bytes.below(24));
    c.cols = static_cast<std::int32_t>(1 + bytes.below(24));
    c.creation = layout_of(bytes);
    c.holes = static_cast<Holes>(bytes.below(4));
    if (c.holes == Holes::alpha)
        c.type = types[0];  // of other types alpha is stretched
    c.nodata = value_of(bytes);
    if (!c.type.fractions)
        c.nodata = stored_as(c.type, c.nodata);
    c.scale = std::array{1., 1., 0.01, -2., 1e300}[bytes.below(5)];
    c.offset = std::array{0., 0., 100., -0.5, 1e308}[bytes.below(5)];
    // Few values, so that many are alike.
    std::array<double, 6> palette{};
    for (double& value : palette)
        value = stored_as(c.type, value_of(bytes));
    for (std::int32_t i = 0; i < c.rows * c.cols; ++i) {
        const unsigned cell = bytes.next();
        c.stored.push_back(cell % 8 == 7 ? stored_as(c.type, c.nodata) : palette[cell % palette.size()]);
        c.mask.push_back(cell / 8 % 4 == 0 ? 0 : 255);
    }
    return c;
}

void store(GDALRasterBandH band, const Case& c, void* cells, GDALDataType type) {
    demand(GDALRasterIO(band, GF_Write, 0, 0, c.cols, c.rows, cells, c.cols, c.rows, type, 0, 0) == CE_None,
           "the raster can be written");
}

void write(Case& c) {
    if (c.holes == Holes::alpha)
        c.creation.SetNameValue("ALPHA", "YES");
    const GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, c.cols, c.rows,
                                            c.holes == Holes::alpha ? 2 : 1, c.type.type, c.creation.List());
    demand(dataset != nullptr, "the raster can be made");
    std::array<double, 6> transform{400000, 1, 0, 5800000, 0, -1};
    GDALSetGeoTransform(dataset, transform.data());
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    if (c.holes == Holes::nodata)
        GDALSetRasterNoDataValue(band, c.nodata);
    if (c.scale != 1)
        GDALSetRasterScale(band, c.scale);
    if (c.offset != 0)
        GDALSetRasterOffset(band, c.offset);
    store(band, c, c.stored.data(), GDT_Float64);
    if (c.holes == Holes::alpha)
        store(GDALGetRasterBand(dataset, 2), c, c.mask.data(), GDT_Byte);
    if (c.holes == Holes::mask) {
        GDALCreateDatasetMaskBand(dataset, GMF_PER_DATASET);
        store(GDALGetMaskBand(band), c, c.mask.data(), GDT_Byte);
    }
    GDALClose(dataset);
}

d2b::ReadOptions options_of(Bytes& bytes, const Case& c) {
    d2b::ReadOptions options;
    options.source = path;
    const unsigned nodata = bytes.below(4);
    if (nodata == 0)
        options.ignore_nodata = true;
    if (nodata == 1)  // of the file as often as any other
        options.nodata = bytes.below(2) == 0 ? c.nodata : value_of(bytes);
    if (bytes.below(2) == 0)
        return options;
    const unsigned row = bytes.below(static_cast<unsigned>(c.rows));
    const unsigned col = bytes.below(static_cast<unsigned>(c.cols));
    options.source_window = {static_cast<double>(col), static_cast<double>(row),
                             static_cast<double>(1 + bytes.below(static_cast<unsigned>(c.cols) - col)),
                             static_cast<double>(1 + bytes.below(static_cast<unsigned>(c.rows) - row))};
    return options;
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// Rules of docs/reference/options.md for -snodata and -inodata, a cell at a time. @return nothing where it
/// is not valid
std::optional<double> reference(const Case& c, const d2b::ReadOptions& options, std::size_t cell) {
    const double stored = c.stored[cell];
    const bool masked = c.holes == Holes::mask || c.holes == Holes::alpha;
    if (!options.ignore_nodata) {
        if (masked && c.mask[cell] == 0)
            return {};
        if (c.holes == Holes::nodata && !options.nodata && same(stored, stored_as(c.type, c.nodata)))
            return {};
        // Types other than floats have no cell with a value that they cannot hold.
        if (options.nodata &&
            same(stored, c.type.type == GDT_Float32 ? stored_as(c.type, *options.nodata) : *options.nodata))
            return {};
    }
    const double elevation = stored * c.scale + c.offset;
    return std::isfinite(elevation) ? std::optional(elevation) : std::nullopt;
}

/// Rows are asked for in pieces, as bands are, some of them in two parts, as units do.
void compare(d2b::DemSource& source, const Case& c, const d2b::ReadOptions& options, Bytes& bytes) {
    const d2b::Window w = source.info().window;
    for (std::int32_t row = w.row; row < w.end_row();) {
        const std::int32_t rows = std::min(w.end_row() - row, static_cast<std::int32_t>(1 + bytes.below(16)));
        const auto left = static_cast<std::int32_t>(bytes.below(static_cast<unsigned>(w.cols)));
        for (const d2b::Window& part :
             {d2b::Window{row, w.col, rows, left}, d2b::Window{row, w.col + left, rows, w.cols - left}}) {
            if (part.cols == 0)
                continue;
            std::vector<double> elevations(static_cast<std::size_t>(part.points()), 4711);
            source.read(part, elevations);
            for (std::size_t i = 0; i < elevations.size(); ++i) {
                const auto cols = static_cast<std::size_t>(part.cols);
                const std::size_t cell =
                    (static_cast<std::size_t>(row) + i / cols) * static_cast<std::size_t>(c.cols) +
                    static_cast<std::size_t>(part.col) + i % cols;
                const std::optional<double> expected = reference(c, options, cell);
                demand(expected || std::isnan(elevations[i]), "what is not valid is no elevation");
                demand(!expected || elevations[i] == *expected, "what is valid is read as it is");
            }
        }
        row += rows;
    }
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    static const bool started = [] {
        d2b::reading::start_gdal();
        CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
        return true;
    }();
    static_cast<void>(started);
    // How it is read comes first: cells take all that is left.
    constexpr std::size_t most_ways = 16;
    Bytes ways(data, std::min(size, most_ways));
    Bytes bytes(data + std::min(size, most_ways), size - std::min(size, most_ways));
    Case c = case_of(bytes);
    const d2b::ReadOptions options = options_of(ways, c);
    write(c);
    const auto source = d2b::open_dem(options);
    compare(*source, c, options, ways);
    VSIUnlink(path);
    return 0;
}
