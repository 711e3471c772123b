#include "options/preset.hpp"

#include <cmath>
#include <string>

#include "core/number_text.hpp"
#include "dem2buildings/error.hpp"

namespace d2b {
namespace {

template <typename Choice>
void choose(Choice& choice, Choice preset) {
    if (choice == Choice::by_preset)
        choice = preset;
}

/// What looks for buildings has nothing to do where everything above a threshold is one.
void refuse_detection(const Options& options) {
    const DetectOptions& detect = options.detect;
    const DetectOptions standard;
    const WriteOptions& write = options.write;
    const auto refuse = [](const char* option) {
        throw OptionError(
            std::string("-") + option +
            " has no effect with -preset thesis; it detects no buildings, so leave one of them out.");
    };
    if (options.ground.mode == GroundMode::automatic || options.ground.mode == GroundMode::given)
        refuse("ground");
    if (options.ground.max_building_width != GroundOptions{}.max_building_width)
        refuse("max_building_width");
    if (options.levels.source == LevelSource::building)
        refuse("levels building");
    if (options.levels.source == LevelSource::natural)
        refuse("levels natural");
    if (options.levels.detail > 0)
        refuse("detail");
    if (!detect.mask.empty())
        refuse("mask");
    if (!detect.ndvi.empty())
        refuse("ndvi");
    if (detect.split_height > 0)
        refuse("split_height");
    if (detect.min_height != standard.min_height)
        refuse("min_height");
    if (detect.min_confidence != standard.min_confidence)
        refuse("min_confidence");
    if (write.doubtful)
        refuse("write_doubtful");
    if (!write.ground.empty())
        refuse("write_ground");
    if (!write.height.empty())
        refuse("write_height");
    if (!write.canopy.empty())
        refuse("write_canopy");
}

/// Beyond this many intervals thresholds would be off by a thousandth of one and more, or be the same.
void refuse_far_offset(const LevelOptions& levels) {
    constexpr double most_intervals = 0x1p43;
    if (levels.interval && !(std::abs(levels.offset) <= most_intervals * *levels.interval))
        throw OptionError("-off " + number_text(levels.offset) + " is too far away to count intervals of " +
                          number_text(*levels.interval) + " from; give a base near the elevations.");
}

/// What stands in layers that are not written.
void refuse_for_layers(const Options& options) {
    const WriteOptions& write = options.write;
    if (options.outline.disjoint && write.layers == Layers::buildings)
        throw OptionError(
            "-disjoint has no effect where the buildings alone are written; use -layers contours, "
            "or a format that holds both layers, such as GeoPackage.");
    if (write.fields != FieldNames::own && write.layers == Layers::contours && !write.doubtful)
        throw OptionError(
            "-fields has no effect where the contours alone are written; only fields of buildings "
            "have other names.");
}

}  // namespace

bool detects_buildings(const Options& options) {
    return options.preset == "buildings";
}

Options with_preset(Options options) {
    const bool detects = detects_buildings(options);
    if (!detects && options.preset != "thesis")
        throw OptionError("There is no preset '" + options.preset + "'; choose buildings or thesis.");
    if (!detects)
        refuse_detection(options);
    refuse_far_offset(options.levels);
    refuse_for_layers(options);
    const bool simplifies = options.outline.simplify > 0;
    if (simplifies && options.outline.walls != Walls::by_preset && options.outline.walls != Walls::off)
        throw OptionError(
            "-simplify cannot be used together with -regularize; straight walls need no simplification.");
    choose(options.ground.mode, detects ? GroundMode::automatic : GroundMode::none);
    choose(options.levels.source, detects ? LevelSource::building : LevelSource::global);
    choose(options.trace.mode, detects ? TraceMode::cells : TraceMode::points);
    choose(options.outline.walls, detects && !simplifies ? Walls::automatic : Walls::off);
    if (detects && !options.filter.keep_footprints) {  // not done yet
        options.detect.min_area_m2 = options.filter.min_area_m2.value_or(options.detect.min_area_m2);
        options.filter.min_area_m2 = 0;
        options.filter.keep_footprints = true;
    }
    options.filter.min_area_m2 = options.filter.min_area_m2.value_or(0);
    return options;
}

}  // namespace d2b
