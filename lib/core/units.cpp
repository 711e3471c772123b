#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

constexpr double foot = 0.3048;
constexpr double survey_foot = 1200.0 / 3937.0;

struct KnownUnit {
    std::string_view alias;
    std::string_view name;
    double metres;
};

constexpr std::array known_units{
    KnownUnit{"m", "metre", 1},
    KnownUnit{"metre", "metre", 1},
    KnownUnit{"metres", "metre", 1},
    KnownUnit{"meter", "metre", 1},
    KnownUnit{"meters", "metre", 1},
    KnownUnit{"ft", "foot", foot},
    KnownUnit{"foot", "foot", foot},
    KnownUnit{"feet", "foot", foot},
    KnownUnit{"international foot", "foot", foot},
    KnownUnit{"us-ft", "US survey foot", survey_foot},
    KnownUnit{"ftus", "US survey foot", survey_foot},
    KnownUnit{"us_survey_foot", "US survey foot", survey_foot},
    KnownUnit{"us survey foot", "US survey foot", survey_foot},
    KnownUnit{"us survey feet", "US survey foot", survey_foot},
    KnownUnit{"foot_us", "US survey foot", survey_foot},
    KnownUnit{"yd", "yard", 3 * foot},
    KnownUnit{"yard", "yard", 3 * foot},
    KnownUnit{"yards", "yard", 3 * foot},
    KnownUnit{"centimetre", "centimetre", 0.01},
    KnownUnit{"centimetres", "centimetre", 0.01},
    KnownUnit{"centimeter", "centimetre", 0.01},
    KnownUnit{"centimeters", "centimetre", 0.01},
    KnownUnit{"decimetre", "decimetre", 0.1},
    KnownUnit{"decimeter", "decimetre", 0.1},
    KnownUnit{"millimetre", "millimetre", 0.001},
    KnownUnit{"millimeter", "millimetre", 0.001},
    KnownUnit{"cm", "centimetre", 0.01},
    KnownUnit{"dm", "decimetre", 0.1},
    KnownUnit{"mm", "millimetre", 0.001},
    KnownUnit{"km", "kilometre", 1000},
};

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

void set_vertical(UnitReport& report, const LengthUnit& unit, std::string decided_by) {
    report.vertical = unit.name;
    report.vertical_metres = unit.metres;
    report.vertical_decided_by = std::move(decided_by);
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
    }
}

}  // namespace

std::optional<LengthUnit> parse_length_unit(std::string_view text) {
    const std::string name = lower(text);
    const auto* known = std::find_if(known_units.begin(), known_units.end(),
                                     [&](const KnownUnit& unit) { return unit.alias == name; });
    if (known != known_units.end())
        return LengthUnit{std::string(known->name), known->metres};
    double metres = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), metres);
    if (error != std::errc{} || end != name.data() + name.size() || !std::isfinite(metres) || metres <= 0)
        return {};
    return LengthUnit{std::string(text) + " m", metres};
}

std::optional<LengthUnit> stated_unit(const std::string& band_unit, const std::string& raster,
                                      const std::string& option) {
    constexpr std::array<std::string_view, 4> none{"", "unknown", "unspecified", "none"};
    if (std::ranges::find(none, lower(band_unit)) != none.end())
        return {};
    if (auto unit = parse_length_unit(band_unit))
        return unit;
    throw InputError(
        "The unit of " + raster + " is '" + band_unit +
        "', which is no known unit of length; if the values are elevations, give their unit with " + option +
        ", for example " + option + " m.");
}

UnitReport resolve_units(const DemInfo& info, const Crs& crs, std::string_view vertical_option) {
    UnitReport report;
    if (const auto horizontal = crs.horizontal_unit()) {
        report.horizontal = horizontal->name;
        report.horizontal_metres = horizontal->metres;
        report.horizontal_decided_by = "CRS";
    } else if (crs.kind() == Crs::Kind::geographic) {
        report.horizontal = "degree";
        report.horizontal_metres = 0;
        report.horizontal_decided_by = "CRS";
    } else {
        report.horizontal = "unknown";
        report.horizontal_decided_by = "assumption: 1 unit is 1 m";
    }
    report.areas = crs.on_ellipsoid() ? "geodesic" : "planar";
    resolve_vertical(report, info, crs, vertical_option);
    return report;
}

}  // namespace d2b
