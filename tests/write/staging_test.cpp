#include "write/staging.hpp"

#include <fstream>

#include "write/vector/layer_writer.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

namespace fs = std::filesystem;

class StagingTest : public WriteTest {
  protected:
    static void put_in(const StagingFolder& staging, const std::string& name, const std::string& text) {
        std::ofstream(staging.folder() / name) << text;
    }
};

TEST_F(StagingTest, TheFolderIsHiddenAndGoes) {
    {
        const StagingFolder staging("name", path("a.txt"));
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
        StagingFolder staging("name", path("a.txt"));
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
        StagingFolder staging("name", path("a.txt"));
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
    StagingFolder staging("name", path("a.txt"));
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
            StagingFolder staging("name", path("a.txt"));
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
        StagingFolder staging("name", path("a"));
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
        StagingFolder staging("name", path("a.txt"));
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
        StagingFolder staging("name", path("b.txt"));
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
        RenameTransaction moves;
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
    const WriteTarget target{.name = "name", .hidden_folder = ""};
    const VectorFormat format = format_for(to("a.gpkg"));
    EXPECT_NO_THROW(verify_counts(target, format, path("a.gpkg"), {{"buildings", 3}, {"contours", 3}}));
    EXPECT_EQ(thrown<OutputError>([&] {
                  verify_counts(target, format, path("a.gpkg"), {{"buildings", 4}});
              }),
              "Cannot write \"name\": layer \"buildings\" holds 3 features when read back instead of 4.");
    const Dataset dataset = open_dataset(path("a.gpkg"));
    EXPECT_NO_THROW(check_counts(target, dataset.get(), {{"contours", 3}}));
    EXPECT_EQ(thrown<OutputError>([&] {
                  check_counts(target, dataset.get(), {{"contours", 2}});
              }),
              "Cannot write \"name\": layer \"contours\" holds 3 features when read back instead of 2.");
    EXPECT_EQ(thrown<OutputError>([&] {
                  check_counts(target, dataset.get(), {{"no \"such", 2}});
              }).find("Cannot write \"name\": counting the features of layer \"no \"such\" failed ("),
              0u);
    put("b.gpkg", "text");
    EXPECT_EQ(thrown<OutputError>([&] {
                  verify_counts(target, format, path("b.gpkg"), {});
              }).find("Cannot write \"name\": reading the result back failed ("),
              0u);
}

}  // namespace

}  // namespace d2b::test
