#include <array>
#include <filesystem>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cpl_conv.h>

#include "dem2buildings/open_sinks.hpp"
#include "write/ogr_util.hpp"
#include "write/write_fixture.hpp"

namespace d2b::test {

namespace {

/// Content of the tables of a GeoPackage, as text.
std::string describe(const std::string& path) {
    std::string text;
    for (const char* statement :
         {"SELECT group_concat(name || coalesce(sql, '') || '~') FROM (SELECT name, sql FROM sqlite_master "
          "ORDER BY name)",
          "SELECT group_concat(table_name || data_type || identifier || description || last_change || min_x "
          "|| max_x "
          "|| srs_id || '~') FROM gpkg_contents",
          "SELECT group_concat(table_name || feature_count || '~') FROM gpkg_ogr_contents",
          "SELECT group_concat(coalesce(table_name, '') || extension_name || '~') FROM gpkg_extensions",
          "SELECT group_concat(table_name || geometry_type_name || srs_id || z || '~') FROM "
          "gpkg_geometry_columns",
          "SELECT group_concat(metadata) FROM gpkg_metadata",
          "SELECT group_concat(coalesce(table_name, '') || md_file_id || '~') FROM gpkg_metadata_reference",
          "SELECT group_concat(fid || hex(geom) || id || '~') FROM buildings",
          "SELECT group_concat(id || minx || maxx || '~') FROM rtree_buildings_geom",
          "SELECT group_concat(fid || hex(geom) || note || '~') FROM points"})
        text += sql(path, statement) + "\n";
    return text;
}

class GeoPackageTest : public WriteTest {
  protected:
    /// One with both of our layers, a user's layer, a user's table and a style.
    void prepare(const std::string& name) {
        write(to(name), 5);
        add_user_layer(path(name), "points", 3, "GPKG");
        sql(path(name), "CREATE TABLE plain (a INTEGER, b TEXT)", true);
        sql(path(name), "INSERT INTO plain VALUES (1, 'one'), (2, 'two')", true);
        // A table of styles of another shape than QGIS's.
        sql(path(name), "DROP TABLE layer_styles", true);
        sql(path(name),
            "CREATE TABLE layer_styles (id INTEGER PRIMARY KEY, f_table_name TEXT, styleQML TEXT)", true);
        sql(path(name), "INSERT INTO layer_styles VALUES (1, 'points', 'red'), (2, 'buildings', 'blue')",
            true);
    }
    void expect_users_part(const std::string& name) const {
        EXPECT_EQ(count(path(name), "points"), 3);
        EXPECT_EQ(sql(path(name), "SELECT COUNT(*) FROM rtree_points_geom"), "3");
        EXPECT_EQ(sql(path(name), "SELECT group_concat(a || b) FROM plain"), "1one,2two");
        EXPECT_EQ(sql(path(name), "SELECT group_concat(styleQML) FROM layer_styles"), "red,blue");
    }
    [[nodiscard]] WriteOptions over(const std::string& name) const {
        WriteOptions options = to(name);
        options.overwrite = true;
        return options;
    }
    /// Runs in a process of its own; @return how it ended
    static int in_child(const std::function<void()>& work) {
        const pid_t child = ::fork();
        if (child == 0) {
            work();
            ::_exit(0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return status;
    }
    void add_many(FeatureSink& sink, int n) {
        const LayerSpec specs[] = {layer_spec("buildings"), layer_spec("contours")};
        sink.begin(specs, provenance());
        for (int i = 0; i < n; ++i) {
            sink.add(0, square(i + 1000));
            sink.add(1, square(i + 1000));
        }
    }
};

TEST_F(GeoPackageTest, OverwriteReplacesOurLayersAlone) {
    prepare("a.gpkg");
    write(over("a.gpkg"), 2);
    EXPECT_EQ(ids(path("a.gpkg"), "buildings"), (std::vector<std::int64_t>{1, 2}));
    EXPECT_EQ(count(path("a.gpkg"), "contours"), 2);
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT COUNT(*) FROM rtree_buildings_geom"), "2");
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT feature_count FROM gpkg_ogr_contents WHERE table_name='buildings'"),
              "2");
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT max_x FROM gpkg_contents WHERE table_name='buildings'"), "3");
    EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA foreign_key_check"), "");
    expect_users_part("a.gpkg");
    const Dataset dataset = open_dataset(path("a.gpkg"));
    OGRLayerH layer = GDALDatasetGetLayerByName(dataset.get(), "buildings");
    EXPECT_STREQ(GDALGetMetadataItem(layer, "IDENTIFIER", nullptr), "Title of buildings");
    EXPECT_STREQ(GDALGetMetadataItem(layer, "source", nullptr), "dem.tif");
    EXPECT_EQ(entries(), Names{"a.gpkg"});
}

TEST_F(GeoPackageTest, OverwriteOfOneLayerLeavesTheOther) {
    prepare("a.gpkg");
    WriteOptions options = over("a.gpkg");
    options.layers = Layers::buildings;
    write(options, 1);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 1);
    EXPECT_EQ(count(path("a.gpkg"), "contours"), 5);
    expect_users_part("a.gpkg");
}

TEST_F(GeoPackageTest, OverwriteAddsToAFileOfOthers) {
    add_user_layer(path("a.gpkg"), "points", 3, "GPKG");
    write(over("a.gpkg"), 2);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 2);
    EXPECT_EQ(count(path("a.gpkg"), "points"), 3);
}

/// One that holds rasters alone does not open as a dataset of vectors, but for writing.
TEST_F(GeoPackageTest, LayersAreAddedToRasters) {
    const reading::DatasetOwner memory(
        GDALCreate(GDALGetDriverByName("MEM"), "", 50, 40, 1, GDT_Byte, nullptr));
    std::array<double, 6> transform{400000, 1, 0, 5000000, 0, -1};
    GDALSetGeoTransform(memory.get(), transform.data());
    GDALFillRaster(GDALGetRasterBand(memory.get(), 1), 7, 0);
    const auto make = [&] {
        const reading::DatasetOwner raster(GDALCreateCopy(GDALGetDriverByName("GPKG"), path("r.gpkg").c_str(),
                                                          memory.get(), FALSE, nullptr, nullptr, nullptr));
        ASSERT_TRUE(raster);
    };
    for (const bool append : {true, false}) {
        make();
        WriteOptions options = to("r.gpkg");
        (append ? options.append : options.overwrite) = true;
        write(options, 2);
        EXPECT_EQ(count(path("r.gpkg"), "buildings"), 2);
        const std::string tiles = sql(path("r.gpkg"), "SELECT group_concat(hex(tile_data)) FROM r");
        EXPECT_TRUE(tiles.starts_with("89504E47")) << tiles;  // a PNG
        EXPECT_EQ(sql(path("r.gpkg"), "PRAGMA integrity_check"), "ok");
        write(over("r.gpkg"), 3);
        EXPECT_EQ(count(path("r.gpkg"), "buildings"), 3);
        EXPECT_EQ(sql(path("r.gpkg"), "SELECT group_concat(hex(tile_data)) FROM r"), tiles);
        std::filesystem::remove(path("r.gpkg"));
    }
}

TEST_F(GeoPackageTest, TitlesStayDifferent) {
    const auto titled = [&](const std::string& layer) {
        const auto sink = open_sink(layer == "old" ? to("a.gpkg") : over("a.gpkg"), callbacks_);
        LayerSpec spec = layer_spec(layer);
        spec.title = "Buildings";
        sink->begin({&spec, 1}, provenance());
        sink->finish();
        return sql(path("a.gpkg"), "SELECT identifier FROM gpkg_contents WHERE table_name='" + layer + "'");
    };
    EXPECT_EQ(titled("old"), "Buildings");
    EXPECT_EQ(titled("new"), "Buildings (new)");
    EXPECT_EQ(titled("new"), "Buildings (new)");
    // Title as of ogr2ogr, whose layers are called as their tables.
    sql(path("a.gpkg"), "UPDATE gpkg_contents SET identifier = 'buildings' WHERE table_name = 'old'", true);
    EXPECT_EQ(titled("new"), "Buildings (new)");
}

TEST_F(GeoPackageTest, AnAbandonedRunChangesNothing) {
    prepare("a.gpkg");
    const std::string before = describe(path("a.gpkg"));
    ASSERT_NE(before.find("rtree_buildings_geom"), std::string::npos);
    for (const int n : {0, 1, 500, 20000}) {
        {
            const auto sink = open_sink(over("a.gpkg"), callbacks_);
            add_many(*sink, n);
        }
        EXPECT_EQ(describe(path("a.gpkg")), before) << n;
    }
    EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(entries(), Names{"a.gpkg"});
}

TEST_F(GeoPackageTest, AKilledRunChangesNothing) {
    prepare("a.gpkg");
    const std::string before = describe(path("a.gpkg"));
    for (const int n : {1, 30000}) {
        for (const bool append : {false, true}) {
            const int status = in_child([&] {
                WriteOptions options = over("a.gpkg");
                options.overwrite = !append;
                options.append = append;
                const auto sink = open_sink(options, callbacks_);
                add_many(*sink, n);
                ::raise(SIGKILL);
            });
            ASSERT_TRUE(WIFSIGNALED(status));
            // SQLite, opened for writing, takes back the changes that the dead process has left in the file.
            sql(path("a.gpkg"), "SELECT 1", true);
            EXPECT_EQ(describe(path("a.gpkg")), before) << n << append;
            EXPECT_EQ(sql(path("a.gpkg"), "PRAGMA integrity_check"), "ok");
        }
    }
    write(over("a.gpkg"), 2);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 2);
    expect_users_part("a.gpkg");
}

