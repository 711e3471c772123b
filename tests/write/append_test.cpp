#include <array>
#include <fstream>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

class AppendTest : public WriteTest {
  protected:
    [[nodiscard]] WriteOptions more(const std::string& name, const std::string& format = "") const {
        WriteOptions options = to(name, format);
        options.append = true;
        return options;
    }
    /// Message about a layer like this, before the work and, should it come to be there meanwhile, after
    /// it.
    std::string refusal(const WriteOptions& options, const LayerSpec& spec, const Provenance& what) {
        const auto early = open_sink(options, callbacks_);
        const std::string message = thrown<OutputError>([&] { early->preflight({&spec, 1}, what, {}); });
        const auto sink = open_sink(options, callbacks_);
        EXPECT_EQ(thrown<OutputError>([&] { sink->begin({&spec, 1}, what); }), message);
        return message;
    }
};

TEST_F(AppendTest, NumbersGoOnWhereTheyEnded) {
    for (const auto& [name, format] : std::vector<std::pair<std::string, std::string>>{
             {"a.gpkg", ""}, {"a.sqlite", ""}, {"shapes", "ESRI Shapefile"}, {"a.gdb", ""}}) {
        EXPECT_EQ(write(to(name, format), 2), 1) << name;
        EXPECT_EQ(write(more(name, format), 3), 3) << name;
        EXPECT_EQ(ids(path(name), "buildings"), (std::vector<std::int64_t>{1, 2, 3, 4, 5})) << name;
        EXPECT_EQ(ids(path(name), "contours"), (std::vector<std::int64_t>{1, 2, 3, 4, 5})) << name;
    }
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT COUNT(*) FROM rtree_contours_geom"), "5");
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT feature_count FROM gpkg_ogr_contents WHERE table_name='contours'"),
              "5");
}

TEST_F(AppendTest, FilesThatAreOneLayer) {
    for (const char* name : {"a.shp", "a.geojson", "a.csv"}) {
        write(to(name), 2);
        EXPECT_EQ(write(more(name), 1), 3) << name;
        EXPECT_EQ(ids(path(name), "a"), (std::vector<std::int64_t>{1, 2, 3})) << name;
    }
}

TEST_F(AppendTest, TheLargestNumberOfEitherLayerCounts) {
    const auto sink = open_sink(to("a.gpkg"), callbacks_);
    const LayerSpec specs[] = {layer_spec("buildings"), layer_spec("contours")};
    sink->begin(specs, provenance());
    sink->add(0, square(4));
    sink->add(1, square(70));
    sink->add(1, square(8));
    sink->finish();
    const auto second = open_sink(more("a.gpkg"), callbacks_);
    second->begin(specs, provenance());
    EXPECT_EQ(second->first_id(), 71);
}

TEST_F(AppendTest, NumbersAreTakenWhenWritingBegins) {
    for (const char* name : {"a.gpkg", "a.sqlite"}) {
        write(to(name), 2);
        const auto slow = open_sink(more(name), callbacks_);
        EXPECT_EQ(write(more(name), 3), 3) << name;
        const LayerSpec spec = layer_spec("buildings");
        slow->begin({&spec, 1}, provenance());
        EXPECT_EQ(slow->first_id(), 6) << name;
        slow->add(0, square(slow->first_id()));
        slow->finish();
        EXPECT_EQ(ids(path(name), "buildings"), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6})) << name;
    }
}

