#include <fstream>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "dem2buildings/open_sinks.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

namespace fs = std::filesystem;

class FailureTest : public WriteTest {
  protected:
    std::string refused(const WriteOptions& options) {
        return thrown<OutputError>([&] { static_cast<void>(open_sink(options, callbacks_)); });
    }
    /// Writes 20,000 features in a process that may not write files of more than `limit` bytes: as on a full
    /// disk.
    /// @return the message of the OutputError, "" where there is none
    std::string with_little_room(const WriteOptions& options, rlim_t limit) {
        const std::string report = path("report.txt");
        const pid_t child = ::fork();
        if (child == 0) {
            ::signal(SIGXFSZ, SIG_IGN);
            const rlimit room{limit, limit};
            ::setrlimit(RLIMIT_FSIZE, &room);
            std::string message;
            try {
                write(options, 20000);
            } catch (const OutputError& error) {
                message = error.what();
            }
            std::ofstream(report) << message;
            ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
        const std::string message = bytes("report.txt");
        fs::remove(report);
        return message;
    }
};

TEST_F(FailureTest, FoldersThatAreNotThereOrNotFolders) {
    EXPECT_EQ(refused(to("no/a.gpkg")), "Cannot write \"" + path("no/a.gpkg") +
                                            "\": no file can be created in \"" + path("no") +
                                            "\" (No such file or directory); choose another destination.");
    put("file", "text");
    EXPECT_EQ(refused(to("file/a.gpkg")), "Cannot write \"" + path("file/a.gpkg") +
                                              "\": no file can be created in \"" + path("file") +
                                              "\" (Not a directory); choose another destination.");
}

TEST_F(FailureTest, FoldersThatTakeNoFiles) {
    WriteOptions options = to("a.gpkg");
    options.destination = "/proc/d2b.gpkg";
    const std::string message = refused(options);
    EXPECT_EQ(message.find("Cannot write \"/proc/d2b.gpkg\": no file can be created in \"/proc\" ("), 0u)
        << message;
    EXPECT_NE(message.find("); choose another destination."), std::string::npos) << message;
    if (::geteuid() == 0)
        return;
    fs::create_directory(path("locked"));
    fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(refused(to("locked/a.gpkg")), "Cannot write \"" + path("locked/a.gpkg") +
                                                "\": no file can be created in \"" + path("locked") +
                                                "\" (Permission denied); choose another destination.");
}

TEST_F(FailureTest, AFolderWhereAFileIsMeant) {
    for (const char* name : {"a.gpkg", "a.geojson", "a.shp"}) {
        fs::create_directory(path(name));
        EXPECT_EQ(thrown<OptionError>([&] {
                      static_cast<void>(open_sink(to(name), callbacks_));
                  }).find(quote + path(name) + "\" is a folder, and "),
                  0u);
    }
}

TEST_F(FailureTest, AFullDiskLeavesNothing) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.gpkg", ""},
                                                          {"a.geojson", ""},
                                                          {"a.shp", ""},
                                                          {"shapes", "ESRI Shapefile"},
                                                          {"a.sqlite", ""},
                                                          {"a.csv", ""},
                                                          {"a.gml", ""}}) {
        for (const rlim_t limit : {rlim_t{20000}, rlim_t{700000}}) {
            const std::string message = with_little_room(to(name, format), limit);
            EXPECT_EQ(message.find("Cannot write \"" + path(name) + "\": "), 0u) << name << limit << message;
            EXPECT_EQ(message.find("/."), std::string::npos) << message;
            EXPECT_TRUE(entries().empty()) << name;
        }
    }
}

