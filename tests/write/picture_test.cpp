#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/error.hpp"
#include "write/raster/picture_file.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

class PictureTest : public WriteTest {
  protected:
    [[nodiscard]] FileTarget picture(const std::string& name, bool overwrite = false) const {
        return {path(name), overwrite, {}, FileKind::picture};
    }
};

void publish(PictureFile& file) {
    CommitList commit;
    file.prepare(commit);
    commit.publish();
}

TEST_F(PictureTest, IsThereWhenItIsPublishedAndNotBefore) {
    const auto file = open_picture(picture("a.png"));
    EXPECT_EQ(entries(), Names{});
    file->write("bytes");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
    publish(*file);
    EXPECT_EQ(entries(), Names{"a.png"});
    EXPECT_EQ(bytes("a.png"), "bytes");
}

TEST_F(PictureTest, ItsNameSaysItsFormat) {
    EXPECT_EQ(open_picture(picture("a.PNG"))->format(), PictureFormat::png);
    EXPECT_EQ(open_picture(picture("a.svg"))->format(), PictureFormat::svg);
    EXPECT_EQ(open_picture(picture("a.b.pdf"))->format(), PictureFormat::pdf);
    EXPECT_EQ(thrown<OptionError>([&] { std::ignore = open_picture(picture("a.jpg")); }),
              "Pictures are written as PNG, SVG or PDF; give \"" + path("a.jpg") +
                  "\" a name that ends in .png, .svg or .pdf.");
}

TEST_F(PictureTest, AnAbandonedOneLeavesNothing) {
    open_picture(picture("a.png"))->write("bytes");
    EXPECT_EQ(entries(), Names{});
}

TEST_F(PictureTest, AFullDiskLeavesNothingAndSaysWhy) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit room{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &room);
        std::string message;
        try {
            open_picture(picture("a.svg"))->write(std::string(100'000, ' '));
        } catch (const OutputError& error) {
            message = error.what();
        }
        ::_exit(message == "Cannot write \"" + path("a.svg") + "\": File too large." ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_EQ(entries(), Names{});
}

TEST_F(PictureTest, AnotherFileIsNotReplaced) {
    put("a.png", "text");
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = open_picture(picture("a.png")); }).find("-overwrite"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] {
                  std::ignore = open_picture(picture("a.png", true));
              }).find("is not a PNG, SVG or PDF"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = open_picture(picture("a.tif")); }).find(".png"),
              std::string::npos);
    EXPECT_EQ(bytes("a.png"), "text");
}

TEST_F(PictureTest, AnOldPictureIsReplaced) {
    for (int i = 0; i < 2; ++i) {
        const auto file = open_picture(picture("a.png", true));
        file->write(i == 0 ? "%PDF-1.5 old" : "<svg>new</svg>");
        publish(*file);
    }
    EXPECT_EQ(bytes("a.png"), "<svg>new</svg>");
    EXPECT_EQ(entries(), Names{"a.png"});
}

}  // namespace

}  // namespace d2b::test
