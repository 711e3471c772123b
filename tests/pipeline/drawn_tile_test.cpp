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
        write_checkpoint(place_, {}, drawn.bytes());
        return CheckpointFile(place_);
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
    Checkpoint place_{folder_.path() / "0", TileStep::draw, 5, 0};
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

features::DrawnContour with_roof() {
    features::DrawnContour drawn = contour(1, 5);
    drawn.building_record.roof_shape = {"gabled", 0.25, 12, 9, 0.1};
    drawn.building_record.whole = -8;
    features::DrawnFace& face = drawn.faces.emplace_back();
    face.record.slope = 30;
    face.record.cells = 12;
    face.record.kind = "pitched";
    WorldPolygon& part = face.parts.emplace_back();
    part.exterior = {{0, 0}, {4, 0}, {4, 4}};
    part.interiors = {{{1, 1}, {1, 2}, {2, 2}}};
    part.elevations = {1, 2, 3, 4, 5, 6};
    return drawn;
}

std::vector<std::byte> bytes_of(const features::DrawnContour& drawn) {
    ByteWriter writer;
    save(drawn, writer);
    return {writer.bytes().begin(), writer.bytes().end()};
}

TEST(DrawnContour, KeepsItsRoof) {
    ByteReader reader(bytes_of(with_roof()));
    const features::DrawnContour drawn = load_drawn_contour(reader);
    EXPECT_EQ(reader.left(), 0U);
    const RoofRecord& roof = drawn.building_record.roof_shape;
    EXPECT_EQ(roof.type, "gabled");
    EXPECT_EQ(roof.flat_share, 0.25);
    EXPECT_EQ(roof.ridge_z, 12);
    EXPECT_EQ(roof.eave_z, 9);
    EXPECT_EQ(roof.rmse_m, 0.1);
    EXPECT_EQ(drawn.building_record.whole, -8);
    ASSERT_EQ(drawn.faces.size(), 1U);
    EXPECT_EQ(drawn.faces[0].record.slope, 30);
    EXPECT_EQ(drawn.faces[0].record.cells, 12);
    EXPECT_EQ(drawn.faces[0].record.kind, "pitched");
    EXPECT_EQ(drawn.faces[0].parts.at(0).exterior, with_roof().faces[0].parts[0].exterior);
    EXPECT_EQ(drawn.faces[0].parts.at(0).interiors, with_roof().faces[0].parts[0].interiors);
    EXPECT_EQ(drawn.faces[0].parts.at(0).elevations, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    ByteReader without(bytes_of(contour(1, 5)));
    EXPECT_EQ(load_drawn_contour(without).building_record.roof_shape.type, "");
}

TEST(DrawnContour, RefusesARoofThatIsNone) {
    features::DrawnContour drawn = with_roof();
    drawn.faces[0].parts[0].elevations.pop_back();
    ByteReader few(bytes_of(drawn));
    EXPECT_THROW((void)load_drawn_contour(few), CorruptRecord);
    drawn = with_roof();
    drawn.faces[0].record.kind = "thatched";
    ByteReader unknown(bytes_of(drawn));
    EXPECT_THROW((void)load_drawn_contour(unknown), CorruptRecord);
    drawn = with_roof();
    drawn.building_record.roof_shape.type = "thatched";
    ByteReader untyped(bytes_of(drawn));
    EXPECT_EQ(load_drawn_contour(untyped).building_record.roof_shape.type, "");
}

TEST(BuildingCells, HaveAnElevationEach) {
    contours::BuildingCells cells{{{3, 4, 6}, {4, 4, 5}}, {1, 2, 3}};
    const auto loaded = [&] {
        ByteWriter writer;
        save(cells, writer);
        ByteReader reader({writer.bytes().begin(), writer.bytes().end()});
        return load_building_cells(reader);
    };
    EXPECT_EQ(loaded().elevations, cells.elevations);
    EXPECT_EQ(loaded().runs.at(1).row, 4);
    cells.elevations.pop_back();
    EXPECT_THROW((void)loaded(), CorruptRecord);
    cells = {{{3, 6, 4}}, {}};
    EXPECT_THROW((void)loaded(), CorruptRecord);
}

}  // namespace
}  // namespace d2b::tiles
