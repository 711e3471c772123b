#include "pipeline/trace_contours.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/stage_clock.hpp"
#include "detect/one_label.hpp"
#include "levels/quantise.hpp"

namespace d2b {
namespace {

/// What of a run all bands are traced with.
struct Tracing {
    const TraceFrame& frame;
    const TierImage& image;
    TraceMode mode;
};

LabelBand labels_of(const ElevationBand& band, const Tracing& tracing) {
    Context none;
    const FoundBuildings* found = tracing.image.found;
    return found == nullptr ? detect_one_label(band, none) : found->band(band.shape);
}

template <typename Count>
PointRows<Count> point_rows(const std::shared_ptr<const ElevationBand>& elevations, const Tracing& tracing) {
    PointRows<Count> rows;
    rows.labels = labels_of(*elevations, tracing);
    std::optional<ElevationBand> clean;
    if (tracing.image.clean != nullptr)
        clean = tracing.image.clean->clean(*elevations);
    rows.levels = quantise<Count>(clean ? *clean : *elevations, rows.labels, tracing.image.plan);
    rows.elevations = elevations;
    return rows;
}

/// Bands are taken apart on all threads, each with the rows above it that it needs, which it counts again;
/// what is found goes through the tracer in order.
template <typename Count>
void trace_bands(ElevationReader& reader, const Tracing& tracing, ContourSink& sink, Context& context) {
    const TraceFrame& frame = tracing.frame;
    Tracer tracer(frame, tracing.mode, sink);
    reader.for_each_below(
        rows_above(tracing.mode),
        [&](ElevationBand above, const ElevationBand& elevations, Tally& tally) {
            PointRows<Count> before;
            PointRows<Count> band;
            {
                const StageClock clock(tally, Stage::levels);
                before = point_rows<Count>(std::make_shared<ElevationBand>(std::move(above)), tracing);
                const std::shared_ptr<const ElevationBand> borrowed(std::shared_ptr<void>(), &elevations);
                band = point_rows<Count>(borrowed, tracing);
            }
            const StageClock clock(tally, Stage::trace);
            return take_apart(frame, tracing.mode, before, band);
        },
        [&](const ElevationBand& band, std::vector<TraceLine> lines) {
            {
                const StageClock clock(context.report, Stage::trace);
                tracer.trace(std::move(lines));
            }
            context.progress(static_cast<double>(band.shape.first_row + band.shape.rows - frame.window.row) /
                             frame.window.rows);
        });
}

}  // namespace

std::unique_ptr<StoredContours> trace_contours(ElevationReader& reader, const TraceFrame& frame,
                                               const TierImage& image, const RunPlan& plan,
                                               const SquareArea& area, double metres, Context& context) {
    const NoiseRules noise{plan.asked.filter.noise_factor, plan.contour_m2, plan.detects_buildings()};
    // Footprints that were found stand on nothing.
    HeightRules heights;
    if (image.found != nullptr)
        heights = {plan.asked.detect.min_building_height, image.found->ground, metres};
    ContourStore store(
        {noise, area, frame.range, frame.fixed, image.found == nullptr, plan.asked.write.rejected, heights},
        context.make_spool(), context);
    const Tracing tracing{frame, image, plan.trace};
    if (image.plan.level_count() <= std::numeric_limits<std::uint8_t>::max())
        trace_bands<std::uint8_t>(reader, tracing, store, context);
    else
        trace_bands<std::uint16_t>(reader, tracing, store, context);
    const StageClock clock(context.report, Stage::filter);
    return store.finish();
}

}  // namespace d2b
