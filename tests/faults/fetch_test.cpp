#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "faults/faulty_case.hpp"

namespace d2b::test {
namespace {

constexpr const char* server = "http://127.0.0.1:9";

/// Files that make GDAL fetch others that they name, unless it is held back. Nobody answers: whoever asks is
/// counted.
class Fetches : public FaultyTest {
  protected:
    void SetUp() override {
        if (D2B_SANITIZED != 0)
            GTEST_SKIP() << "the sanitizers' libraries do not go with a preloaded one";
        FaultyTest::SetUp();
        write(path("side.tif"), town(300));
    }
    struct Asked {
        ToolResult result;
        long questions = 0;
    };
    [[nodiscard]] Asked asked(const Arguments& arguments) const {
        const std::string counter = path("counter");
        Asked asked{run(arguments, {.environment = failing("net:0:EIO", "", counter)}), 0};
        std::ifstream(counter) >> asked.questions;
        std::filesystem::remove(counter);
        return asked;
    }
    /// A square degree around blocks(): a GeoJSON without a CRS is one of longitudes and latitudes.
    static std::string geojson(const std::string& crs) {
        return R"({"type": "FeatureCollection", "crs": )" + crs +
               R"(, "features": [{"type": "Feature", "properties": {"a": 1}, "geometry": {"type": "Polygon",
            "coordinates": [[[13, 52], [14, 52], [14, 53], [13, 53], [13, 52]]]}}]})";
    }
    [[nodiscard]] std::string link(const std::string& name = "link.geojson") const {
        write_text(path(name), geojson(R"({"type": "link", "properties": {"href": ")" + std::string(server) +
                                       R"(/secret", "type": "proj4"}})"));
        return name;
    }
    /// A raster whose overviews are said to be on a server.
    void send_overviews_away(const std::string& name) const {
        write_text(path(name + ".aux.xml"), R"(<PAMDataset><Metadata domain="OVERVIEWS">
            <MDI key="OVERVIEW_FILE">/vsicurl/)" +
                                                std::string(server) +
                                                R"(/secret.tif</MDI></Metadata></PAMDataset>)");
    }
};

TEST_F(Fetches, aFileThatRefersToAnAddressAsPolygons) {
    const std::string url = server;
    write_text(path("url.geojson"),
               geojson(R"({"type": "url", "properties": {"url": ")" + url + R"(/secret"}})"));
    write_text(
        path("features.gml"),
        R"(<?xml version="1.0"?><wfs:FeatureCollection xmlns:wfs="http://www.opengis.net/wfs" )"
        R"(xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xmlns:foo="http://foo" )"
        R"(xmlns:gml="http://www.opengis.net/gml" xsi:schemaLocation="http://foo )" +
            url +
            R"(/wfs?SERVICE=WFS&amp;REQUEST=DescribeFeatureType&amp;TYPENAME=foo:a&amp;VERSION=1.1.0">)"
            R"(<gml:featureMember><foo:a gml:id="a.0"><foo:geom><gml:Polygon><gml:exterior><gml:LinearRing>)"
            R"(<gml:posList>391000 5819700 391300 5819700 391300 5820000 391000 5820000 391000 5819700</gml:posList></gml:LinearRing></gml:exterior>)"
            R"(</gml:Polygon></foo:geom></foo:a></gml:featureMember></wfs:FeatureCollection>)");
    for (const std::string& file : std::vector<std::string>{link(), "url.geojson", "features.gml"})
        for (const char* option : {"-cutline", "-mask", "-split_by", "-footprints", "-exclude"}) {
            SCOPED_TRACE(file + " " + option);
            const Asked run = asked({"-q", "-overwrite", option, file, "dem.tif", "out.gpkg"});
            EXPECT_EQ(run.result.status, 0) << run.result.err;
            EXPECT_EQ(run.questions, 0);
            EXPECT_NE(run.result.err.find("refers to " + url), std::string::npos) << run.result.err;
            EXPECT_NE(run.result.err.find("which is not fetched"), std::string::npos) << run.result.err;
        }
}

