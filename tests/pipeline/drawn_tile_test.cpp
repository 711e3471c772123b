#include "pipeline/tiles/drawn_tile.hpp"

#include <gtest/gtest.h>

#include "pipeline/tiles/file_cache.hpp"
#include "support/temporary_folder.hpp"

namespace d2b::tiles {
namespace {

namespace fs = std::filesystem;

features::DrawnContour contour(std::int32_t level, std::int32_t row, std::size_t vertices = 4) {
    features::DrawnContour drawn;
    drawn.key = {level, {row, 7}};
    drawn.record.level = level;
    drawn.contour.emplace().parts.emplace_back().exterior.resize(vertices);
    return drawn;
}

class DrawnStreamTest : public testing::Test {
  protected:
    [[nodiscard]] CheckpointFile write(const DrawnBlocks& drawn) const {
        write_checkpoint(folder_.path() / "0", seal_, {}, drawn.bytes());
        return {folder_.path() / "0", seal_};
    }
    static std::string error_of(DrawnStream& stream) {
        try {
            while (stream.key())
                (void)stream.take();
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    }

    test::TemporaryFolder folder_;
    CheckpointId seal_{TileStep::draw, 5, 0};
};

TEST_F(DrawnStreamTest, BlocksAreOfOneLevelAndOfBoundedSize) {
    DrawnBlocks drawn;
    constexpr std::int32_t large = 5000;  // vertices, of 16 bytes each
    for (const auto& [level, row] : {std::pair{1, 2}, {1, 3}, {1, 4}, {2, 2}, {4, 1}})
        drawn.add(contour(level, row, large));
    drawn.finish();
    drawn.finish();  // adds nothing

    // Two of them are more than the 128 KiB that end a block.
    std::vector<contours::ContourKey> first;
    std::uint64_t bytes = 0;
    for (const DrawnBlock& block : drawn.blocks()) {
        first.push_back(block.first);
        bytes += block.bytes.size;
    }
    EXPECT_EQ(first, (std::vector<contours::ContourKey>{{1, {2, 7}}, {1, {4, 7}}, {2, {2, 7}}, {4, {1, 7}}}));
    EXPECT_EQ(bytes, drawn.bytes().size());
}

TEST_F(DrawnStreamTest, GivesBackWhatWasDrawnInOrder) {
    DrawnBlocks drawn;
    for (std::int32_t level = 1; level < 4; ++level)
        for (std::int32_t row = 0; row < 1000; ++row)
            drawn.add(contour(level, row));
    drawn.finish();
    DrawnStream stream(write(drawn), drawn.blocks());
    std::int32_t count = 0;
    for (; const auto key = stream.key(); ++count) {
        EXPECT_EQ(*key, (contours::ContourKey{1 + count / 1000, {count % 1000, 7}}));
        EXPECT_EQ(stream.key(), key);
        EXPECT_EQ(stream.take().key, *key);
    }
    EXPECT_EQ(count, 3000);
}

TEST_F(DrawnStreamTest, ReadsNoBlockForItsKey) {
    DrawnBlocks drawn;
    drawn.add(contour(1, 5));
    drawn.finish();
    DrawnStream stream(write(drawn), drawn.blocks());
    fs::remove(folder_.path() / "0");
    EXPECT_EQ(stream.key(), (contours::ContourKey{1, {5, 7}}));
    EXPECT_EQ(error_of(stream),
              "'" + (folder_.path() / "0").string() +
                  "' is damaged: it cannot be read any more; delete it and run 'draw' of tile 0 "
                  "again.");
}

TEST_F(DrawnStreamTest, RefusesWhatIsNotAsAnnounced) {
    DrawnBlocks drawn;
    drawn.add(contour(1, 5));
    drawn.add(contour(2, 5));
    drawn.finish();
    std::vector<DrawnBlock> blocks = drawn.blocks();
    ASSERT_EQ(blocks.size(), 2U);
    blocks[1].first.first.row = 4;
    DrawnStream stream(write(drawn), blocks);
    EXPECT_NE(error_of(stream).find("damaged: a block begins with another contour than is announced; delete"),
              std::string::npos);
}

TEST_F(DrawnStreamTest, RefusesWhatIsNotInOrder) {
    DrawnBlocks drawn;
    drawn.add(contour(1, 5));
    drawn.add(contour(1, 5));
    drawn.finish();
    DrawnStream stream(write(drawn), drawn.blocks());
    EXPECT_NE(error_of(stream).find("damaged: its contours are not in order; delete"), std::string::npos);
}

TEST_F(DrawnStreamTest, RefusesBytesOfNoContour) {
    DrawnBlocks drawn;
    drawn.add(contour(1, 5));
    drawn.finish();
    std::vector<DrawnBlock> blocks = drawn.blocks();
    blocks[0].bytes.size -= 1;
    blocks[0].bytes.digest = digest_of(drawn.bytes().first(drawn.bytes().size() - 1));
    DrawnStream stream(write(drawn), blocks);
    EXPECT_NE(error_of(stream).find("damaged: it is truncated; delete"), std::string::npos);
}

}  // namespace
}  // namespace d2b::tiles
