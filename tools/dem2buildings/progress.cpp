#include "dem2buildings/progress.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "common/run_guarded.hpp"
#include "core/crs.hpp"
#include "core/system/streams.hpp"
#include "core/text.hpp"
#include "dem2buildings/interrupt.hpp"
#include "dem2buildings/spool.hpp"

namespace d2b {
namespace {

constexpr int all_ticks = 40;

/// "1,234"
std::string grouped(std::int64_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t comma = digits.size(); comma > 3;) {
        comma -= 3;
        digits.insert(comma, ",");
    }
    return digits;
}

/// "1,234 buildings"
std::string counted(std::int64_t n, const std::string& noun) {
    return grouped(n) + " " + noun + (n == 1 ? "" : "s");
}

/// Part of the summary that counts objects that are missing in the result or changed: its kind, the noun of
/// the counted objects if the kind does not name them, and further words.
struct Part {
    const char* kind;
    const char* noun;
    const char* words;
    std::vector<Reason> reasons;
};

const std::vector<Part>& parts() {
    static const std::vector<Part> all{
        {"left out", "", "below -min_area", {Reason::building_small, Reason::contour_small}},
        {"left out", "", "below -min_height", {Reason::building_low}},
        {"left out", "", "below -min_building_height", {Reason::building_not_tall}},
        {"left out", "", "below -min_confidence", {Reason::building_doubtful}},
        {"left out", "", "by -corrections", {Reason::building_denied}},
        {"left out", "", "in -exclude", {Reason::building_excluded}},
        {"left out", "", "below -nf", {Reason::contour_short}},
        {"left out", "", "on parts that were left out", {Reason::contour_on_dropped}},
        {"left out", "", "split by -t_srs", {Reason::outline_split}},
        {"left out", "", "beyond repair", {Reason::polygon_lost}},
        {"left out",
         "threshold",
         "without effect",
         {Reason::threshold_not_above_minimum, Reason::threshold_not_below_maximum,
          Reason::threshold_repeated}},
        {"not in the surface", "building", "", {Reason::surface_lost}},
        {"level in the surface",
         "face",
         "of a roof that reaches below the ground",
         {Reason::surface_face_level}},
        {"built of tiers in the surface",
         "building",
         "instead of the planes of its roof",
         {Reason::surface_roof_tiers}},
        {"cut back at walls", "tree crown", "", {Reason::crown_cut}},
        {"cut back at walls", "cell", "", {Reason::crown_cells}},
        {"merged with a neighbour", "part", "cut off by -split_by", {Reason::part_merged}},
        {"filled", "hole", "", {Reason::hole_small, Reason::hole_short}},
        {"drawn differently", "", "as traced", {Reason::outline_kept_traced}},
        {"drawn differently", "", "repaired", {Reason::polygon_repaired}},
        {"moved in the surface",
         "corner",
         "that touched",
         {Reason::surface_notch_filled, Reason::surface_corner_cut}},
        {"changed for a flow solver", "place", "", {Reason::flow_changed}},
        {"left unchanged", "place", "unsuitable for a flow solver", {Reason::flow_unchanged}},
        {"doubtful", "face", "of roofs", {Reason::roof_face_doubtful}},
        {"treated as no data", "cell", "outside -zrange", {Reason::elevation_outside_range}},
        {"treated as no data", "cell", "of undeclared NoData", {Reason::elevation_undeclared_nodata}},
        {"treated as no data", "cell", "blended with NoData", {Reason::elevation_blended}},
        {"treated as no data", "cell", "far above all cells around", {Reason::elevation_spike}},
        {"treated as no data", "cell", "of the terrain", {Reason::terrain_outside_range}},
        {"not a roof", "cell", "far above all cells around", {Reason::roof_spike}},
    };
    return all;
}

/// "3 below -min_area", "1 hole", "2 cells of the terrain"
std::string amount(std::int64_t n, const Part& part) {
    const std::string number = *part.noun == '\0' ? grouped(n) : counted(n, part.noun);
    return number + (*part.words == '\0' ? "" : " ") + part.words;
}

/// Returns counts of missing and changed objects, or "".
std::string counts(const RunReport& report) {
    std::string text;
    std::string kind;
    for (const Part& part : parts()) {
        std::int64_t n = 0;
        for (const Reason reason : part.reasons)
            n += report.counted(reason) - (reason == Reason::building_doubtful ? report.doubtful : 0);
        if (n <= 0)
            continue;
        text += text.empty() ? " (" : kind == part.kind ? ", " : "; ";
        text += (kind == part.kind ? "" : std::string(part.kind) + ": ") + amount(n, part);
        kind = part.kind;
    }
    return text.empty() ? text : text + ")";
}

/// "160 footprints with heights of 163", and why the others have none.
std::string footprints_text(const FootprintReport& report) {
    std::string text = counted(report.measured, "footprint") + " with heights of " + grouped(report.given);
    std::string others;
    for (const auto& [n, words] : {std::pair{report.outside, "outside the raster"},
                                   std::pair{report.without_cell, "smaller than a cell"},
                                   std::pair{report.without_data, "without data"},
                                   std::pair{report.without_polygon, "without a polygon"}})
        if (n > 0)
            others += (others.empty() ? "" : ", ") + grouped(n) + " " + words;
    return text + (others.empty() ? "" : " (" + others + ")");
}

}  // namespace

