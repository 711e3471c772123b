#include "write/staging.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>

#include <gtest/gtest.h>

#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/spool.hpp"
#include "support/error_of.hpp"
#include "support/spool_checks.hpp"
#include "support/temporary_folder.hpp"
#include "write/file_writer.hpp"
#include "write/vector/layer_writer.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

namespace fs = std::filesystem;

class StagingTest : public WriteTest {
  protected:
    static void put_in(const writing::StagingFolder& staging, const std::string& name,
                       const std::string& text) {
        std::ofstream(staging.folder() / name) << text;
    }
};

TEST_F(StagingTest, TheFolderIsHiddenAndGoes) {
    {
        const writing::StagingFolder staging("name", path("a.txt"));
        ASSERT_EQ(entries().size(), 1u);
        EXPECT_EQ(entries().front().find(".dem2buildings."), 0u);
        put_in(staging, "a.txt", "new");
    }
    EXPECT_TRUE(entries().empty());
}

TEST_F(StagingTest, ASetOfFilesComesAsAWhole) {
    put("a.txt", "old");
    put("a.idx", "old index");
    put("a.more", "old sidecar");
    {
        writing::StagingFolder staging("name", path("a.txt"));
        put_in(staging, "a.txt", "new");
        put_in(staging, "a.idx", "new index");
        staging.seal();
        put_in(staging, "a.cache", "of a reader");
        staging.sync();
        staging.publish({path("a.txt"), path("a.idx"), path("a.more")});
        EXPECT_EQ(staging.confirm(), "");
    }
    EXPECT_EQ(entries(), (Names{"a.idx", "a.txt"}));
    EXPECT_EQ(bytes("a.txt"), "new");
    EXPECT_EQ(bytes("a.idx"), "new index");
}

TEST_F(StagingTest, ASetOfFilesGoesBackAsAWhole) {
    put("a.txt", "old");
    put("a.idx", "old index");
    put("a.tab", "another's");
    {
        writing::StagingFolder staging("name", path("a.txt"));
        for (const char* name : {"a.txt", "a.idx", "a.tab"})
            put_in(staging, name, "new");
        staging.seal();
        EXPECT_EQ(thrown<OutputError>([&] {
                      staging.publish({path("a.txt"), path("a.idx")});
                  }),
                  "Cannot write \"name\": the finished result cannot be renamed (File exists).");
    }
    EXPECT_EQ(entries(), (Names{"a.idx", "a.tab", "a.txt"}));
    EXPECT_EQ(bytes("a.txt"), "old");
    EXPECT_EQ(bytes("a.idx"), "old index");
    EXPECT_EQ(bytes("a.tab"), "another's");
}

TEST_F(StagingTest, WhatIsMissingIsSaid) {
    writing::StagingFolder staging("name", path("a.txt"));
    EXPECT_EQ(thrown<OutputError>([&] { staging.seal(); }),
              "Cannot write \"name\": the driver did not write a file of this name.");
    EXPECT_EQ(thrown<OutputError>([&] { staging.copy_in({path("gone.txt")}); }),
              "Cannot write \"name\": it cannot be copied (No such file or directory).");
    fs::remove_all(staging.folder());
    EXPECT_EQ(thrown<OutputError>([&] { staging.sync(); }),
              "Cannot write \"name\": No such file or directory.");
}

TEST_F(StagingTest, AResultThatShowsCanBeTakenBack) {
    put("a.txt", "old");
    put("a.more", "old sidecar");
    for (const bool keeps : {false, true}) {
        {
            writing::StagingFolder staging("name", path("a.txt"));
            put_in(staging, "a.txt", "new");
            put_in(staging, "a.idx", "new index");
            staging.seal();
            staging.publish({path("a.txt"), path("a.more")});
            EXPECT_EQ(bytes("a.txt"), "new");
            EXPECT_FALSE(fs::exists(path("a.more")));
            if (!keeps) {
                EXPECT_EQ(staging.roll_back(), "");
                EXPECT_EQ(bytes("a.txt"), "old");
            }
        }
        EXPECT_EQ(entries(), keeps ? (Names{"a.idx", "a.txt"}) : (Names{"a.more", "a.txt"}));
    }
}