TEST_F(GeoPackageTest, AKilledRunIsNoHindranceInSqliteEither) {
    write(to("a.sqlite"), 5);
    EXPECT_EQ(entries(), Names{"a.sqlite"});
    const int status = in_child([&] {
        const auto sink = open_sink(over("a.sqlite"), callbacks_);
        add_many(*sink, 30000);
        ::raise(SIGKILL);
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    WriteOptions options = to("a.sqlite");
    options.append = true;
    EXPECT_EQ(write(options, 1), 6);
    EXPECT_EQ(ids(path("a.sqlite"), "buildings"), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
}

TEST_F(GeoPackageTest, AKilledRunLeavesNoNewFile) {
    const int status = in_child([&] {
        const auto sink = open_sink(to("a.gpkg"), callbacks_);
        add_many(*sink, 1000);
        ::_exit(7);
    });
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_FALSE(std::filesystem::exists(path("a.gpkg")));
    write(to("a.gpkg"), 2);
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 2);
}

/// Another process that has the file open in WAL mode and reads it, as QGIS does.
class Reader {
  public:
    explicit Reader(const std::string& path) {
        EXPECT_EQ(::pipe(to_.data()), 0);
        EXPECT_EQ(::pipe(from_.data()), 0);
        child_ = ::fork();
        if (child_ == 0)
            run(path);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
        ::close(to_[1]);
        ::waitpid(child_, nullptr, 0);
        ::close(to_[0]);
        ::close(from_[0]);
        ::close(from_[1]);
    }
    /// Features that the other process sees in `points` and in `buildings`.
    std::array<int, 2> look() const {
        std::array<int, 2> seen{};
        EXPECT_EQ(::write(to_[1], "?", 1), 1);
        EXPECT_EQ(::read(from_[0], seen.data(), sizeof seen), static_cast<ssize_t>(sizeof seen));
        return seen;
    }

  private:
    static int number(GDALDatasetH dataset, const char* statement) {
        OGRLayerH result = GDALDatasetExecuteSQL(dataset, statement, nullptr, nullptr);
        OGRFeatureH row = result == nullptr ? nullptr : OGR_L_GetNextFeature(result);
        const int value = row == nullptr ? -1 : OGR_F_GetFieldAsInteger(row, 0);
        OGR_F_Destroy(row);
        GDALDatasetReleaseResultSet(dataset, result);
        return value;
    }
    [[noreturn]] void run(const std::string& path) const {
        ::close(to_[1]);
        {
            const Dataset dataset = open_dataset(path, true);
            GDALDatasetReleaseResultSet(
                dataset.get(),
                GDALDatasetExecuteSQL(dataset.get(), "PRAGMA journal_mode = WAL", nullptr, nullptr));
            char request = 0;
            while (::read(to_[0], &request, 1) == 1) {
                const std::array<int, 2> seen{number(dataset.get(), "SELECT COUNT(*) FROM points"),
                                              number(dataset.get(), "SELECT COUNT(*) FROM buildings")};
                if (::write(from_[1], seen.data(), sizeof seen) < 0)
                    break;
            }
        }
        ::_exit(0);
    }

    std::array<int, 2> to_{};
    std::array<int, 2> from_{};
    pid_t child_ = 0;
};

TEST_F(GeoPackageTest, AnotherProcessMayHaveItOpenInWalMode) {
    prepare("a.gpkg");
    {
        const Reader reader(path("a.gpkg"));
        EXPECT_EQ(reader.look(), (std::array<int, 2>{3, 5}));
        {
            const auto sink = open_sink(over("a.gpkg"), callbacks_);
            add_many(*sink, 20000);
            EXPECT_EQ(reader.look(), (std::array<int, 2>{3, 5}));
            sink->finish();
        }
        EXPECT_EQ(reader.look(), (std::array<int, 2>{3, 20000}));
        {
            const auto sink = open_sink(over("a.gpkg"), callbacks_);
            add_many(*sink, 20000);
        }
        EXPECT_EQ(reader.look(), (std::array<int, 2>{3, 20000}));
    }
    EXPECT_EQ(count(path("a.gpkg"), "buildings"), 20000);
    expect_users_part("a.gpkg");
}

TEST_F(GeoPackageTest, TwoRunsGiveTheSameBytes) {
    CPLSetConfigOption("OGR_CURRENT_DATE", "2020-01-02T03:04:05.678Z");
    for (const char* name : {"a.gpkg", "b.gpkg"}) {
        const auto sink = open_sink(to(name), callbacks_);
        add_many(*sink, 5000);
        sink->finish();
    }
    CPLSetConfigOption("OGR_CURRENT_DATE", nullptr);
    EXPECT_EQ(sql(path("a.gpkg"), "SELECT '' || last_change FROM gpkg_contents"), "2020-01-02T03:04:05.678Z");
    EXPECT_TRUE(bytes("a.gpkg") == bytes("b.gpkg"));
}

}  // namespace

}  // namespace d2b::test
