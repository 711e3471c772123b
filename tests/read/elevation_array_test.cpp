#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"

namespace d2b::test {
namespace {

constexpr double invalid = std::numeric_limits<double>::quiet_NaN();

/// Elevations in memory.
class ReadArray : public testing::Test {
  protected:
    void SetUp() override {
        options_.crs = "EPSG:32632";
        callbacks_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
    }
    /// 3 rows and 4 columns, 10 * row + column, one after another.
    template <typename Value>
    ElevationArray array_of(std::vector<Value>& values, ValueType type) {
        for (int row = 0; row < 3; ++row)
            for (int col = 0; col < 4; ++col)
                values.push_back(static_cast<Value>(10 * row + col));
        ElevationArray array;
        array.name = "array";
        array.rows = 3;
        array.cols = 4;
        array.type = type;
        array.values = {values.data(), 4 * sizeof(Value), sizeof(Value)};
        array.transform = {{500000, 1, 0, 5538690, 0, -1}};
        return array;
    }
    /// All elevations of the window; 99 for NaN.
    std::vector<double> values(const ElevationArray& array) {
        const auto source = open_dem(array, options_, callbacks_);
        const Window window = source->info().window;
        std::vector<double> read(static_cast<std::size_t>(window.rows) *
                                 static_cast<std::size_t>(window.cols));
        source->read(window, read);
        for (double& value : read)
            value = std::isnan(value) ? 99 : value;
        return read;
    }
    template <typename Value>
    void expect_all(ValueType type) {
        std::vector<Value> cells;
        const ElevationArray array = array_of(cells, type);
        EXPECT_EQ(values(array), (std::vector<double>{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23}));
    }

    ReadOptions options_;
    std::vector<std::string> warnings_;
    Callbacks callbacks_;
};

TEST_F(ReadArray, valuesOfEveryType) {
    expect_all<std::int8_t>(ValueType::int8);
    expect_all<std::uint8_t>(ValueType::uint8);
    expect_all<std::int16_t>(ValueType::int16);
    expect_all<std::uint16_t>(ValueType::uint16);
    expect_all<std::int32_t>(ValueType::int32);
    expect_all<std::uint32_t>(ValueType::uint32);
    expect_all<std::int64_t>(ValueType::int64);
    expect_all<std::uint64_t>(ValueType::uint64);
    expect_all<float>(ValueType::float32);
    expect_all<double>(ValueType::float64);
}

TEST_F(ReadArray, stepsOfAnySizeAndSign) {
    std::vector<double> cells;
    ElevationArray array = array_of(cells, ValueType::float64);
    std::swap(array.rows, array.cols);
    std::swap(array.values.row_step, array.values.col_step);
    EXPECT_EQ(values(array), (std::vector<double>{0, 10, 20, 1, 11, 21, 2, 12, 22, 3, 13, 23}));
    array = array_of(cells, ValueType::float64);
    array.rows = 2;
    array.cols = 2;
    array.values = {&cells[11], -2 * 4 * 8, -3 * 8};
    EXPECT_EQ(values(array), (std::vector<double>{23, 20, 3, 0}));
}

TEST_F(ReadArray, whatIsNotValid) {
    std::vector<float> cells;
    ElevationArray array = array_of(cells, ValueType::float32);
    std::array<std::uint8_t, 12> mask{};
    mask[1] = 1;
    array.masked = {mask.data(), 4, 1};
    cells[2] = std::numeric_limits<float>::infinity();
    cells[3] = static_cast<float>(invalid);
    cells[4] = -9999.9F;  // which is no -9999.9 as a double
    options_.nodata = -9999.9;
    EXPECT_EQ(values(array), (std::vector<double>{0, 99, 99, 99, 99, 11, 12, 13, 20, 21, 22, 23}));
}

TEST_F(ReadArray, aWindow) {
    std::vector<std::int16_t> cells;
    const ElevationArray array = array_of(cells, ValueType::int16);
    options_.source_window = {{1, 1, 2, 2}};
    EXPECT_EQ(values(array), (std::vector<double>{11, 12, 21, 22}));
    options_.source_window = {};
    options_.extent = {{500002, 5538689, 500004, 5538690}};
    EXPECT_EQ(values(array), (std::vector<double>{2, 3}));
}

TEST_F(ReadArray, whatIsKnownOfIt) {
    std::vector<std::uint8_t> cells;
    ElevationArray array = array_of(cells, ValueType::uint8);
    const DemInfo info = open_dem(array, options_, callbacks_)->info();
    EXPECT_TRUE(info.bytes);
    EXPECT_TRUE(info.georeferenced);
    EXPECT_EQ(info.transform, *array.transform);
    EXPECT_NE(info.crs_wkt.find("32632"), std::string::npos);
    EXPECT_TRUE(warnings_.empty());
    array.transform = {};
    options_.crs = "";
    EXPECT_EQ(open_dem(array, options_, callbacks_)->info().transform, DemInfo{}.transform);
    EXPECT_EQ(warnings_, (std::vector<std::string>{
                             "'array' has no georeferencing; coordinates are columns and, upwards, rows.",
                             "'array' has no coordinate reference system; lengths are taken as plain units; "
                             "give it with -a_srs."}));
}

TEST_F(ReadArray, refusals) {
    std::vector<double> cells;
    const ElevationArray array = array_of(cells, ValueType::float64);
    ElevationArray empty = array;
    empty.cols = 0;
    EXPECT_THROW(static_cast<void>(open_dem(empty, options_, callbacks_)), InputError);
    ElevationArray flat = array;
    flat.transform = {{0, 1, 1, 0, 1, 1}};
    EXPECT_THROW(static_cast<void>(open_dem(flat, options_, callbacks_)), InputError);
    std::array<ReadOptions, 3> of_files;
    of_files[0].band = 2;
    of_files[1].open_options = {"A=B"};
    of_files[2].drivers = {"GTiff"};
    for (const ReadOptions& options : of_files)
        EXPECT_THROW(static_cast<void>(open_dem(array, options, callbacks_)), OptionError);
}

}  // namespace
}  // namespace d2b::test
