#include <tuple>

#include "dem2buildings/error.hpp"
#include "write/png_sink.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

using Names = std::vector<std::string>;

class PictureTest : public WriteTest {
  protected:
    [[nodiscard]] RasterTarget png(const std::string& name, bool overwrite = false) const {
        return {path(name), overwrite, {}, RasterFormat::png};
    }
    [[nodiscard]] static Image two_pixels() { return {2, 1, {1, 2, 3, 250, 251, 252}}; }
};

TEST_F(PictureTest, IsThereWhenItIsPublishedAndNotBefore) {
    const auto file = open_picture(png("a.png"));
    EXPECT_EQ(entries(), Names{});
    file->write(two_pixels());
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
    file->publish();
    EXPECT_EQ(entries(), Names{"a.png"});
    const Dataset picture(GDALOpen(path("a.png").c_str(), GA_ReadOnly));
    ASSERT_TRUE(picture);
    std::array<unsigned char, 6> rgb{};
    ASSERT_EQ(GDALDatasetRasterIO(picture.get(), GF_Read, 0, 0, 2, 1, rgb.data(), 2, 1, GDT_Byte, 3, nullptr,
                                  3, 6, 1),
              CE_None);
    EXPECT_EQ(rgb, (std::array<unsigned char, 6>{1, 2, 3, 250, 251, 252}));
}

TEST_F(PictureTest, AnAbandonedOneLeavesNothing) {
    open_picture(png("a.png"))->write(two_pixels());
    EXPECT_EQ(entries(), Names{});
}

TEST_F(PictureTest, AnotherFileIsNotReplaced) {
    put("a.png", "text");
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = open_picture(png("a.png")); }).find("-overwrite"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = open_picture(png("a.png", true)); }).find("format PNG"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = open_picture(png("a.tif")); }).find(".png"),
              std::string::npos);
    EXPECT_EQ(bytes("a.png"), "text");
}

TEST_F(PictureTest, AnOldPictureIsReplaced) {
    for (int i = 0; i < 2; ++i) {
        const auto file = open_picture(png("a.png", true));
        file->write(i == 0 ? two_pixels() : Image{1, 1, {9, 9, 9}});
        file->publish();
    }
    const Dataset picture(GDALOpen(path("a.png").c_str(), GA_ReadOnly));
    EXPECT_EQ(GDALGetRasterXSize(picture.get()), 1);
    EXPECT_EQ(entries(), Names{"a.png"});
}

}  // namespace

}  // namespace d2b::test
