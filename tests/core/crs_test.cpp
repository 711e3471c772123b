#include "core/crs.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs_cases.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

using namespace test;

void expect_unit(const std::optional<LengthUnit>& unit, const std::string& name, double metres) {
    ASSERT_TRUE(unit.has_value());
    EXPECT_EQ(unit->name, name);
    EXPECT_DOUBLE_EQ(unit->metres, metres);
}

TEST(Crs, NoneSaysNothing) {
    for (const Crs& none : {Crs(), Crs("")}) {
        EXPECT_EQ(none.kind(), Crs::Kind::none);
        EXPECT_EQ(none.name(), "");
        EXPECT_EQ(none.wkt(), "");
        EXPECT_FALSE(none.horizontal_unit() || none.vertical_unit() || none.on_ellipsoid());
    }
}

TEST(Crs, KindIsThatOfTheHorizontalPart) {
    const std::vector<std::pair<std::string, Crs::Kind>> cases{
        {"EPSG:25832", Crs::Kind::projected},
        {"EPSG:4326", Crs::Kind::geographic},
        {"EPSG:4979", Crs::Kind::geographic},
        {"EPSG:7415", Crs::Kind::projected},
        {"EPSG:28992+5709", Crs::Kind::projected},
        {"NAD83 + NAVD88 height", Crs::Kind::geographic},
        {local_feet, Crs::Kind::local},
        {"EPSG:4978", Crs::Kind::other},
        {"EPSG:5709", Crs::Kind::other},
        {"+proj=utm +zone=32 +ellps=bessel +towgs84=598,73,418 +type=crs", Crs::Kind::projected},
        {"+proj=longlat +ellps=bessel +towgs84=598,73,418", Crs::Kind::geographic},
        {"+proj=ob_tran +o_proj=longlat +o_lon_p=0 +o_lat_p=39.25 +lon_0=18", Crs::Kind::geographic}};
    for (const auto& [text, kind] : cases)
        EXPECT_EQ(Crs(text).kind(), kind) << text;
}

TEST(Crs, HasTheUrlOfItsCode) {
    const std::string epsg = "https://www.opengis.net/def/crs/EPSG/0/";
    EXPECT_EQ(Crs("EPSG:25832").url(), epsg + "25832");
    EXPECT_EQ(Crs("EPSG:7415").url(), epsg + "7415");
    EXPECT_EQ(Crs(Crs("EPSG:25832").wkt()).url(), epsg + "25832");
    EXPECT_EQ(Crs("ESRI:102003").url(), "https://www.opengis.net/def/crs/ESRI/0/102003");
    EXPECT_EQ(Crs("+proj=tmerc +lon_0=9 +ellps=GRS80 +type=crs").url(), "");
    EXPECT_EQ(Crs("+proj=tmerc +lon_0=9 +ellps=GRS80 +type=crs").horizontal_url(), "");
    EXPECT_EQ(Crs().url(), "");
    EXPECT_EQ(Crs().horizontal_url(), "");
}

/// The EPSG's register: 7415, 5555, 5698 and 7405 are these pairs; 25832 with DHHN2016 has no number.
TEST(Crs, HasTheUrlOfAnEqualCompound) {
    const std::string epsg = "https://www.opengis.net/def/crs/EPSG/0/";
    for (const auto& [pair, code] : {std::pair<const char*, const char*>{"EPSG:28992+5709", "7415"},
                                     {"EPSG:25832+5783", "5555"},
                                     {"EPSG:2154+5720", "5698"},
                                     {"EPSG:27700+5701", "7405"}})
        EXPECT_EQ(Crs(Crs(pair).wkt()).url(), epsg + code) << pair;
    EXPECT_EQ(Crs("EPSG:25832+7837").url(), "");
    EXPECT_EQ(Crs("EPSG:25832+7837").horizontal_url(), epsg + "25832");
    EXPECT_EQ(Crs("EPSG:7415").horizontal_url(), epsg + "28992");
    std::string bare = Crs("EPSG:25832").wkt();  // as in a file that states no codes
    bare.replace(bare.rfind(R"(,ID["EPSG",25832])"), std::string::npos, "]");
    EXPECT_EQ(Crs(bare).url(), epsg + "25832");
}