TEST_F(AppendTest, AFileInWalModeThatNobodyHasOpen) {
    write(to("a.gpkg"), 2);
    EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA journal_mode = WAL", true), "wal");
    EXPECT_EQ(write(more("a.gpkg"), 3), 3);
    EXPECT_EQ(ids(path("a.gpkg"), "buildings"), (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
}

TEST_F(AppendTest, WaitsForAnotherWhoWrites) {
    write(to("a.gpkg"), 2);
    const LayerSpec spec = layer_spec("buildings");
    std::array<int, 2> ready{};
    ASSERT_EQ(::pipe(ready.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const auto sink = open_sink(more("a.gpkg"), callbacks_);
        sink->begin({&spec, 1}, provenance());
        sink->add(0, square(sink->first_id()));
        static_cast<void>(!::write(ready[1], "x", 1));
        ::usleep(400'000);
        sink->finish();
        ::_exit(0);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    const auto sink = open_sink(more("a.gpkg"), callbacks_);
    sink->begin({&spec, 1}, provenance());
    EXPECT_EQ(sink->first_id(), 4);
    sink->add(0, square(sink->first_id()));
    sink->finish();
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(ids(path("a.gpkg"), "buildings"), (std::vector<std::int64_t>{1, 2, 3, 4}));
    EXPECT_EQ(
        sql(path("a.gpkg"), "SELECT feature_count FROM gpkg_ogr_contents WHERE table_name = 'buildings'"),
        "4");
}

TEST_F(AppendTest, WhoNeverEndsIsNotWaitedForForEver) {
    write(to("a.gpkg"), 2);
    const LayerSpec spec = layer_spec("buildings");
    callbacks_.stop = [] { return true; };
    const auto sink = open_sink(more("a.gpkg"), callbacks_);
    const Dataset other = open_dataset(path("a.gpkg"), true);
    ASSERT_EQ(GDALDatasetStartTransaction(other.get(), FALSE), OGRERR_NONE);
    GDALDatasetReleaseResultSet(
        other.get(),
        GDALDatasetExecuteSQL(other.get(), "DELETE FROM buildings WHERE id = 1", nullptr, nullptr));
    // Whoever is asked to stop meanwhile stops.
    EXPECT_THROW(sink->begin({&spec, 1}, provenance()), Cancelled);
    GDALDatasetRollbackTransaction(other.get());
}

TEST_F(AppendTest, TheFirstFieldIsTheNumberWhateverItsName) {
    LayerSpec spec = layer_spec("buildings");
    spec.fields[0].name = "ID_BUILD";
    for (const char* name : {"a.gpkg", "a.geojson"}) {
        for (const std::int64_t expected : {1, 8}) {
            WriteOptions options = expected == 1 ? to(name) : more(name);
            options.layers = Layers::buildings;
            const auto sink = open_sink(options, callbacks_);
            spec.name = sink->layer_name(LayerRole::buildings, Layers::buildings);
            sink->begin({&spec, 1}, provenance());
            EXPECT_EQ(sink->first_id(), expected) << name;
            sink->add(0, square(7));
            sink->finish();
        }
    }
}

TEST_F(AppendTest, AbsentLayersAreCreated) {
    WriteOptions options = to("a.gpkg");
    options.layers = Layers::buildings;
    write(options, 2);
    EXPECT_EQ(write(more("a.gpkg"), 1), 3);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 3);
    EXPECT_EQ(ids(path("a.gpkg"), "contours"), std::vector<std::int64_t>{3});
}

TEST_F(AppendTest, WhatDoesNotFitIsRefused) {
    write(to("a.gpkg"), 2);
    const std::string start = "Cannot append to \"" + path("a.gpkg") + "\": its layer \"buildings\" ";
    const std::string end = "; write to another destination.";
    LayerSpec spec = layer_spec("buildings");
    Provenance other = provenance();
    other.crs_wkt = wkt_of(25833);
    EXPECT_EQ(refusal(more("a.gpkg"), spec, other),
              start + "is in \"ETRS89 / UTM zone 32N\" and the result in \"ETRS89 / UTM zone 33N\"" + end);
    other.crs_wkt = "";
    EXPECT_EQ(refusal(more("a.gpkg"), spec, other),
              start + "is in \"ETRS89 / UTM zone 32N\" and the result in no CRS" + end);
    spec.fields.push_back({"floors", "", FieldType::integer, "", ""});
    EXPECT_EQ(refusal(more("a.gpkg"), spec, provenance()), start + "has no field \"floors\"" + end);
    spec = layer_spec("buildings");
    spec.fields[1].type = FieldType::text;
    EXPECT_EQ(refusal(more("a.gpkg"), spec, provenance()),
              start + "has field \"height\" with type Real" + end);
    spec.fields[1].type = FieldType::integer;
    spec.fields[2].type = FieldType::real;
    spec = layer_spec("buildings", true);
    EXPECT_EQ(refusal(more("a.gpkg"), spec, provenance()), start + "has no Z, but the result has it" + end);
    spec = layer_spec("buildings");
    spec.points = true;
    EXPECT_EQ(refusal(more("a.gpkg"), spec, provenance()),
              start + "holds geometries of type Multi Polygon and not points" + end);
    WriteOptions z = to("z.gpkg");
    z.with_z = true;
    write(z, 1);
    EXPECT_EQ(refusal(more("z.gpkg"), layer_spec("buildings"), provenance()),
              "Cannot append to \"" + path("z.gpkg") +
                  "\": its layer \"buildings\" has Z, but the result has none" + end);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 2);
}

TEST_F(AppendTest, AUsersLayerOfTheSameNameIsRefused) {
    write(to("a.gpkg"), 1);
    add_user_layer(path("a.gpkg"), "points", 2, "GPKG");
    WriteOptions options = more("a.gpkg");
    options.layer_name = "points";
    options.layers = Layers::buildings;
    Provenance plain = provenance();
    plain.crs_wkt = "";
    const std::string message = refusal(options, layer_spec("points"), provenance());
    EXPECT_NE(message.find("its layer \"points\" "), std::string::npos) << message;
    EXPECT_EQ(count(path("a.gpkg"), "points"), 2);
}

TEST_F(AppendTest, FormatsThatTakeNoMoreAreRefused) {
    for (const auto& [name, format] :
         std::vector<std::pair<std::string, std::string>>{{"a.gml", "GML"}, {"a.kml", "KML"}}) {
        write(to(name, format), 2);
        const std::string before = bytes(name);
        EXPECT_EQ(thrown<OptionError>([&, file = name, kind = format] { write(more(file, kind), 1); }),
                  "GDAL cannot append to \"" + path(name) + "\", a dataset of format " + format +
                      "; write to another destination, or to a GeoPackage.");
        EXPECT_EQ(bytes(name), before);
    }
}

/// The driver of netCDF changes a file as soon as it opens it for writing.
TEST_F(AppendTest, ANetcdfIsReplacedAndNotAddedTo) {
    if (GDALGetDriverByName("netCDF") == nullptr)
        GTEST_SKIP() << "this GDAL has no netCDF";
    write(to("a.nc"), 5);
    WriteOptions over = to("a.nc");
    over.overwrite = true;
    const std::string before = bytes("a.nc");
    const auto time = std::filesystem::last_write_time(path("a.nc"));
    static_cast<void>(open_sink(over, callbacks_));
    EXPECT_EQ(thrown<OptionError>([&] { static_cast<void>(open_sink(more("a.nc"), callbacks_)); }),
              "GDAL cannot append to \"" + path("a.nc") +
                  "\", a dataset of format netCDF; write to another destination, or to a GeoPackage.");
    EXPECT_EQ(bytes("a.nc"), before);
    EXPECT_EQ(std::filesystem::last_write_time(path("a.nc")), time);
    write(over, 2);
    EXPECT_EQ(ids(path("a.nc"), buildings_layer(over)), (std::vector<std::int64_t>{1, 2}));
}

TEST_F(AppendTest, AbandonedAppendLeavesTheOldContent) {
    for (const char* name : {"a.gpkg", "a.geojson", "a.shp"}) {
        write(to(name), 2);
        const auto before = entries();
        const std::string layer = buildings_layer(to(name));
        {
            const auto sink = open_sink(more(name), callbacks_);
            const LayerSpec spec = layer_spec(layer);
            sink->begin({&spec, 1}, provenance());
            sink->add(0, square(3));
        }
        EXPECT_EQ(ids(path(name), layer), (std::vector<std::int64_t>{1, 2})) << name;
        EXPECT_EQ(entries(), before) << name;
    }
}

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

TEST_F(FailureTest, NamedPipesAreWritten) {
    for (const char* name : {"a.csv", "a.geojson", "a.geojsonl", "a.kml"}) {
        ASSERT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
        // Write in a child, because a pipe is opened once both ends are there.
        const pid_t child = ::fork();
        if (child == 0) {
            WriteOptions options = to(name);
            options.layers = Layers::buildings;
            bool done = false;
            try {
                write(options, 1000);
                done = true;
            } catch (const Error&) {
            }
            if (!done)
                std::ofstream(path(name)) << "";
            ::_exit(done ? 0 : 1);
        }
        EXPECT_GT(bytes(name).size(), 10000U) << name;
        int status = -1;
        ::waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << name;
        EXPECT_TRUE(fs::is_fifo(path(name)));
    }
    ASSERT_EQ(::mkfifo(path("a.gpkg").c_str(), 0600), 0);
    const std::string refusal = thrown<OutputError>([&] { write(to("a.gpkg"), 1); });
    EXPECT_TRUE(
        refusal.starts_with("Cannot write \"" + path("a.gpkg") + "\": creating the GPKG dataset failed ("))
        << refusal;
    EXPECT_TRUE(refusal.ends_with("; give the name of a file, or another format, such as GeoJSON."))
        << refusal;
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
