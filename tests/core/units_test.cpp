#include "core/units.hpp"

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "support/error_of.hpp"

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

/// Of the option, the unit of the band, the vertical CRS, the horizontal unit and metres the first that is
/// known decides.
TEST(Units, TheFirstSourceThatKnowsDecides) {
    struct Case {
        const char *option, *band, *crs, *vertical, *decided_by;
    };
    // 2253 is Michigan South in feet, 5703 are NAVD88 heights in metres.
    for (const Case& c : {Case{"us-ft", "m", "EPSG:7415", "US survey foot", "-zunit"},
                          Case{"", "metre", "EPSG:2253", "metre", "unit of the band"},
                          Case{"", "", "EPSG:2253+5703", "metre", "vertical CRS"},
                          Case{"", "unknown", "EPSG:2253", "foot", "horizontal unit of the CRS"},
                          Case{"", "", "EPSG:4326", "metre", "assumption"}}) {
        const UnitReport report = resolve_units(with_band_unit(c.band), Crs(c.crs), c.option);
        EXPECT_EQ(report.vertical, c.vertical);
        EXPECT_EQ(report.vertical_metres, parse_length_unit(c.vertical)->metres);
        EXPECT_EQ(report.vertical_source, c.decided_by);
    }
    EXPECT_EQ(resolve_units(with_band_unit(""), Crs("EPSG:2253+5703"), "").horizontal_metres, 0.3048);
    const UnitReport degrees = resolve_units(with_band_unit(""), Crs("EPSG:4326"), "");
    EXPECT_EQ(degrees.horizontal + " " + degrees.areas, "degree geodesic");
    const UnitReport unknown = resolve_units(with_band_unit(""), Crs(), "");
    EXPECT_EQ(unknown.horizontal + " " + unknown.areas, "unknown planar");
}

TEST(Units, WhatIsNoLengthIsRefusedUnlessTheOptionSaysWhatItIs) {
    for (const char* unit : {"K", "dBZ", "%", "furlong"}) {
        DemInfo info = with_band_unit(unit);
        info.name = "dem.tif";
        EXPECT_EQ(test::error_of<InputError>(
                      [&] { static_cast<void>(resolve_units(info, Crs("EPSG:25832"), "")); }),
                  "The unit of 'dem.tif' is '" + std::string(unit) +
                      "', which is not a known unit of length; if the values are elevations, give their unit "
                      "with -zunit, for example -zunit m.");
        EXPECT_EQ(resolve_units(info, Crs("EPSG:25832"), "ft").vertical, "foot");
    }
}

TEST(Units, AnUnknownOptionIsAnError) {
    EXPECT_EQ(test::error_of<OptionError>(
                  [&] { static_cast<void>(resolve_units(with_band_unit(""), Crs(), "cubit")); }),
              "-zunit must be m, ft, us-ft or the metres in one unit, not 'cubit'.");
}

}  // namespace
}  // namespace d2b
