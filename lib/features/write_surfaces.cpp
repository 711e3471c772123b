#include "features/write_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "attributes/attribute_table.hpp"
#include "core/stage_clock.hpp"
#include "features/problem_layer.hpp"
#include "features/surface_problems.hpp"
#include "geometry/geos.hpp"

namespace d2b {
namespace {

constexpr std::int64_t most_lost_named = 10;

/// What a thread needs of its own.
struct SurfaceRoom {
    std::optional<RingTransform> transform;
    Geos geos;
    Tally tally{};
};

/// What was made of a group.
struct GroupSurfaces {
    MadeSurfaces made;
    std::vector<LostBuilding> lost;
    std::vector<PlacedProblem> problems;  // where they are asked for
};

/// @param records by ascending ids
void fill_values(const std::vector<BuildingRecord>& records, std::vector<SurfacePart>& parts) {
    for (SurfacePart& part : parts)
        for (SurfaceBuilding& building : part.buildings) {
            const auto record = std::ranges::lower_bound(records, building.id, {}, &BuildingRecord::id);
            building.values = field_values(building_attributes(), *record);
        }
}

class SurfaceWriter {
  public:
    SurfaceWriter(const SurfaceInput& input, std::span<SurfaceSink* const> sinks, Context& context);

    [[nodiscard]] GroupSurfaces make(std::span<const std::uint32_t> group, std::size_t thread);
    void add(GroupSurfaces&& group);
    void finish();

  private:
    void count(const MadeSurfaces& made);
    void warn_of_lost(const std::vector<LostBuilding>& lost);

    const SurfaceInput& input_;
    std::span<SurfaceSink* const> sinks_;
    Context& context_;
    SurfaceForms forms_;
    std::vector<SurfaceRoom> rooms_;
    SurfaceReport report_;
    std::int64_t lost_ = 0;
};

SurfaceWriter::SurfaceWriter(const SurfaceInput& input, std::span<SurfaceSink* const> sinks, Context& context)
    : input_(input), sinks_(sinks), context_(context) {
    for (const SurfaceSink* sink : sinks)
        (sink->form() == SurfaceForm::solids ? forms_.solids : forms_.shell) = true;
    const FeatureInput& features = input.features;
    const SurfaceFrame& frame = input.lattice.frame();
    forms_.pinch_steps = std::llround(features.plan.asked.outline.shortest_wall() /
                                      (std::min(frame.scale[0], frame.scale[1]) * frame.horizontal_metres));
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        rooms_.push_back({output_transform(features.crs, features.target_crs, features.georeference,
                                           features.window, context.threads->stop()),
                          Geos(context.threads->stop())});
    report_.origin = input.lattice.frame().origin;
}

GroupSurfaces SurfaceWriter::make(std::span<const std::uint32_t> group, std::size_t thread) {
    SurfaceRoom& room = rooms_[thread];
    const StageClock clock(room.tally, Stage::surface);
    DrawnCluster drawn = draw_cluster(input_, group, room.transform);
    GroupSurfaces result;
    result.made = make_surfaces(drawn.cluster, forms_,
                                [&](const FinePolygon& polygon) { return room.geos.triangles(polygon); });
    fill_values(drawn.buildings, result.made.solids);
    fill_values(drawn.buildings, result.made.shell);
    result.lost = std::move(drawn.lost);
    add_left_out(drawn, result.made, result.lost);
    std::ranges::sort(result.lost, {}, &LostBuilding::id);
    if (input_.problems != nullptr)
        result.problems = surface_problems(drawn.cluster, result.made, result.lost, input_.lattice.frame());
    return result;
}

void SurfaceWriter::count(const MadeSurfaces& made) {
    for (const PinchMend& mend : made.mends)
        context_.report.count(mend.filled ? Reason::surface_notch_filled : Reason::surface_corner_cut);
    for (const SurfacePart& part : made.shell) {
        ++report_.blocks;
        report_.points += static_cast<std::int64_t>(part.points.size());
        for (const SurfaceBuilding& building : part.buildings)
            report_.triangles += static_cast<std::int64_t>(building.triangles.size());
    }
    for (const SurfacePart& part : forms_.shell ? made.shell : made.solids)
        report_.buildings += static_cast<std::int64_t>(part.buildings.size());
}

void SurfaceWriter::warn_of_lost(const std::vector<LostBuilding>& lost) {
    for (const LostBuilding& building : lost)
        if (++lost_ <= most_lost_named)
            context_.warn("Building " + std::to_string(building.id) +
                          " is not in the surface: it has no height above its ground, or no closed surface "
                          "was found for it.");
    context_.report.count(Reason::surface_lost, static_cast<std::int64_t>(lost.size()));
}

void SurfaceWriter::add(GroupSurfaces&& group) {
    count(group.made);
    warn_of_lost(group.lost);
    if (input_.problems != nullptr)
        input_.problems->note(std::move(group.problems));
    const StageClock clock(context_.report, Stage::write);
    for (SurfaceSink* sink : sinks_) {
        for (const SurfacePart& part :
             sink->form() == SurfaceForm::solids ? group.made.solids : group.made.shell)
            sink->add(part);
        sink->end_group();
    }
}

void SurfaceWriter::finish() {
    if (lost_ > most_lost_named)
        context_.warn(std::to_string(lost_ - most_lost_named) + " more buildings are not in the surface.");
    for (SurfaceRoom& room : rooms_)
        context_.report.merge(room.tally);
    context_.report.surface = report_;
}

}  // namespace

SurfaceMeta surface_meta(const RunPlan& plan, const SurfaceLattice& lattice, const Crs& written,
                         const UnitReport& units) {
    const bool tiers = plan.surface_of == SurfaceOf::contours || plan.asked.detect.split_height > 0;
    return {lattice.frame(),
            tiers ? "1.3" : "1.2",
            field_specs(building_attributes(), units.vertical, plan.asked.write.fields),
            units.vertical_is_known ? units.vertical : "",
            {written.wkt(), {}}};
}

void write_surfaces(const SurfaceInput& input, SurfaceMeta meta, std::span<SurfaceSink* const> sinks,
                    Context& context) {
    meta.provenance.metadata = input.features.provenance.metadata;
    for (SurfaceSink* sink : sinks)
        sink->begin(meta);
    const auto groups = input.features.outliner.groups(context.threads->stop());
    SurfaceWriter writer(input, sinks, context);
    context.threads->in_order(
        groups.size(), [&](std::size_t i, std::size_t thread) { return writer.make(groups[i], thread); },
        [&](std::size_t i, GroupSurfaces made) {
            writer.add(std::move(made));
            context.progress(static_cast<double>(i) / static_cast<double>(groups.size()));
        });
    writer.finish();
}

}  // namespace d2b
