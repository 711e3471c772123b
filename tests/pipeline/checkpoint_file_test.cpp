#include "pipeline/tiles/checkpoint_file.hpp"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "pipeline/tiles/file_cache.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace d2b::tiles {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytes_from(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

class CheckpointFileTest : public testing::Test {
  protected:
    CheckpointFileTest() {
        write_checkpoint(place_, bytes_from("the body"), bytes_from("and the tail"));
        whole_ = content();
    }
    [[nodiscard]] std::string content() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void put(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }
    /// "" where the file is taken.
    [[nodiscard]] static std::string refusal(const Checkpoint& wanted) {
        return test::error_of<InputError>([&] { const CheckpointFile file(wanted); });
    }

    test::TemporaryFolder folder_;
    fs::path path_ = folder_.path() / "7";
    Checkpoint place_{path_, TileStep::draw, 0x1234, 7};
    std::string whole_;
};

TEST_F(CheckpointFileTest, GiveBackWhatWasWritten) {
    EXPECT_TRUE(checkpoint_exists(place_));
    CheckpointFile file(place_);
    ByteReader body = file.body();
    EXPECT_EQ(body.take_bytes(8).size(), 8U);
    EXPECT_EQ(body.left(), 0U);
    EXPECT_EQ(file.payload(4, 8), bytes_from("the tail"));
    EXPECT_THROW((void)file.payload(5, 8), InputError);
    EXPECT_THROW((void)file.payload(13, 0), InputError);
    EXPECT_THROW((void)file.payload(~std::uint64_t{0}, 2), InputError);
}

TEST_F(CheckpointFileTest, StayOpenWhereTheyAreReadByTurns) {
    FileHandleCache recent;
    CheckpointFile file(place_, &recent);
    fs::remove(path_);
    EXPECT_EQ(file.payload(4, 8), bytes_from("the tail"));
    EXPECT_THROW((void)file.payload(5, 8), InputError);
}

TEST_F(CheckpointFileTest, AreRefusedWhereverTheyEnd) {
    for (std::size_t length = 0; length < whole_.size(); ++length) {
        put(whole_.substr(0, length));
        EXPECT_TRUE(refusal(place_).starts_with("'" + path_.string() + "' is damaged: ")) << length;
        EXPECT_FALSE(checkpoint_exists(place_)) << length;
    }
    put(whole_ + "x");
    EXPECT_NE(refusal(place_), "(no error)");
    EXPECT_FALSE(checkpoint_exists(place_));
}

/// Blocks in the tail have digests of their own.
TEST_F(CheckpointFileTest, AreRefusedWhicheverByteHasChanged) {
    const std::size_t payload = std::string("and the tail").size();
    for (std::size_t i = 0; i < whole_.size() - payload; ++i)
        for (const char change : {'\x01', '\x80', '\xff'}) {
            std::string changed = whole_;
            changed[i] = static_cast<char>(changed[i] ^ change);
            put(changed);
            EXPECT_NE(refusal(place_), "(no error)") << "byte " << i;
        }
}

TEST_F(CheckpointFileTest, AreOfOneStepTileAndPlan) {
    const std::string again = "; delete it and run 'draw' of tile 8 again.";
    EXPECT_EQ(refusal({path_, TileStep::draw, 0x1234, 8}),
              "'" + path_.string() + "' is not the file that 'draw' of tile 8 writes" + again);
    EXPECT_EQ(
        refusal({path_, TileStep::find, 0x1234, 7}),
        "'" + path_.string() +
            "' is not the file that 'find' of tile 7 writes; delete it and run 'find' of tile 7 again.");
    EXPECT_EQ(refusal({path_, TileStep::draw, 0x1235, 7}),
              "'" + path_.string() + "' belongs to another plan; delete it and run 'draw' of tile 7 again.");
}

}  // namespace
}  // namespace d2b::tiles
