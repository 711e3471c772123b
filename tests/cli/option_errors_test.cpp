#include "cli/cli_test_case.hpp"

namespace d2b::test {
namespace {

class OptionErrors : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        write(path("dem.tif"), blocks());
    }
    /// Wrong usage: status 2. The file names follow the arguments.
    void refused(Arguments arguments, const std::string& part) const {
        arguments.insert(arguments.end(), {"--", "dem.tif", "out.gpkg"});
        expect_error(2, part, arguments);
    }
};

TEST_F(OptionErrors, saysWhatIsMissingOrTooMuch) {
    const std::string usage = "; usage: dem2buildings [options] <src_raster> <dst_vector>.";
    expect_error(2, "The source and the destination are missing" + usage, {"-q"});
    expect_error(2, "The destination is missing, there is only 'dem.tif'" + usage, {"dem.tif"});
    expect_error(2,
                 "There are too many file names, 'dem.tif', 'a.gpkg' and 'b.gpkg'; give one source and one "
                 "destination.",
                 {"dem.tif", "a.gpkg", "b.gpkg"});
    expect_error(2, "The destination 'dem.tif' is the source; give another name.", {"dem.tif", "dem.tif"});
    expect_error(2, "A file name is empty" + usage, {"dem.tif", ""});
    expect_error(2, "'-' is not a file name here; write /vsistdin/ or /vsistdout/.", {"-", "out.gpkg"});
}

TEST_F(OptionErrors, printsTheUsageWhereThereAreNoArguments) {
    const ToolResult result = run({});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "Usage: dem2buildings [options] <src_raster> <dst_vector>\n"
              "Try dem2buildings --help for the options.\n");
}

TEST_F(OptionErrors, refusesUnknownOptionsWithAdvice) {
    refused({"-lad", "4"}, "There is no option -lad; did you mean -lod?");
    refused({"-nonsense"}, "There is no option -nonsense; dem2buildings --help lists all.");
    refused({"-config", "A", "B"}, "There is no option -config; did you mean --config?");
}

TEST_F(OptionErrors, suggestsTheCodeThatANumberMeans) {
    refused({"-a_srs", "4326"},
            "-a_srs 4326 is not a coordinate reference system; write -a_srs EPSG:4326 if that is meant.");
    refused({"-t_srs", "4326"},
            "'4326' is not a coordinate reference system; write EPSG:4326 if that is meant.");
}

TEST_F(OptionErrors, saysInWhichOrderCornersCome) {
    refused({"-te", "0", "5", "4", "1"},
            "-te takes xmin ymin xmax ymax, and 0 5 4 1 is the upper left and the lower right corner, as "
            "-projwin takes them; write -te 0 1 4 5.");
    refused({"-te", "5819990", "391002", "5819999", "391010"},
            "; x comes before y, so write -te 391002 5819990 391010 5819999.");
}

TEST_F(OptionErrors, refusesValuesOutOfRange) {
    refused({"-b", "0"}, "-b must be a whole number from 1 to 65536, not '0'.");
    refused({"-b", "x"}, "not 'x'.");
    refused({"-lod", "0"}, "-lod must be a whole number from 1 to 10000, not '0'.");
    refused({"-lod", "2.5"}, "not '2.5'.");
    refused({"-lod", "99999999999999999999"}, "not '99999999999999999999'.");
    refused({"-i", "0"}, "-i must be a number above 0, not '0'.");
    refused({"-i", "nan"}, "-i must be a number above 0, not 'nan'.");
    refused({"-i", "5", "-off", "far"}, "-off must be a number, not 'far'.");
    refused({"-nf", "-1"}, "-nf must be a whole number from 0 to 1000000000, not '-1'.");
    refused({"-min_area", "-1"}, "-min_area must be a number of at least 0, not '-1'.");
    refused({"-simplify", "-0.5"}, "-simplify must be a number of at least 0, not '-0.5'.");
    refused({"-snodata", "none"}, "-snodata must be a number, not 'none'.");
    refused({"-trace", "lines"}, "-trace must be points or cells, not 'lines'.");
    refused({"-layers", "all"}, "-layers must be buildings, contours or both, not 'all'.");
    refused({"-preset", "best"}, "-preset must be buildings or thesis, not 'best'.");
    refused({"-zunit", "yard"},
            "-zunit must be m, ft, us-ft or a number above 0 (metres in one unit), not 'yard'.");
    refused({"-zunit", "0"}, "not '0'.");
    refused({"-fl", "MIN"}, "-fl must be numbers, not 'MIN'.");
    refused({"-srcwin", "0", "0", "0", "5"},
            "-srcwin must be four whole numbers, columns and rows above 0, not '0 0 0 5'.");
    refused({"-projwin", "0", "0", "1", "1"},
            "-projwin must be four numbers, ulx below lrx and uly above lry, not '0 0 1 1'.");
    refused({"-te", "1", "0", "0", "1"},
            "-te must be four numbers, xmin below xmax and ymin below ymax, not '1 0 0 1'.");
    refused({"-oo", "NAME"}, "-oo must be NAME=VALUE, not 'NAME'.");
    refused({"-dsco", "=V"}, "-dsco must be NAME=VALUE, not '=V'.");
    refused({"-lco", "NAME"}, "-lco must be NAME=VALUE, not 'NAME'.");
}

