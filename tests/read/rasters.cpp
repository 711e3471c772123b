#include "read/rasters.hpp"

#include <cmath>
#include <numeric>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ogr_srs_api.h>

#include "dem2buildings/open_sources.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::test {

std::string wkt_of(int epsg) {
    const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(crs, epsg);
    char* text = nullptr;
    OSRExportToWkt(crs, &text);
    std::string result = text;
    VSIFree(text);
    OSRRelease(crs);
    return result;
}

DemInfo metre_grid() {
    DemInfo info;
    info.name = "dem.tif";
    info.rows = info.cols = 20;
    info.window = {0, 0, 20, 20};
    info.transform = {500000, 1, 0, 5700020, 0, -1};
    info.crs_wkt = wkt_of(25832);
    return info;
}

std::vector<double> counting(int count, double first) {
    std::vector<double> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
}

namespace {

void fill(GDALDatasetH dataset, const RasterSpec& spec) {
    std::vector<double> values = spec.values;
    for (int band = 1; band <= spec.bands; ++band) {
        const GDALRasterBandH handle = GDALGetRasterBand(dataset, band);
        if (spec.nodata) {
            ASSERT_EQ(GDALSetRasterNoDataValue(handle, *spec.nodata), CE_None);
        }
        if (!values.empty()) {
            ASSERT_EQ(GDALRasterIO(handle, GF_Write, 0, 0, spec.cols, spec.rows, values.data(), spec.cols,
                                   spec.rows, GDT_Float64, 0, 0),
                      CE_None);
        }
    }
}

}  // namespace

GDALDatasetH create(const std::string& path, const RasterSpec& spec) {
    CPLStringList creation;
    for (const std::string& option : spec.creation)
        creation.AddString(option.c_str());
    const GDALDatasetH dataset = GDALCreate(GDALGetDriverByName(spec.driver.c_str()), path.c_str(), spec.cols,
                                            spec.rows, spec.bands, spec.type, creation.List());
    EXPECT_NE(dataset, nullptr) << path;
    if (spec.transform) {
        std::array<double, 6> transform = *spec.transform;
        GDALSetGeoTransform(dataset, transform.data());
    }
    if (!spec.crs.empty()) {
        const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
        EXPECT_EQ(OSRSetFromUserInput(crs, spec.crs.c_str()), OGRERR_NONE);
        GDALSetSpatialRef(dataset, crs);
        OSRDestroySpatialReference(crs);
    }
    fill(dataset, spec);
    return dataset;
}

void write(const std::string& path, const RasterSpec& spec) {
    GDALClose(create(path, spec));
}

void write_text(const std::string& path, const std::string& text) {
    VSILFILE* file = VSIFOpenL(path.c_str(), "wb");
    ASSERT_NE(file, nullptr) << path;
    ASSERT_EQ(VSIFWriteL(text.data(), 1, text.size(), file), text.size());
    ASSERT_EQ(VSIFCloseL(file), 0);
}

std::string read_bytes(const std::string& path) {
    std::string bytes;
    VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
    EXPECT_NE(file, nullptr) << path;
    std::array<char, 4096> buffer{};
    while (const std::size_t got = VSIFReadL(buffer.data(), 1, buffer.size(), file))
        bytes.append(buffer.data(), got);
    VSIFCloseL(file);
    return bytes;
}

std::vector<double> read_all(DemSource& source) {
    const Window& w = source.info().window;
    std::vector<double> elevations(static_cast<std::size_t>(w.rows) * static_cast<std::size_t>(w.cols));
    source.read(w, elevations);
    return elevations;
}

Window whole_rows(const DemSource& source, std::int32_t first, std::int32_t rows) {
    return {first, source.info().window.col, rows, source.info().window.cols};
}

void ReadTest::SetUpTestSuite() {
    reading::start_gdal();
}

void ReadTest::SetUp() {
    callbacks_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::string("/vsimem/") + test->test_suite_name() + "_" + test->name() + "/";
    for (char& c : folder_)
        if (c == ' ')
            c = '_';
    VSIMkdirRecursive(folder_.c_str(), 0755);
}

void ReadTest::TearDown() {
    VSIRmdirRecursive(folder_.c_str());
}

std::string ReadTest::quoted(const std::string& name) const {
    const std::string full = path(name);
    return "'" + full + "'";
}

std::unique_ptr<DemSource> ReadTest::open(const std::string& name) {
    if (!name.empty())
        options_.source = path(name);
    return open_dem(options_, callbacks_);
}

std::vector<double> ReadTest::values(const std::string& name) {
    return all_of(*open(name));
}

std::vector<double> ReadTest::all_of(DemSource& source) {
    std::vector<double> elevations = read_all(source);
    for (std::string& text : source.take_warnings())
        warnings_.push_back(std::move(text));
    return elevations;
}

}  // namespace d2b::test

void expect_values(const std::vector<double>& got, const std::vector<double>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
        if (std::isnan(expected[i]))
            EXPECT_TRUE(std::isnan(got[i])) << "value " << i << " is " << got[i];
        else
            EXPECT_EQ(got[i], expected[i]) << "value " << i;
    }
}

void expect_has(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}
