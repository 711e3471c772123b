#include <filesystem>
#include <random>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "cli/read_cityjson.hpp"
#include "surface/label_contours.hpp"
#include "surface/surface_check.hpp"
#include "write/surface/cityjson_sink.hpp"

namespace d2b::surface {
namespace {

/// Solids of random grids, read again from the file that the sink wrote of them.
class RandomCityJson : public ::testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(path_); }
    [[nodiscard]] test::ReadCityJson written(const MadeSurfaces& made) const {
        SurfaceMeta meta;
        meta.frame.scale = {0.5, 0.25, 0.001};
        meta.lod = "1.2";
        meta.vertical_unit = "metre";
        const auto sink = writing::open_cityjson_sink(
            writing::resolve_file_target({path_, true, {}, writing::FileKind::surface}));
        sink->preflight(meta);
        sink->begin(meta);
        for (const SurfacePart& solid : made.solids)
            sink->add(solid);
        sink->end_group();
        sink->finish();
        return test::read_cityjson(path_);
    }
    /// Checks a point that read_cityjson() ignores: that nothing is missing.
    void expect_whole(const MadeSurfaces& made, const std::string& grid) const {
        const test::ReadCityJson city = written(made);
        ASSERT_EQ(city.solids.size(), made.solids.size()) << grid;
        ASSERT_TRUE(six_volumes(city.solids) == six_volumes(made.solids)) << grid;
        std::size_t faces = 0;
        std::size_t read = 0;
        for (std::size_t i = 0; i < made.solids.size(); ++i) {
            faces += made.solids[i].buildings[0].faces.size();
            read += city.solids[i].buildings[0].faces.size();
        }
        ASSERT_EQ(read, faces) << grid;
    }
    static std::string random_row(std::mt19937& random, const std::string& letters, unsigned cols) {
        std::string row;
        for (unsigned col = 0; col < cols; ++col)
            row += letters[random() % letters.size()];
        return row;
    }

    const std::string path_ = testing::TempDir() + "d2b_random_" + std::to_string(::getpid()) + ".city.json";
};

TEST_F(RandomCityJson, blocksAndStacks) {
    std::mt19937 random(4);
    for (unsigned run = 0; run < 200; ++run) {
        const bool stacks = run % 2 == 0;
        LetterGrid grid;
        std::string shown = "\n";
        const auto cols = static_cast<unsigned>(1 + random() % 9);
        for (unsigned row = 0; row < 1 + run % 9; ++row) {
            grid.rows.push_back(random_row(random, stacks ? "01123" : "ab  cd", cols));
            shown += grid.rows.back() + "|\n";
        }
        expect_whole(surfaces_of(stacks ? stacks_of(grid) : blocks_of(grid, {20, 35, 35, 60}, {0, 3, 0, 7})),
                     shown);
        if (HasFailure())
            FAIL() << shown;
    }
}

}  // namespace
}  // namespace d2b::surface