TEST_F(StagingTest, AFolderThatShowsCanBeTakenBack) {
    fs::create_directory(path("a"));
    {
        writing::StagingFolder staging("name", path("a"));
        fs::create_directory(staging.dataset());
        put_in(staging, "a/new", "1");
        staging.seal();
        staging.publish({});
        EXPECT_EQ(entries("a"), Names{"new"});
        EXPECT_EQ(staging.roll_back(), "");
        EXPECT_EQ(entries("a"), Names{});
        put("a/mine", "somebody else's");
        EXPECT_EQ(thrown<OutputError>([&] { staging.publish({}); }),
                  "Cannot write \"name\": the finished result cannot be renamed (File exists).");
    }
    EXPECT_EQ(entries(), Names{"a"});
    EXPECT_EQ(entries("a"), Names{"mine"});
}

TEST_F(StagingTest, WhatCannotBeTakenBackIsSaidAndKept) {
    put("a.txt", "old");
    std::string folder;
    {
        writing::StagingFolder staging("name", path("a.txt"));
        put_in(staging, "a.txt", "new");
        staging.seal();
        staging.publish({path("a.txt")});
        fs::remove(path("a.txt"));
        folder = staging.folder().string();
        EXPECT_EQ(staging.roll_back(), "old files of \"name\" lie in \"" + folder + "\" now");
    }
    EXPECT_EQ(bytes(fs::path(folder).filename().string() + "/a.txt"), "old");
    fs::remove_all(folder);
    {
        writing::StagingFolder staging("name", path("b.txt"));
        put_in(staging, "b.txt", "new");
        staging.seal();
        staging.publish({});
        fs::remove_all(staging.folder());
        EXPECT_EQ(staging.roll_back(), "\"name\" already exists");
    }
    EXPECT_EQ(entries(), Names{"b.txt"});
}

TEST_F(StagingTest, PlacesAreExchanged) {
    fs::create_directory(path("a"));
    fs::create_directory(path("b"));
    put("a/one", "1");
    put("b/two", "2");
    {
        writing::RenameTransaction moves;
        moves.replace(path("a"), path("b"), path("spare"));
        EXPECT_EQ(entries("a"), Names{"two"});
        EXPECT_EQ(entries("b"), Names{"one"});
        EXPECT_EQ(entries(), (Names{"a", "b"}));
        EXPECT_THROW(moves.replace(path("gone"), path("b"), path("spare")), std::system_error);
        EXPECT_EQ(entries("b"), Names{"one"});
    }
    EXPECT_EQ(entries("b"), Names{"two"});
}

TEST_F(StagingTest, MissingFeaturesAreNoticed) {
    write(to("a.gpkg"), 3);
    const writing::WriteTarget target{.name = "name", .hidden_folder = ""};
    const writing::VectorFormat format = writing::format_for(to("a.gpkg"));
    EXPECT_NO_THROW(
        writing::verify_counts(target, format, path("a.gpkg"), {{"buildings", 3}, {"contours", 3}}));
    EXPECT_EQ(thrown<OutputError>([&] {
                  writing::verify_counts(target, format, path("a.gpkg"), {{"buildings", 4}});
              }),
              "Cannot write \"name\": layer \"buildings\" holds 3 features when read back instead of 4.");
    const Dataset dataset = open_dataset(path("a.gpkg"));
    EXPECT_NO_THROW(writing::check_counts(target, dataset.get(), {{"contours", 3}}));
    EXPECT_EQ(thrown<OutputError>([&] {
                  writing::check_counts(target, dataset.get(), {{"contours", 2}});
              }),
              "Cannot write \"name\": layer \"contours\" holds 3 features when read back instead of 2.");
    EXPECT_EQ(thrown<OutputError>([&] {
                  writing::check_counts(target, dataset.get(), {{"no \"such", 2}});
              }).find("Cannot write \"name\": counting the features of layer \"no \"such\" failed ("),
              0u);
    put("b.gpkg", "text");
    EXPECT_EQ(thrown<OutputError>([&] {
                  writing::verify_counts(target, format, path("b.gpkg"), {});
              }).find("Cannot write \"name\": reading the result back failed ("),
              0u);
}

}  // namespace

}  // namespace d2b::test

