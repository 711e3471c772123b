#include "core/crs.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/crs_cases.hpp"
#include "core/ellipsoid.hpp"
#include "core/text.hpp"
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
    EXPECT_EQ(Crs("EPSG:25832+5783").name(), "ETRS89 / UTM zone 32N + DHHN92 height");
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
        return error_of<OptionError>([&, given = text] { Crs crs(given); });
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
        EXPECT_EQ(error_of<OptionError>([&, given = text] { Crs crs(given); }),
                  std::string("'") + text + "' is not a coordinate reference system; write " + code +
                      " if that is meant.");
    }
    for (const char* text : {"", " ", "EPSG:4326", "EPSG:", "EPSG", "0", "4326 ", "WGS 84", "+4326", "foo"})
        EXPECT_EQ(guess_epsg_code(text), "") << text;
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

TEST(CoordinateTransform, GoesThereAndBack) {
    const Crs utm("EPSG:25832");
    const std::vector<Position> places{{500000, 0}, {691608, 5334760}, {350000, 5650000}};
    for (const char* text : {"EPSG:3857", "EPSG:4326", "EPSG:28992+5709", "EPSG:4979"}) {
        const Crs other(text);
        std::vector<Position> moved = places;
        CoordinateTransform(utm, other, places).apply(moved);
        EXPECT_NE(moved, places);
        CoordinateTransform(other, utm, moved).apply(moved);
        for (std::size_t i = 0; i < places.size(); ++i) {
            // The way to the Dutch datum and back is exact to the square of its rotations.
            EXPECT_NEAR(moved[i].x, places[i].x, 1e-3) << text;
            EXPECT_NEAR(moved[i].y, places[i].y, 1e-3) << text;
        }
    }
}

TEST(CoordinateTransform, GivesGisOrder) {
    // Latitude on the central meridian is the length of the meridian arc.
    const double north = 0.9996 * grs80.meridian(0, 48);
    std::vector<Position> places{{500000, north}};
    CoordinateTransform(Crs("EPSG:25832"), Crs("EPSG:4326"), places).apply(places);
    EXPECT_NEAR(places[0].x, 9, 1e-9);
    EXPECT_NEAR(places[0].y, 48, 1e-9);
    CoordinateTransform(Crs("EPSG:4326"), Crs("EPSG:3857"), places).apply(places);
    EXPECT_NEAR(places[0].x, 6378137 * radians(9), 1e-3);
    EXPECT_NEAR(places[0].y, 6378137 * std::log(std::tan(radians(45 + 48 / 2.0))), 1e-3);
}

TEST(CoordinateTransform, KeepsTheShiftOfABoundCrs) {
    // One second of arc at the equator, as the shift along the y axis that TOWGS84 states.
    const double shift = 6378137 * std::tan(radians(1 / 3600.0));
    std::vector<Position> places{{0, 0}};
    CoordinateTransform(Crs("+proj=longlat +ellps=WGS84 +towgs84=0," + number_text(shift) + ",0"),
                        Crs("EPSG:4326"), {})
        .apply(places);
    EXPECT_NEAR(places[0].x * 3600, 1, 1e-6);
    EXPECT_NEAR(places[0].y, 0, 1e-9);
}

/// PROJ 9.1 calls itself without end where the area of interest begins or ends at 180 degrees.
TEST(CoordinateTransform, TakesAnAreaAtTheAntimeridian) {
    for (const std::vector<Position>& area : {std::vector<Position>{{180, -17}},
                                              {{-180, -17}},
                                              {{180, -17}, {180, -16.9}},
                                              {{180, -17}, {-180, -16.9}},
                                              {{-180, -90}, {180, 90}}})
        for (const char* target : {"EPSG:32660", "EPSG:3460"}) {
            std::vector<Position> places{{180, -17}};
            EXPECT_TRUE(CoordinateTransform(Crs("EPSG:4326"), Crs(target), area).try_apply(places));
        }
}

TEST(CoordinateTransform, SaysWhatHasNoImage) {
    std::vector<Position> places{{11, 48}, {11, 91}, {12, 48}};
    CoordinateTransform transform(Crs("EPSG:4326"), Crs("EPSG:25832"), {});
    EXPECT_FALSE(transform.try_apply(places));
    EXPECT_NEAR(places[0].y, 5317000, 2000);
    EXPECT_FALSE(std::isfinite(places[1].x));
    EXPECT_TRUE(std::isfinite(places[2].x));
    std::vector<Position> good{{11, 48}};
    EXPECT_TRUE(transform.try_apply(good));
    EXPECT_EQ(good[0], places[0]);
}

