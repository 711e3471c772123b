#pragma once

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "cli/cli_test_case.hpp"

namespace d2b::test {

/// A town of blocks, and a small raster whose result is there before.
class FaultyTest : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "";
        write(path("dem.tif"), town(300));
        write(path("small.tif"), town(60));
    }
    /// Blocks of 14 x 17 cells in a raster of so many cells a side.
    static RasterSpec town(int side) {
        RasterSpec spec = blocks();
        spec.rows = spec.cols = side;
        spec.values.clear();
        for (int row = 0; row < side; ++row)
            for (int col = 0; col < side; ++col)
                spec.values.push_back(row % 30 < 14 && col % 30 < 17 ? 12 + (row * 7 + col * 3) % 5 * 0.1
                                                                     : 0);
        return spec;
    }
    /// The environment in which calls on files fail.
    /// @param fault kind, number of the call (0: none fails) and error, as shim.cpp reads them
    /// @param files part of the names of these files
    /// @param counter the file that takes the number of calls
    static std::vector<std::string> failing(const std::string& fault, const std::string& files,
                                            const std::string& counter) {
        return {"LD_PRELOAD=" D2B_SHIM, "D2B_FAULT=" + fault, "D2B_FAULT_PATH=" + files,
                "D2B_FAULT_COUNT=" + counter};
    }
    /// One call in so many is let fail; all where D2B_FAULT_STEP is 1.
    static long calls_apart(long usual) {
        const char* wanted = std::getenv("D2B_FAULT_STEP");
        return std::max(1L, wanted == nullptr ? usual : std::atol(wanted));
    }
    /// Features of all layers; -1 where there is no such file.
    [[nodiscard]] int features(const std::string& name) const {
        if (!std::filesystem::exists(path(name)))
            return -1;
        // Where a disk fails while a transaction is taken back, SQLite does so when the file is next opened
        // for writing.
        GDALClose(GDALOpenEx(path(name).c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr));
        const OpenDataset dataset = open_vector(path(name));
        int sum = 0;
        for (int i = 0; dataset && i < GDALDatasetGetLayerCount(dataset.get()); ++i)
            sum += static_cast<int>(OGR_L_GetFeatureCount(GDALDatasetGetLayer(dataset.get(), i), TRUE));
        return sum;
    }
    /// Names of files and folders, but for the journal that SQLite keeps beside a file of its own where the
    /// disk does not let it end: that file brings the old content back.
    [[nodiscard]] std::set<std::string> names() const {
        std::set<std::string> all;
        for (const std::string& name : entries())
            if (!name.ends_with("-journal"))
                all.insert(name);
        return all;
    }
};

}  // namespace d2b::test
