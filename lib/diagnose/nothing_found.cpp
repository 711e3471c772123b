#include "diagnose/nothing_found.hpp"

#include <array>
#include <functional>

#include "core/number_text.hpp"
#include "diagnose/ground_doubt.hpp"
#include "diagnose/place_doubt.hpp"

namespace d2b {
namespace {

/// Option that rejects objects, and their number.
struct Sieve {
    const char* option;
    double value;
    double standard;
    std::int64_t objects;
};

std::array<Sieve, 4> sieves(const Search& search) {
    const DetectOptions& detect = search.plan.asked.detect;
    const DetectOptions standard;
    const Tally& tally = search.tally;
    return {
        {{"-min_area", search.plan.building_m2, smallest_building_m2, tally.counted(Reason::building_small)},
         {"-min_height", detect.min_height, standard.min_height, tally.counted(Reason::building_low)},
         {"-min_building_height", detect.min_building_height, standard.min_building_height,
          tally.counted(Reason::building_not_tall)},
         {"-min_confidence", detect.min_confidence, standard.min_confidence,
          tally.counted(Reason::building_doubtful)}}};
}

/// @param stricter true: only options stricter than their defaults
std::string left_out(const Search& search, bool stricter) {
    std::string text;
    for (const Sieve& sieve : sieves(search))
        if (sieve.objects > 0 && (!stricter || sieve.value > sieve.standard))
            text += (text.empty() ? "" : ", ") + std::string(sieve.option) + " " + number_text(sieve.value) +
                    " leaves " + std::to_string(sieve.objects) + " out";
    return text.empty() ? text : text + "; a smaller value may show them";
}

}  // namespace

std::string search_ground_doubt(const Search& search) {
    const GroundMode mode = search.plan.ground;
    if (std::string text = missing_ground_doubt(search.islands, mode, search.dem.name); !text.empty())
        return text;
    // A raster with NoData as ground contains roofs alone, whose heights are those of buildings.
    if (mode == GroundMode::none && search.islands.narrow_most())
        return {};
    return ground_doubt(search.fit, mode, search.plan.asked.ground.terrain);
}

std::string why_nothing_was_found(const Search& search) {
    const DemInfo& dem = search.dem;
    const DetectOptions& detect = search.plan.asked.detect;
    // The most frequent reason comes first.
    const std::array<std::function<std::string()>, 9> causes{
        [&] { return empty_side_doubt(search.sides, search.plan.asked); },
        [&] { return picture_doubt(dem); },
        [&] { return degrees_doubt(dem, search.has_crs); },
        [&] {
            return extent_doubt(dem.name, dem.window.cols * search.cell.across,
                                dem.window.rows * search.cell.down * search.cell.sine);
        },
        [&] { return search_ground_doubt(search); },
        [&] { return left_out(search, true); },
        [&] { return surface_doubt(search.fit, dem.name); },
        [&] { return slope_doubt(search.slope, dem.name); },
        [&] { return left_out(search, false); },
    };
    for (const auto& cause : causes)
        if (std::string text = cause(); !text.empty())
            return text;
    return "nothing that rises by more than " + number_text(detect.min_height) +
           " m above the ground is as smooth and wide as a roof; cells should be at most 1 m wide, or 2.5 m "
           "for large buildings, and -write_canopy shows everything that rises";
}

}  // namespace d2b
