#include <cmath>

#include "cli/cli_test_case.hpp"
#include "cli/town_files.hpp"

namespace d2b::test {
namespace {

/// What the preset buildings refuses.
class BuildingErrors : public CliTest {
  protected:
    void SetUp() override {
        CliTest::SetUp();
        preset_ = "buildings";
        write(path("dem.tif"), town_raster(MadeTown::surface()));
    }
    void refused(int status, Arguments arguments, const std::string& part, int warnings = 0) const {
        arguments.insert(arguments.end(), {"--", "dem.tif", "out.gpkg"});
        expect_error(status, part, arguments, {}, warnings);
    }
};

TEST_F(BuildingErrors, refusesValuesOutOfRange) {
    refused(2, {"-max_building_width", "0"},
            "-max_building_width must be a number above 0 and at most 100000, not '0'.");
    refused(2, {"-min_height", "-1"}, "-min_height must be a number of at least 0, not '-1'.");
    refused(2, {"-min_confidence", "2"}, "-min_confidence must be a number from 0 to 1, not '2'.");
    refused(2, {"-split_width", "-1"}, "-split_width must be a number of at least 0, not '-1'.");
    refused(2, {"-split_height", "low"}, "-split_height must be a number of at least 0, not 'low'.");
    refused(2, {"-levels", "floor"}, "-levels must be building, natural or global, not 'floor'.");
    refused(2, {"-regularize", "left"}, "-regularize must be auto, off, right or free, not 'left'.");
    refused(2, {"-regularize_tolerance", "0"},
            "-regularize_tolerance must be a number above 0 and at most 100, not '0'.");
    refused(2, {"-fields", "shp"}, "-fields must be own, urock, city4cfd or osm, not 'shp'.");
}

TEST_F(BuildingErrors, refusesWhatExcludesEachOther) {
    refused(
        2, {"-simplify", "1", "-regularize", "auto"},
        "-simplify 1 cannot be used together with -regularize auto; straight walls need no simplification.");
    for (const Arguments& arguments : {Arguments{"-ground", "auto"},
                                       {"-mask", "m.tif"},
                                       {"-ndvi", "n.tif"},
                                       {"-split_height", "1"},
                                       {"-split_by", "p.gpkg"},
                                       {"-min_height", "1"},
                                       {"-min_confidence", "1"},
                                       {"-max_building_width", "50"},
                                       {"-write_doubtful"},
                                       {"-write_ground", "g.tif"},
                                       {"-write_height", "g.tif"},
                                       {"-write_canopy", "g.tif"},
                                       {"-levels", "building"}}) {
        Arguments all{"-preset", "thesis"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        refused(2, all, arguments[0]);
        refused(2, all,
                " has no effect with -preset thesis; it detects no buildings, so leave one of them out.");
    }
}

TEST_F(BuildingErrors, refusesADoubtfulLayerWhereThereIsNoPlace) {
    expect_error(2, "\"out.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -write_doubtful.",
                 {"-write_doubtful", "dem.tif", "out.geojson"});
    expect_error(2, "\"out.geojson\" holds one layer (format GeoJSON); use a GeoPackage for -write_rejected.",
                 {"-write_rejected", "dem.tif", "out.geojson"});
}

TEST_F(BuildingErrors, saysWhatIsNotThere) {
    refused(1, {"-ground", "none.tif"}, "none.tif");
    refused(1, {"-mask", "none.gpkg"}, "The mask 'none.gpkg' cannot be opened as a raster or as polygons");
    refused(1, {"-ndvi", "none.tif"}, "none.tif");
    refused(1, {"-split_by", "none.gpkg"}, "The parcel dataset 'none.gpkg' cannot be opened");
}

TEST_F(BuildingErrors, saysWhatDoesNotFit) {
    RasterSpec far = town_raster(MadeTown::terrain());
    far.transform = std::array<double, 6>{491000, 1, 0, 5820000, 0, -1};
    write(path("far.tif"), far);
    refused(1, {"-ground", "far.tif"}, "has no cell in the part of 'dem.tif' that is used");
    refused(1, {"-ndvi", "far.tif"}, "has no cell in the part of 'dem.tif' that is used");
    write(path("bytes.tif"), town_raster(MadeTown::in({}, 0, 127)));
    refused(1, {"-ndvi", "bytes.tif"}, "has the value 127, and an NDVI lies between -1 and 1");
    RasterSpec plain = town_raster(MadeTown::terrain());
    plain.transform.reset();
    plain.crs = "";
    write(path("plain.tif"), plain);
    refused(1, {"-ground", "plain.tif"}, "give both of them one, for example with gdal_edit.py -a_ullr.");
}

TEST_F(BuildingErrors, refusesToOverwriteWhatItReadsOrWrites) {
    write(path("dtm.tif"), town_raster(MadeTown::terrain()));
    for (const char* option : {"-write_ground", "-write_height", "-write_canopy"}) {
        refused(2, {"-overwrite", option, "dem.tif"},
                "\"dem.tif\" is already read or written by this run; choose another name.");
        refused(2, {"-overwrite", "-ground", "dtm.tif", option, "./dtm.tif"},
                "\"./dtm.tif\" is already read or written by this run; choose another name.");
        refused(2, {option, "dtm.tif"},
                "\"dtm.tif\" exists; give another name, or -overwrite to replace it.");
        refused(2, {option, "out.png"},
                "Rasters are written as GeoTIFF; give \"out.png\" a name that ends in .tif.");
        refused(1, {option, "no/such/g.tif"}, "no file can be created in \"no/such\" (");
    }
    refused(2, {"-write_ground", "a.tif", "-write_height", "a.tif"},
            "\"a.tif\" is already read or written by this run; choose another name.");
}

}  // namespace
}  // namespace d2b::test