TEST_F(FailureTest, AFullDiskLeavesTheOldContent) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.gpkg", ""},
                                                          {"a.geojson", ""},
                                                          {"a.shp", ""},
                                                          {"shapes", "ESRI Shapefile"},
                                                          {"a.sqlite", ""}}) {
        for (const bool append : {false, true}) {
            fs::remove_all(path(name));
            for (const std::string& entry : entries())
                fs::remove_all(path(entry));
            write(to(name, format), 3);
            const Names before = entries();
            WriteOptions options = to(name, format);
            options.append = append;
            options.overwrite = !append;
            const std::string message = with_little_room(options, 500000);
            EXPECT_EQ(message.find("Cannot write \"" + path(name) + "\": "), 0u) << name << append << message;
            const std::string layer = buildings_layer(options);
            EXPECT_EQ(ids(path(name), layer), (std::vector<std::int64_t>{1, 2, 3})) << name << append;
            EXPECT_EQ(entries(), before) << name << append;
        }
    }
}

TEST_F(FailureTest, GdalsReasonIsGiven) {
    WriteOptions options = to("a.gpkg");
    const auto sink = open_sink(options, callbacks_);
    LayerSpec spec = layer_spec("buildings");
    spec.fields.push_back({"id", "", FieldType::real, "", ""});
    const std::string message = thrown<OutputError>([&] {
        sink->begin({&spec, 1}, provenance());
        sink->finish();
    });
    EXPECT_EQ(message.find("Cannot write \"" + path("a.gpkg") + "\": "), 0u) << message;
    EXPECT_NE(message.find("failed ("), std::string::npos) << message;
}

TEST_F(FailureTest, AFeatureThatIsRefusedIsNamed) {
    write(to("a.gpkg"), 2);
    sql(path("a.gpkg"),
        "CREATE TRIGGER mine BEFORE INSERT ON buildings WHEN NEW.id = 4 BEGIN SELECT RAISE(ABORT, 'none of "
        "mine'); END",
        true);
    WriteOptions options = to("a.gpkg");
    options.append = true;
    const std::string message = thrown<OutputError>([&] { write(options, 3); });
    EXPECT_EQ(message.find("Cannot write \"" + path("a.gpkg") +
                           "\": writing feature 4 of layer \"buildings\" failed ("),
              0u)
        << message;
    EXPECT_NE(message.find("none of mine"), std::string::npos) << message;
    EXPECT_EQ(ids(path("a.gpkg"), "buildings"), (std::vector<std::int64_t>{1, 2}));
}

TEST_F(FailureTest, ABrokenCrsIsAnError) {
    const auto sink = open_sink(to("a.gpkg"), callbacks_);
    const LayerSpec spec = layer_spec("buildings");
    Provenance broken = provenance();
    broken.crs_wkt = "PROJCRS[nonsense";
    const std::string message = thrown<OutputError>([&] { sink->begin({&spec, 1}, broken); });
    EXPECT_EQ(message.find("Cannot write \"" + path("a.gpkg") + "\": reading the CRS failed ("), 0u)
        << message;
}

TEST_F(FailureTest, FeaturesThatDoNotFitTheirLayer) {
    const auto sink = open_sink(to("a.gpkg"), callbacks_);
    const LayerSpec spec = layer_spec("buildings");
    sink->begin({&spec, 1}, provenance());
    Feature feature = square(1);
    feature.values.pop_back();
    EXPECT_EQ(thrown<OutputError>([&] { sink->add(0, feature); }),
              "Cannot write \"" + path("a.gpkg") +
                  "\": a feature of layer \"buildings\" has 2 values for 3 fields.");
    EXPECT_EQ(thrown<OutputError>([&] { sink->add(1, square(1)); }),
              "Cannot write \"" + path("a.gpkg") + "\": it has no layer number 1.");
}

TEST_F(FailureTest, DevicesAreWrittenInPlace) {
    WriteOptions options;
    options.destination = "/dev/full";
    options.format = "CSV";
    options.layers = Layers::buildings;
    if (!fs::exists(options.destination))
        GTEST_SKIP() << "this system has no /dev/full";
    EXPECT_NE(thrown<OutputError>([&] { write(options, 1000); }), "");
    EXPECT_TRUE(fs::exists(options.destination));
}

}  // namespace

}  // namespace d2b::test