TEST(Crs, ReadsEveryNotation) {
    const std::string name = "ETRS89 / UTM zone 32N";
    const std::string json =
        R"({"type":"GeographicCRS","name":"mine","datum":{"type":"GeodeticReferenceFrame",)"
        R"("name":"mine","ellipsoid":{"name":"mine","radius":1000}},"coordinate_system":)"
        R"({"subtype":"ellipsoidal","axis":[{"name":"Lat","abbreviation":"Lat","direction":)"
        R"("north","unit":"degree"},{"name":"Lon","abbreviation":"Lon","direction":"east",)"
        R"("unit":"degree"}]}})";
    EXPECT_EQ(Crs("EPSG:25832").name(), name);
    EXPECT_EQ(Crs("urn:ogc:def:crs:EPSG::25832").name(), name);
    EXPECT_EQ(Crs("+init=epsg:25832").name(), name);
    EXPECT_EQ(Crs(name).name(), name);
    EXPECT_EQ(Crs("WGS84").name(), "WGS 84");
    EXPECT_EQ(Crs(wgs84_wkt1).name(), "WGS 84");
    EXPECT_EQ(Crs("EPSG:28992+5709").name(), "Amersfoort / RD New + NAP height");
    EXPECT_EQ(Crs("+proj=utm +zone=32 +datum=WGS84").kind(), Crs::Kind::projected);
    EXPECT_EQ(Crs(json).name(), "mine");
}

TEST(Crs, WktIsVersion2AndReadsBack) {
    for (const char* text : {"EPSG:25832", "EPSG:7415", "EPSG:4979", "+proj=longlat +ellps=bessel"}) {
        const Crs crs(text);
        EXPECT_EQ(crs.wkt().find('\n'), std::string::npos);
        const Crs again(crs.wkt());
        EXPECT_EQ(again.wkt(), crs.wkt());
        EXPECT_EQ(again.kind(), crs.kind());
    }
    const Crs bound("+proj=longlat +ellps=bessel +towgs84=1,2,3");
    EXPECT_TRUE(bound.wkt().starts_with("BOUNDCRS["));
    EXPECT_EQ(Crs(bound.wkt()).kind(), Crs::Kind::geographic);
    EXPECT_TRUE(Crs("EPSG:25832").wkt().starts_with(R"(PROJCRS["ETRS89 / UTM zone 32N",)"));
    EXPECT_TRUE(Crs(wgs84_wkt1).wkt().starts_with(R"(GEOGCRS["WGS 84",)"));
}

TEST(Crs, HorizontalUnits) {
    expect_unit(Crs("EPSG:25832").horizontal_unit(), "metre", 1);
    expect_unit(Crs("EPSG:2253").horizontal_unit(), "foot", 0.3048);
    expect_unit(Crs("EPSG:2227").horizontal_unit(), "US survey foot", 1200.0 / 3937);
    expect_unit(Crs("EPSG:7415").horizontal_unit(), "metre", 1);
    expect_unit(Crs("EPSG:5555").horizontal_unit(), "metre", 1);
    expect_unit(Crs(local_feet).horizontal_unit(), "foot", 0.3048);
    expect_unit(Crs(R"(LOCAL_CS["grid",UNIT["Meter",1]])").horizontal_unit(), "metre", 1);
    expect_unit(Crs(R"(LOCAL_CS["grid",UNIT["rod",5.0292]])").horizontal_unit(), "rod", 5.0292);
    for (const std::string& text : {std::string("EPSG:4326"), std::string("EPSG:4979"),
                                    std::string("EPSG:4978"), std::string("EPSG:5709"), local_unknown})
        EXPECT_FALSE(Crs(text).horizontal_unit().has_value()) << text;
}

TEST(Crs, VerticalUnits) {
    expect_unit(Crs("EPSG:4979").vertical_unit(), "metre", 1);
    expect_unit(Crs("EPSG:7415").vertical_unit(), "metre", 1);
    expect_unit(Crs("EPSG:5555").vertical_unit(), "metre", 1);
    expect_unit(Crs("EPSG:2227+6360").vertical_unit(), "US survey foot", 1200.0 / 3937);
    expect_unit(Crs("EPSG:25832+8228").vertical_unit(), "foot", 0.3048);
    expect_unit(
        Crs("+proj=utm +zone=32 +ellps=GRS80 +geoidgrids=none.gtx +vunits=us-ft +type=crs").vertical_unit(),
        "US survey foot", 1200.0 / 3937);
    for (const char* text : {"EPSG:25832", "EPSG:2227", "EPSG:2253", "EPSG:4326", "EPSG:4978"})
        EXPECT_FALSE(Crs(text).vertical_unit().has_value()) << text;
}

TEST(Crs, KnowsWhatIsOnAnEllipsoid) {
    for (const char* text : {"EPSG:25832", "EPSG:4326", "EPSG:7415", "EPSG:3857", "EPSG:4807",
                             "+proj=longlat +R=1", "+proj=utm +zone=32 +ellps=bessel +towgs84=598,73,418"})
        EXPECT_TRUE(Crs(text).on_ellipsoid()) << text;
    for (const std::string& text :
         {local_feet, std::string("EPSG:4978"), std::string("EPSG:5709"), unknown_projection})
        EXPECT_FALSE(Crs(text).on_ellipsoid()) << text;
}