TEST_F(Fetches, aFileThatRefersToAnAddressAsAPicture) {
    write_text(path("overlay.kml"),
               R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>
        <GroundOverlay><Icon><href>)" +
                   std::string(server) + R"(/over.png</href></Icon><LatLonBox><north>1</north>
        <south>0</south><east>1</east><west>0</west></LatLonBox></GroundOverlay></Document></kml>)");
    write_text(path("super.kml"),
               R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>
        <Region><LatLonAltBox><north>1</north><south>0</south><east>1</east><west>0</west></LatLonAltBox></Region>
        <NetworkLink><Region><LatLonAltBox><north>1</north><south>0</south><east>1</east><west>0</west></LatLonAltBox>
        <Lod><minLodPixels>128</minLodPixels></Lod></Region><Link><href>)" +
                   std::string(server) + R"(/0/0/0.kml</href></Link></NetworkLink></Document></kml>)");
    for (const char* file : {"overlay.kml", "super.kml"})
        for (const Arguments& arguments : {Arguments{file, "out.gpkg"},
                                           {"-mask", file, "dem.tif", "out.gpkg"},
                                           {"-ground", file, "dem.tif", "out.gpkg"}}) {
            SCOPED_TRACE(testing::PrintToString(arguments));
            const Asked run = asked(arguments);
            EXPECT_EQ(run.result.status, 1);
            EXPECT_EQ(run.questions, 0);
        }
}

TEST_F(Fetches, aFileThatRefersToAnAddressForItsOverviews) {
    send_overviews_away("dem.tif");
    send_overviews_away("side.tif");
    for (const char* option : {"-ground", "-mask"}) {
        const Asked run = asked({"-q", "-overwrite", option, "side.tif", "dem.tif", "out.gpkg"});
        EXPECT_EQ(run.questions, 0) << option;
    }
    const Asked run = asked({"-q", "-overwrite", "dem.tif", "out.gpkg"});
    EXPECT_EQ(run.result.status, 0) << run.result.err;
    EXPECT_EQ(run.questions, 0);
}

TEST_F(Fetches, aFileThatRefersToAnAddressWhereItDoesNotBelong) {
    Asked run = asked({"-q", link(), "out.gpkg"});  // as a DEM
    EXPECT_EQ(run.result.status, 1);
    EXPECT_EQ(run.questions, 0);
    run = asked(
        {"-q", "-overwrite", "-layers", "buildings", "dem.tif", link("old.geojson")});  // to be replaced
    EXPECT_EQ(run.result.status, 0) << run.result.err;
    EXPECT_EQ(run.questions, 0);
    // A list of addresses has no address for the data that it lists.
    write_text(path("list.vrt"),
               R"(<OGRVRTDataSource><OGRVRTLayer name="link"><SrcDataSource relativeToVRT="1">)" + link() +
                   "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>");
    run = asked({"-q", "-overwrite", "-cutline", "list.vrt", "dem.tif", "out.gpkg"});
    EXPECT_EQ(run.questions, 0) << run.result.err;
}

TEST_F(Fetches, anAddressThatIsNamed) {
    const std::string url = server;
    write_text(path("list.vrt"),
               R"(<VRTDataset rasterXSize="300" rasterYSize="300"><VRTRasterBand dataType="Float32" band="1">
        <SimpleSource><SourceFilename>/vsicurl/)" +
                   url + R"(/a.tif</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>)");
    write_text(path("wfs.xml"), "<OGRWFSDataSource><URL>" + url + "/wfs</URL></OGRWFSDataSource>");
    for (const Arguments& arguments : {Arguments{"/vsicurl/" + url + "/a.tif", "out.gpkg"},
                                       {url + "/a.tif", "out.gpkg"},
                                       {"list.vrt", "out.gpkg"},
                                       {"-cutline", url + "/a.geojson", "dem.tif", "out.gpkg"},
                                       {"-cutline", "wfs.xml", "dem.tif", "out.gpkg"},
                                       {"-ground", "/vsicurl/" + url + "/a.tif", "dem.tif", "out.gpkg"}}) {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const Asked run = asked(arguments);
        EXPECT_EQ(run.result.status, 1);
        EXPECT_GT(run.questions, 0);
    }
}

}  // namespace
}  // namespace d2b::test
