#include "core/units.hpp"

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

DemInfo with_band_unit(std::string unit) {
    DemInfo info;
    info.band_unit = std::move(unit);
    return info;
}

TEST(Units, NamesAndNumbers) {
    EXPECT_EQ(parse_length_unit("m")->metres, 1);
    EXPECT_EQ(parse_length_unit("Metre")->name, "metre");
    EXPECT_EQ(parse_length_unit("FT")->metres, 0.3048);
    EXPECT_EQ(parse_length_unit("US survey foot")->metres, 1200.0 / 3937.0);
    EXPECT_EQ(parse_length_unit("us-ft")->metres, 1200.0 / 3937.0);
    EXPECT_EQ(parse_length_unit("0.5")->metres, 0.5);
    for (const char* text : {"", "furlong", "-1", "0", "nan", "inf", "1 m", "1,5"})
        EXPECT_FALSE(parse_length_unit(text)) << text;
}

// Each test takes the winner away: option, band, vertical CRS, horizontal unit, metres.
TEST(Units, OptionWinsOverBand) {
    const UnitReport report = resolve_units(with_band_unit("m"), Crs("EPSG:7415"), "us-ft");
    EXPECT_EQ(report.vertical, "US survey foot");
    EXPECT_EQ(report.vertical_decided_by, "-zunit");
}

TEST(Units, BandWinsOverTheCrs) {
    const UnitReport report = resolve_units(with_band_unit("metre"), Crs("EPSG:2253"), "");
    EXPECT_EQ(report.horizontal, "foot");
    EXPECT_EQ(report.horizontal_metres, 0.3048);
    EXPECT_EQ(report.vertical, "metre");
    EXPECT_EQ(report.vertical_decided_by, "unit of the band");
}

TEST(Units, VerticalCrsWinsOverTheHorizontalUnit) {
    // Michigan South in feet with NAVD88 heights in metres.
    const UnitReport report = resolve_units(with_band_unit(""), Crs("EPSG:2253+5703"), "");
    EXPECT_EQ(report.horizontal_metres, 0.3048);
    EXPECT_EQ(report.vertical_metres, 1);
    EXPECT_EQ(report.vertical_decided_by, "vertical CRS");
}

TEST(Units, HorizontalUnitIsNext) {
    const UnitReport report = resolve_units(with_band_unit("unknown"), Crs("EPSG:2253"), "");
    EXPECT_EQ(report.vertical_metres, 0.3048);
    EXPECT_EQ(report.vertical_decided_by, "horizontal unit of the CRS");
}

TEST(Units, MetresAreTheLastResort) {
    const UnitReport report = resolve_units(with_band_unit(""), Crs("EPSG:4326"), "");
    EXPECT_EQ(report.horizontal, "degree");
    EXPECT_EQ(report.vertical, "metre");
    EXPECT_EQ(report.vertical_decided_by, "assumption");
    EXPECT_EQ(report.areas, "geodesic");
    EXPECT_EQ(resolve_units(with_band_unit(""), Crs(), "").areas, "planar");
    EXPECT_EQ(resolve_units(with_band_unit(""), Crs(), "").horizontal, "unknown");
}

TEST(Units, WhatIsNoLengthIsRefusedUnlessTheOptionSaysWhatItIs) {
    for (const char* unit : {"K", "dBZ", "%", "furlong"}) {
        DemInfo info = with_band_unit(unit);
        info.name = "dem.tif";
        try {
            static_cast<void>(resolve_units(info, Crs("EPSG:25832"), ""));
            FAIL();
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(),
                      "The unit of 'dem.tif' is '" + std::string(unit) +
                          "', which is no known unit of length; if the values are elevations, give "
                          "their unit with -zunit, for example -zunit m.");
        }
        EXPECT_EQ(resolve_units(info, Crs("EPSG:25832"), "ft").vertical, "foot");
    }
}

TEST(Units, AnUnknownOptionIsAnError) {
    try {
        static_cast<void>(resolve_units(with_band_unit(""), Crs(), "cubit"));
        FAIL();
    } catch (const OptionError& error) {
        EXPECT_STREQ(error.what(), "-zunit must be m, ft, us-ft or the metres in one unit, not 'cubit'.");
    }
}

}  // namespace
}  // namespace d2b
