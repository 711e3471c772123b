#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"

namespace d2b::test {

using Dataset = reading::DatasetOwner;
using Names = std::vector<std::string>;

inline const std::string quote = "\"";

/// A folder of its own for every test, and helpers that write and read without the code under test.
class WriteTest : public ::testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// Names in the test's folder, hidden ones too, sorted.
    [[nodiscard]] std::vector<std::string> entries(const std::string& folder = "") const;
    [[nodiscard]] WriteOptions to(const std::string& name, const std::string& format = "") const;
    void put(const std::string& name, const std::string& text) const;
    [[nodiscard]] std::string bytes(const std::string& name) const;

    /// Opens, writes `count` buildings (and as many contours where both are asked for) numbered from
    /// first_id(), finishes. @return first_id()
    std::int64_t write(const WriteOptions& options, int count);
    /// Message of the exception of this type that the call throws; fails the test where there is none.
    template <typename Exception>
    static std::string thrown(const std::function<void()>& call) {
        try {
            call();
        } catch (const Exception& error) {
            return error.what();
        } catch (const std::exception& error) {
            ADD_FAILURE() << "another exception: " << error.what();
            return "";
        }
        ADD_FAILURE() << "no exception";
        return "";
    }

    /// Name that a sink for the destination would give to the layer of buildings.
    [[nodiscard]] static std::string buildings_layer(const WriteOptions& options);

    std::filesystem::path folder_;
    Callbacks callbacks_;
    std::vector<std::string> warnings_;
};

[[nodiscard]] std::string wkt_of(int epsg);
/// @param crs e.g. "EPSG:25832+7837", with heights
[[nodiscard]] std::string wkt_of(const std::string& crs);
[[nodiscard]] LayerSpec layer_spec(const std::string& name, bool with_z = false);
/// A unit square with its lower left corner at (id, 0); `height` is NULL for even numbers.
[[nodiscard]] Feature square(std::int64_t id);
/// The layers that a destination gets.
[[nodiscard]] Layers layers_for(const WriteOptions& options);
[[nodiscard]] Provenance provenance();

[[nodiscard]] Dataset open_dataset(const std::string& path, bool update = false);
/// Sorted, without QGIS's table of styles, which OGR lists, too.
[[nodiscard]] std::vector<std::string> layer_names(GDALDatasetH dataset);
/// -1 where there is no such layer.
[[nodiscard]] std::int64_t count(const std::string& path, const std::string& layer);
/// All values of the integer field `id`, sorted: FlatGeobuf orders its features by place.
[[nodiscard]] std::vector<std::int64_t> ids(const std::string& path, const std::string& layer);
/// The first value of the first row; "" where there is none.
std::string sql(const std::string& path, const std::string& statement, bool update = false);
/// A layer of n points with a text field, as a user's own.
void add_user_layer(const std::string& path, const std::string& layer, int n, const char* format);

}  // namespace d2b::test