namespace d2b::test {
namespace {

class SpoolFolder : public testing::Test {
  protected:
    [[nodiscard]] bool is_empty() const { return std::filesystem::is_empty(folder_.path()); }
    TemporaryFolder folder_;
};

TEST_F(SpoolFolder, GivesBackWhatIsInMemory) {
    FileSpool spool(folder_.path().string(), std::size_t{1} << 30);
    expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, GivesBackWhatIsInTheFile) {
    FileSpool spool(folder_.path().string(), 0);
    expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, GivesBackWhatIsPartlyInTheFile) {
    FileSpool spool(folder_.path().string(), 6'000'000);
    expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, IsThereForSeveralThreads) {
    FileSpool spool(folder_.path().string(), 100'000);
    expect_serves_threads(spool);
}

TEST_F(SpoolFolder, ItsFileHasNoName) {
    FileSpool spool(folder_.path().string(), 0);
    spool.append(some_bytes(10'000'000, 1));
    EXPECT_TRUE(is_empty());
}

TEST_F(SpoolFolder, WithoutAFolderItSaysWhatToDo) {
    FileSpool spool((folder_.path() / "missing").string(), 100);
    EXPECT_EQ(spool.append(some_bytes(100, 1)), 0U);  // needs no file yet
    EXPECT_EQ(error_of<OutputError>([&] { spool.append(some_bytes(100, 1)); }),
              "The finished part of the result cannot be kept in a temporary file in '" +
                  (folder_.path() / "missing").string() +
                  "': No such file or directory; set CPL_TMPDIR to a folder with room.");
}

TEST_F(SpoolFolder, WithoutRoomItSaysWhatToDo) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1'000'000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    FileSpool spool(folder_.path().string(), 0);
    std::string message;
    try {
        spool.append(some_bytes(5'000'000, 1));
    } catch (const OutputError& error) {
        message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_NE(message.find("File too large; set CPL_TMPDIR to a folder with room."), std::string::npos)
        << message;
}

}  // namespace
}  // namespace d2b::test

namespace d2b::test {

namespace {

class PictureTest : public WriteTest {
  protected:
    [[nodiscard]] writing::FileTarget picture(const std::string& name, bool overwrite = false) const {
        return {path(name), overwrite, {}, writing::FileKind::picture};
    }
};

void publish(writing::FileWriter& file) {
    CommitList commit;
    file.prepare(commit);
    commit.publish();
}

TEST_F(PictureTest, IsThereWhenItIsPublishedAndNotBefore) {
    writing::FileWriter file(resolve_file_target(picture("a.png")));
    EXPECT_EQ(entries(), Names{});
    file.write("bytes");
    EXPECT_FALSE(std::filesystem::exists(path("a.png")));
    publish(file);
    EXPECT_EQ(entries(), Names{"a.png"});
    EXPECT_EQ(bytes("a.png"), "bytes");
}

TEST_F(PictureTest, ItsNameSaysItsFormat) {
    EXPECT_EQ(writing::picture_format_of("a.PNG"), writing::PictureFormat::png);
    EXPECT_EQ(writing::picture_format_of("a.svg"), writing::PictureFormat::svg);
    EXPECT_EQ(writing::picture_format_of("a.b.pdf"), writing::PictureFormat::pdf);
    EXPECT_EQ(thrown<OptionError>([&] { std::ignore = resolve_file_target(picture("a.jpg")); }),
              "Pictures are written as PNG, SVG or PDF; give \"" + path("a.jpg") +
                  "\" a name that ends in .png, .svg or .pdf.");
}

TEST_F(PictureTest, AnAbandonedOneLeavesNothing) {
    writing::FileWriter(resolve_file_target(picture("a.png"))).write(std::string(2'000'000, ' '));
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
            writing::FileWriter file(resolve_file_target(picture("a.svg")));
            file.write(std::string(100'000, ' '));
            publish(file);
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
    EXPECT_NE(
        thrown<OptionError>([&] { std::ignore = resolve_file_target(picture("a.png")); }).find("-overwrite"),
        std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] {
                  std::ignore = resolve_file_target(picture("a.png", true));
              }).find("is not a PNG, SVG or PDF"),
              std::string::npos);
    EXPECT_NE(thrown<OptionError>([&] { std::ignore = resolve_file_target(picture("a.tif")); }).find(".png"),
              std::string::npos);
    EXPECT_EQ(bytes("a.png"), "text");
}

TEST_F(PictureTest, AnOldPictureIsReplaced) {
    for (int i = 0; i < 2; ++i) {
        writing::FileWriter file(resolve_file_target(picture("a.png", true)));
        file.write(i == 0 ? "%PDF-1.5 old" : "<svg>new</svg>");
        publish(file);
    }
    EXPECT_EQ(bytes("a.png"), "<svg>new</svg>");
    EXPECT_EQ(entries(), Names{"a.png"});
}

}  // namespace

}  // namespace d2b::test
