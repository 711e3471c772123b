// The generator writes the committed samples.
#include <cstring>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "sample_files.hpp"
#include "samples.hpp"
#include "support/error_of.hpp"
#include "write_truth.hpp"

namespace d2b::test {
namespace {

/// A folder for one test, removed at its end.
class Regenerate : public testing::Test {
  protected:
    Regenerate() {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    ~Regenerate() override { std::filesystem::remove_all(folder_); }

    const std::string folder_ =
        testing::TempDir() + "d2b_samples_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

/// Bits, so that NaN equals NaN.
std::size_t different(const std::vector<float>& a, const std::vector<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0 ? 1U : 0U;
    return count;
}

TEST_F(Regenerate, RastersAreTheCommittedOnes) {
    sample::make_samples(folder_);
    for (const char* name :
         {"thesis_11x7", "thesis_50x36", "hotel_70x85", "courtyard_utm", "town", "degrees", "nodata"}) {
        SCOPED_TRACE(name);
        const Raster committed = read_raster(D2B_SAMPLES, name);
        const Raster made = read_raster(folder_, name);
        ASSERT_EQ(made.cols, committed.cols);
        ASSERT_EQ(made.rows, committed.rows);
        EXPECT_EQ(made.transform, committed.transform);
        EXPECT_EQ(made.crs, committed.crs);
        EXPECT_EQ(made.unit, committed.unit);
        EXPECT_EQ(made.has_nodata, committed.has_nodata);
        EXPECT_EQ(made.nodata, committed.nodata);
        EXPECT_EQ(different(made.z, committed.z), 0U);
    }
}

TEST_F(Regenerate, TruthIsTheCommittedOne) {
    sample::make_samples(folder_);
    for (const char* file :
         {"samples_truth.gpkg", "town_truth.gpkg", "town_roofs.gpkg", "town_parcels.gpkg"}) {
        const auto committed = read_truth(D2B_SAMPLES, file);
        const auto made = read_truth(folder_, file);
        ASSERT_EQ(made.size(), committed.size());
        for (std::size_t i = 0; i < made.size(); ++i) {
            SCOPED_TRACE(committed[i].name);
            EXPECT_EQ(made[i].name, committed[i].name);
            EXPECT_EQ(made[i].crs, committed[i].crs);
            ASSERT_EQ(made[i].footprints.size(), committed[i].footprints.size());
            // Another GEOS may dissolve into another order; truth_test checks that layer against the
            // buildings.
            for (std::size_t k = 0; k < made[i].footprints.size() && made[i].name != "blocks_dissolved";
                 ++k) {
                EXPECT_EQ(made[i].footprints[k].fields, committed[i].footprints[k].fields);
                EXPECT_EQ(made[i].footprints[k].wkb, committed[i].footprints[k].wkb);
            }
        }
    }
}

TEST_F(Regenerate, TwiceGivesTheSameBytes) {
    const std::string again = folder_ + "/again";
    std::filesystem::create_directories(again);
    sample::make_samples(folder_);
    sample::make_samples(again);
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(again)) {
        const auto read = [](const std::string& path) {
            VSIStatBufL status;
            EXPECT_EQ(VSIStatL(path.c_str(), &status), 0);
            std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
            VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
            EXPECT_EQ(VSIFReadL(bytes.data(), 1, bytes.size(), file), bytes.size());
            VSIFCloseL(file);
            return bytes;
        };
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(read(folder_ + "/" + name) == read(entry.path().string())) << name;
        ++files;
    }
    EXPECT_EQ(files, 11);
}

TEST_F(Regenerate, MissingFolderIsAnError) {
    const std::string missing = folder_ + "/missing";
    EXPECT_TRUE(
        error_of<OutputError>([&] { sample::make_samples(missing); }).starts_with("Cannot write " + missing));
    const std::string message = error_of<OutputError>([&] { sample::TruthWriter(missing + "/truth.gpkg"); });
    EXPECT_TRUE(message.starts_with("Cannot write " + missing + "/truth.gpkg: ")) << message;
    EXPECT_TRUE(message.ends_with("; check that the folder exists, can be written and has space."))
        << message;
}

TEST_F(Regenerate, UnknownCrsIsAnError) {
    GDALAllRegister();
    sample::Sample bad = sample::drawn_grid();
    bad.raster.crs = "EPSG:1";
    const std::string path = folder_ + "/bad.tif";
    const std::string expected =
        "Cannot write " + path + ": there is no CRS EPSG:1; give one that PROJ knows.";
    EXPECT_EQ(error_of<OutputError>([&] { sample::write_raster(path, bad.raster, bad.scene); }), expected);
}

}  // namespace
}  // namespace d2b::test