TEST_F(OptionErrors, refusesMissingAndSuperfluousValues) {
    refused({"-lod"}, "-lod needs a value: -lod <n>.");
    refused({"-fl"}, "-fl needs at least one value: -fl <level> [<level>...].");
    refused({"-te", "1", "2"}, "-te needs 4 values: -te <xmin> <ymin> <xmax> <ymax>.");
    refused({"-nln="}, "-nln needs a value: -nln <name>.");
    refused({"-q=yes"}, "-q takes no value.");
    refused({"-lod", "3", "-lod", "4"}, "-lod is given twice; give it once.");
}

TEST_F(OptionErrors, refusesWhatExcludesEachOther) {
    refused({"-fl", "5", "-i", "2"}, "-fl cannot be used together with -i");
    refused({"-lod", "2", "-fl", "5"}, "-lod cannot be used together with -fl");
    refused({"-lod", "2", "-i", "5"}, "-lod cannot be used together with -i");
    refused({"-off", "2"}, "-off needs -i <interval>");
    refused({"-srcwin", "0", "0", "5", "5", "-te", "0", "0", "1", "1"},
            "give one of -srcwin, -projwin and -te.");
    refused({"-srcwin", "0", "0", "5", "5", "-projwin", "0", "1", "1", "0"},
            "give one of -srcwin, -projwin and -te.");
    refused({"-te", "0", "0", "1", "1", "-projwin", "0", "1", "1", "0"},
            "give one of -srcwin, -projwin and -te.");
    refused({"-snodata", "1", "-inodata"}, "-snodata cannot be used together with -inodata");
    refused({"-overwrite", "-append"}, "-overwrite cannot be used together with -append");
    expect_error(2, "-json cannot be used with a destination in /vsistdout/",
                 {"-json", "-f", "GeoJSON", "dem.tif", "/vsistdout/"});
}

TEST_F(OptionErrors, refusesWhatDoesNotFitTheInput) {
    refused({"-srcwin", "25", "0", "6", "5"},
            "-srcwin 25 0 6 5 (column row columns rows) does not lie inside the raster; the raster has 30 "
            "columns and 20 "
            "rows.");
    refused({"-te", "0", "0", "1", "1"},
            "-te 0 0 1 1 holds no cell centre of the raster, which extends from 391000 to 391030 in x and "
            "from 5819980 to "
            "5820000 in y.");
    refused({"-projwin", "0", "1", "1", "0"}, "-projwin 0 1 1 0 holds no cell centre of the raster");
    refused({"-i", "1e-6"}, "-i 1e-06 gives more than 65534 levels on this DEM; use a larger interval.");
    refused({"-i", "1", "-off", "1e17"},
            "-off 1e+17 is too far away to count intervals of 1 from; give a base near the elevations.");
    refused({"-a_srs", "EPSG:nothing"}, "-a_srs EPSG:nothing is not a coordinate reference system");
    refused({"-t_srs", "EPSG:nothing"}, "EPSG:nothing");
    refused({"-if", "NoSuch"}, "-if NoSuch is not a format of this GDAL; gdalinfo --formats lists them.");
}

TEST_F(OptionErrors, refusesMapWindowsOnTurnedGrids) {
    RasterSpec spec = blocks();
    spec.transform = std::array<double, 6>{391000, 0.8, 0.6, 5820000, 0.6, -0.8};
    write(path("turned.tif"), spec);
    expect_error(2, "-te 0 0 1 1 cannot be used, since the rows of the raster do not run along the x axis",
                 {"-te", "0", "0", "1", "1", "turned.tif", "out.gpkg"});
}

TEST_F(OptionErrors, refusesToReprojectWhatHasNoCrs) {
    RasterSpec spec = blocks();
    spec.crs = "";
    write(path("plain.tif"), spec);
    expect_error(2, "-t_srs needs to know the CRS of the DEM, which has none; give it with -a_srs.",
                 {"-t_srs", "EPSG:4326", "plain.tif", "out.gpkg"}, {}, 1);
}

}  // namespace
}  // namespace d2b::test