TEST(CoordinateTransform, TakesAnyArea) {
    const Crs geographic("EPSG:4326");
    const Crs fiji("EPSG:3460");
    const std::vector<Position> across{{179.9, -17}, {-179.9, -17}, {180.2, -16}};
    for (const std::vector<Position>& area :
         {across, std::vector<Position>{}, std::vector<Position>{{nan_value, 0}, {infinity, 1000}}}) {
        std::vector<Position> places{{179.9, -17}};
        CoordinateTransform(geographic, fiji, area).apply(places);
        EXPECT_NEAR(places[0].x, 2000000 + 0.99985 * wgs84.parallel(-17, 1.15), 200);
        EXPECT_NEAR(places[0].y, 4000000, 700);
    }
}

TEST(CoordinateTransform, PicksTheOperationForTheArea) {
    // The European datum of 1950 has parameters of its own in Norway, Spain, ...
    const Crs ed50("EPSG:23030");
    const auto moved = [&](const std::vector<Position>& area) {
        std::vector<Position> places{{400000, 4500000}};
        CoordinateTransform(ed50, Crs("EPSG:25830"), area).apply(places);
        return places[0];
    };
    const Position in_spain = moved({{390000, 4490000}, {410000, 4510000}});
    const Position in_norway = moved({{900000, 6650000}, {910000, 6660000}});
    EXPECT_GT(std::hypot(in_spain.x - in_norway.x, in_spain.y - in_norway.y), 1);
    EXPECT_NEAR(in_spain.x, 400000 - 109, 10);
    EXPECT_NEAR(in_spain.y, 4500000 - 207, 10);
}

TEST(CoordinateTransform, LeavesTheSameCrsAlone) {
    std::vector<Position> places{{0.1, 0.2}, {1e6, 2e6}};
    const std::vector<Position> before = places;
    for (const std::string& text : {std::string("EPSG:25832"), local_feet}) {
        CoordinateTransform same{Crs(text), Crs(text), places};
        same.apply(places);
        EXPECT_EQ(places, before);
        EXPECT_NO_THROW(same.apply({}));
    }
}

TEST(CoordinateTransform, NamesTheFirstPositionWithoutImageAndChangesNone) {
    const auto failure = [](CoordinateTransform& transform, std::vector<Position> places) {
        const std::vector<Position> before = places;
        const std::string message = error_of<InputError>([&] { transform.apply(places); });
        for (std::size_t i = 0; i < places.size(); ++i)
            EXPECT_TRUE(std::isnan(before[i].x) || places[i] == before[i]);
        return message;
    };
    const std::string end = "check which coordinate reference system the coordinates are in.";
    CoordinateTransform mercator(Crs("EPSG:4326"), Crs("EPSG:3857"), {});
    EXPECT_EQ(failure(mercator, {{1, 2}, {8, 5300000}, {nan_value, 3}}),
              "Position (8, 5300000) of 'WGS 84' has no counterpart in 'WGS 84 / Pseudo-Mercator'; " + end);
    EXPECT_EQ(failure(mercator, {{1, 2}, {nan_value, 3}}),
              "Position (nan, 3) of 'WGS 84' has no counterpart in 'WGS 84 / Pseudo-Mercator'; " + end);
    EXPECT_EQ(failure(mercator, {{1, -infinity}}),
              "Position (1, -inf) of 'WGS 84' has no counterpart in 'WGS 84 / Pseudo-Mercator'; " + end);
    CoordinateTransform same(Crs("EPSG:4326"), Crs("EPSG:4326"), {});
    EXPECT_EQ(failure(same, {{infinity, 3}}),
              "Position (inf, 3) of 'WGS 84' has no counterpart in 'WGS 84'; " + end);
}

TEST(CoordinateTransform, RefusesWhatCannotBe) {
    const Crs geographic("EPSG:4326");
    const auto message = [](const Crs& from, const Crs& to) {
        return error_of<OptionError>([&] { CoordinateTransform(from, to, {}); });
    };
    const std::string choose =
        "; choose a coordinate reference system that the coordinates can be converted to.";
    EXPECT_EQ(message(Crs(local_feet), geographic),
              "PROJ has no operation from 'site grid' to 'WGS 84'" + choose);
    EXPECT_EQ(message(geographic, Crs(local_feet)),
              "PROJ has no operation from 'WGS 84' to 'site grid'" + choose);
    EXPECT_EQ(message(Crs(unknown_projection), geographic),
              "PROJ has no operation from 'odd' to 'WGS 84'" + choose);
    EXPECT_EQ(
        message(Crs(), geographic),
        "There is no coordinate reference system to transform from; state which one the coordinates are in.");
    EXPECT_EQ(
        message(geographic, Crs()),
        "There is no coordinate reference system to transform to; state which one the coordinates are in.");
    EXPECT_EQ(
        message(Crs("EPSG:4978"), geographic),
        "'WGS 84' has no plane coordinates to transform from; choose a projected or geographic coordinate "
        "reference system.");
    EXPECT_EQ(
        message(geographic, Crs("EPSG:5709")),
        "'NAP height' has no plane coordinates to transform to; choose a projected or geographic coordinate "
        "reference system.");
}

}  // namespace
}  // namespace d2b