TerminalProgress::~TerminalProgress() {
    if (line_is_open())
        out_ << std::endl;
}

bool TerminalProgress::line_is_open() const {
    return line_begun_ && ticks_ < all_ticks;
}

void TerminalProgress::update(double share) {
    const std::lock_guard lock(mutex_);
    const int ticks = static_cast<int>(std::clamp(share, 0.0, 1.0) * all_ticks);
    while (ticks_ < ticks) {
        ++ticks_;
        line_begun_ = true;
        if (ticks_ % 4 == 0)
            out_ << ticks_ / 4 * 10;
        else
            out_ << '.';
        if (ticks_ == all_ticks)
            out_ << " - done.\n";
    }
    out_.flush();
}

void TerminalProgress::interrupt(bool shared, const std::function<void()>& say) {
    const std::lock_guard lock(mutex_);
    if (shared && line_is_open()) {
        out_ << std::endl;
        line_begun_ = false;
    }
    say();
}

std::string summary(const RunReport& report, Layers layers, const std::string& destination) {
    std::vector<std::string> written;
    if (report.footprints)
        written.push_back(footprints_text(*report.footprints));
    else if (layers != Layers::contours)
        written.push_back(counted(report.buildings, "building"));
    if (layers != Layers::buildings)
        written.push_back(counted(report.contours, "contour"));
    if (report.footprints && layers != Layers::buildings)
        written.push_back(counted(report.footprints->missing, "building") + " without a footprint");
    if (report.roofs)
        written.push_back(counted(report.roofs->faces(), "face") + " of roofs");
    std::string text;
    for (std::size_t i = 0; i < written.size(); ++i)
        text += (i == 0 ? "" : i + 1 < written.size() ? ", " : " and ") + written[i];
    return text + " in " + destination + counts(report) + "\n";
}

namespace {

/// Hint at the coordinates of a GeoJSON, which the standard wants in WGS 84.
std::string coordinates_advice(const RunReport& report, const Options& options) {
    const std::string& target = options.outline.target_crs;
    const bool json = to_lower(options.write.destination).ends_with(".geojson") ||
                      to_lower(options.write.format) == "geojson";
    const bool degrees = target.empty() ? report.crs.empty() || report.units.horizontal == "degree"
                                        : Crs(target).kind() == Crs::Kind::geographic;
    const auto reprojects = [](const std::string& option) { return to_lower(option) == "rfc7946=yes"; };
    if (!json || degrees || std::ranges::any_of(options.write.layer_options, reprojects))
        return "";
    return "The GeoJSON has projected coordinates, but most programs expect degrees: -t_srs "
           "EPSG:4326 writes degrees.\n";
}

/// Names the options that would improve many buildings. Uneven ones count by their area too, because few
/// large blocks may be most of a city.
std::string buildings_advice(const RunReport& report, const Options& options) {
    constexpr std::int64_t one_in = 20;
    constexpr double some_of_the_area = 0.05;
    constexpr double much_of_the_area = 0.1;
    if (options.preset != Preset::buildings || report.buildings == 0)
        return "";
    const auto many = [&](std::int64_t some) { return some > 0 && some * one_in >= report.buildings; };
    const std::string of_all = " of " + counted(report.buildings, "building");
    const double share = report.uneven_m2 / report.buildings_m2;
    std::string text;
    if (options.detect.split_height == 0 &&
        share >= (many(report.uneven) ? some_of_the_area : much_of_the_area))
        text += grouped(report.uneven) + of_all + " (" + fixed_text(share * 100, 0) + " % of their area)" +
                (report.uneven == 1 ? " differs" : " differ") +
                " by more than 5 m inside: -split_height 3 divides " +
                (report.uneven == 1 ? "it.\n" : "them.\n");
    if (many(report.uncertain))
        text += grouped(report.uncertain) + of_all + (report.uncertain == 1 ? " has" : " have") +
                " a confidence below 0.9: -min_confidence 0.9 -write_doubtful writes " +
                (report.uncertain == 1 ? "it" : "them") + " to a separate layer.\n";
    return text;
}

}  // namespace

std::string advice(const RunReport& report, const Options& options) {
    return buildings_advice(report, options) + coordinates_advice(report, options);
}

Callbacks terminal_callbacks(TerminalProgress& progress, bool quiet) {
    Callbacks callbacks;
    const bool terminal = system::are_terminals();
    callbacks.on_warning = [&progress, terminal](const std::string& text) {
        progress.interrupt(terminal, [&] { print_line("Warning: ", text); });
    };
    callbacks.on_progress = [&progress, quiet](double share) {
        if (!quiet)
            progress.update(share);
        return !interrupted();
    };
    callbacks.make_spool = [] { return std::make_unique<FileSpool>(); };
    callbacks.stop = interrupted;
    return callbacks;
}

}  // namespace d2b