TEST(Crs, RefusesWhatIsNoCrs) {
    const std::string advice =
        "; give a code such as EPSG:25832 or EPSG:25832+7837, WKT, PROJJSON or a PROJ string.";
    const auto message = [](const std::string& text) {
        return message_of<OptionError>([&, text = text] { Crs crs(text); });
    };
    const std::string unknown = message("EPSG:99999");
    EXPECT_TRUE(
        unknown.starts_with("'EPSG:99999' is not a coordinate reference system (PROJ: crs not found"));
    EXPECT_TRUE(unknown.ends_with(")" + advice)) << unknown;
    // PROJ 9.6 takes a name only if it begins like that of a CRS.
    EXPECT_EQ(
        message("Amersf"),
        "'Amersf' is not the name of a coordinate reference system (the nearest is 'Amersfoort')" + advice);
    EXPECT_EQ(
        message("urn:ogc:def:ellipsoid:EPSG::7030"),
        "'urn:ogc:def:ellipsoid:EPSG::7030' is not a coordinate reference system but 'WGS 84'" + advice);
    const std::string broken =
        message("PROJCS[\"a broken\ndefinition\" that goes on for more than sixty characters");
    EXPECT_TRUE(
        broken.starts_with("'PROJCS[\"a broken definition\" that goes on for more than sixt...' is not a "
                           "coordinate reference system (PROJ: "))
        << broken;
    for (const char* text : {" ", "+proj=nothing", "{\"type\":1}", "EPSG:", "EPSG:25832+x"})
        EXPECT_TRUE(message(text).find("is not a coordinate reference system (PROJ: ") != std::string::npos)
            << text;
}

TEST(Crs, SuggestsTheCodeThatIsMeant) {
    for (const auto& [text, code] : {std::pair("4326", "EPSG:4326"),
                                     {"25832+7837", "EPSG:25832+7837"},
                                     {"epsg4326", "EPSG:4326"},
                                     {"EPSG 4326", "EPSG:4326"}}) {
        EXPECT_EQ(guess_epsg_code(text), code);
        EXPECT_EQ(message_of<OptionError>([&, text = text] { Crs crs(text); }),
                  std::string("'") + text + "' is not a coordinate reference system; write " + code +
                      " if that is meant.");
    }
    for (const char* text : {"", " ", "EPSG:4326", "EPSG:", "EPSG", "0", "4326 ", "WGS 84", "+4326", "foo"})
        EXPECT_EQ(guess_epsg_code(text), "") << text;
}

TEST(Crs, RequiresAPlane) {
    for (const char* text : {"EPSG:25832", "EPSG:4326", "EPSG:7415"})
        EXPECT_NO_THROW(require_plane(Crs(text), "", "dem.tif")) << text;
    EXPECT_NO_THROW(require_plane(Crs(), "", "dem.tif"));
    EXPECT_NO_THROW(require_plane(Crs(local_feet), "", "dem.tif"));
    EXPECT_EQ(message_of<OptionError>([] { require_plane(Crs("EPSG:5773"), "-a_srs EPSG:5773", ""); }),
              "-a_srs EPSG:5773 is 'EGM96 height', which has no plane coordinates; give a projected or "
              "geographic coordinate reference system.");
    EXPECT_THROW(require_plane(Crs("EPSG:4978"), "", "dem.tif"), InputError);
}

TEST(Crs, PrintsNothing) {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    EXPECT_THROW(Crs("EPSG:99999"), OptionError);
    const Crs local(local_feet);
    EXPECT_THROW(CoordinateTransform(local, Crs("EPSG:4326"), {}), OptionError);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Versions, AreNumbersWithDotsBetween) {
    for (const std::string& text : {proj_version(), geographiclib_version()}) {
        ASSERT_FALSE(text.empty());
        EXPECT_EQ(text.find_first_not_of("0123456789."), std::string::npos) << text;
        EXPECT_NE(text.find('.'), std::string::npos) << text;
        EXPECT_EQ(text.find(".."), std::string::npos) << text;
        EXPECT_TRUE(text.front() != '.' && text.back() != '.') << text;
    }
    // The oldest that the project can be built with.
    EXPECT_GE(std::stoi(proj_version()), 9);
    EXPECT_GE(std::stoi(geographiclib_version()), 1);
}

}  // namespace
}  // namespace d2b
