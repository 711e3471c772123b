#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/number_from_chars.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

constexpr double foot = 0.3048;
constexpr double survey_foot = 1200.0 / 3937.0;

struct KnownUnit {
    std::string_view name;
    double metres;
    std::array<std::string_view, 6> aliases;  ///< in lower case
};

constexpr std::array known_units{
    KnownUnit{"metre", 1, {"m", "metre", "metres", "meter", "meters"}},
    KnownUnit{"foot", foot, {"ft", "foot", "feet", "international foot"}},
    KnownUnit{"US survey foot",
              survey_foot,
              {"us-ft", "ftus", "us_survey_foot", "us survey foot", "us survey feet", "foot_us"}},
    KnownUnit{"yard", 3 * foot, {"yd", "yard", "yards"}},
    KnownUnit{"centimetre", 0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}},
    KnownUnit{"decimetre", 0.1, {"dm", "decimetre", "decimeter"}},
    KnownUnit{"millimetre", 0.001, {"mm", "millimetre", "millimeter"}},
    KnownUnit{"kilometre", 1000, {"km"}},
};

void set_vertical(UnitReport& report, const LengthUnit& unit, std::string decided_by) {
    report.vertical = unit.name;
    report.vertical_metres = unit.metres;
    report.vertical_source = std::move(decided_by);
}

void resolve_vertical(UnitReport& report, const DemInfo& info, const Crs& crs, std::string_view option) {
    if (!option.empty()) {
        const auto unit = parse_length_unit(option);
        if (!unit)
            throw OptionError("-zunit must be m, ft, us-ft or the metres in one unit, not '" +
                              std::string(option) + "'.");
        set_vertical(report, *unit, "-zunit");
    } else if (const auto band = stated_unit(info.band_unit, "'" + info.name + "'", "-zunit")) {
        set_vertical(report, *band, "unit of the band");
    } else if (const auto vertical = crs.vertical_unit()) {
        set_vertical(report, *vertical, "vertical CRS");
    } else if (const auto horizontal = crs.horizontal_unit()) {
        set_vertical(report, *horizontal, "horizontal unit of the CRS");
    } else {
        set_vertical(report, {"metre", 1}, "assumption");
        report.vertical_is_known = false;
    }
}

}  // namespace

std::optional<LengthUnit> parse_length_unit(std::string_view text) {
    const std::string name = to_lower(text);
    const auto* known = std::find_if(known_units.begin(), known_units.end(), [&](const KnownUnit& unit) {
        return std::ranges::find(unit.aliases, name) != unit.aliases.end();
    });
    if (!name.empty() && known != known_units.end())
        return LengthUnit{std::string(known->name), known->metres};
    const std::optional<double> metres = parse_number<double>(name);
    if (!metres || !std::isfinite(*metres) || *metres <= 0)
        return {};
    return LengthUnit{std::string(text) + " m", *metres};
}

std::optional<LengthUnit> stated_unit(const std::string& band_unit, const std::string& raster,
                                      const std::string& option) {
    constexpr std::array<std::string_view, 4> none{"", "unknown", "unspecified", "none"};
    if (std::ranges::find(none, to_lower(band_unit)) != none.end())
        return {};
    if (auto unit = parse_length_unit(band_unit))
        return unit;
    throw InputError(
        "The unit of " + raster + " is '" + band_unit +
        "', which is not a known unit of length; if the values are elevations, give their unit with " +
        option + ", for example " + option + " m.");
}

UnitReport resolve_units(const DemInfo& info, const Crs& crs, std::string_view vertical_option) {
    UnitReport report;
    if (const auto horizontal = crs.horizontal_unit()) {
        report.horizontal = horizontal->name;
        report.horizontal_metres = horizontal->metres;
        report.horizontal_source = "CRS";
    } else if (crs.kind() == Crs::Kind::geographic) {
        report.horizontal = "degree";
        report.horizontal_metres = 0;
        report.horizontal_source = "CRS";
    } else {
        report.horizontal = "unknown";
        report.horizontal_source = "assumption: 1 unit is 1 m";
    }
    report.areas = crs.on_ellipsoid() ? "geodesic" : "planar";
    resolve_vertical(report, info, crs, vertical_option);
    return report;
}

}  // namespace d2b
