#include "features/problem_layer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <span>
#include <string>

#include "features/attribute_table.hpp"

namespace d2b::features {

void ProblemLayer::note(std::vector<PlacedProblem> problems) {
    std::ranges::move(problems, std::back_inserter(problems_));
}

void ProblemLayer::write(FeatureSink& sink, Context& context) const {
    if (!layer_) {
        if (!problems_.empty())
            context.warn("-write_problems: the format holds one layer, which has no room for " +
                         std::to_string(problems_.size()) +
                         (problems_.size() == 1 ? " problem" : " problems") + "; write a GeoPackage.");
        return;
    }
    const StageClock clock(context.report, Stage::write);
    std::int64_t id = sink.first_id();
    for (const PlacedProblem& problem : problems_) {
        ProblemRecord record = problem.record;
        record.id = id++;
        sink.add(*layer_, {field_values(problem_attributes(), record), {}, 0, record, problem.place});
    }
}

namespace {

std::string_view kind_of(Reason reason) {
    return reason_names[static_cast<std::size_t>(reason)];
}

Position position_of(FinePoint point, const SurfaceFrame& frame) {
    const auto at = frame.coordinates({point.col, -point.row, 0});
    return {at[0], at[1]};
}

/// Sets the first two buildings that the contours belong to, by id.
ProblemRecord between_buildings(std::span<const std::int32_t> contours,
                                const surface::SurfaceCluster& cluster) {
    std::set<std::int64_t> ids;
    for (const std::int32_t contour : contours)
        ids.insert(cluster
                       .buildings[static_cast<std::size_t>(
                           cluster.contours[static_cast<std::size_t>(contour)].building)]
                       .id);
    ProblemRecord record;
    record.building = *ids.begin();
    record.other = ids.size() > 1 ? *std::next(ids.begin()) : 0;
    return record;
}

ProblemRecord record_of(const surface::VertexRepair& mend, const surface::SurfaceCluster& cluster,
                        const SurfaceFrame& frame) {
    ProblemRecord record = between_buildings(mend.contours, cluster);
    record.kind = kind_of(mend.filled ? Reason::surface_notch_filled : Reason::surface_corner_cut);
    const Position from = position_of(mend.place, frame);
    const Position to = position_of(mend.moved, frame);
    record.after = std::hypot(to.x - from.x, to.y - from.y) * frame.horizontal_metres;
    record.changed = true;
    return record;
}

}  // namespace

void add_left_out(const DrawnCluster& drawn, const surface::MadeSurfaces& made,
                  std::vector<LostBuilding>& lost) {
    for (const std::int64_t id : made.left_out) {
        const auto building = std::ranges::find(drawn.cluster.buildings, id, &surface::ClusterBuilding::id);
        const auto place = building - drawn.cluster.buildings.begin();
        const auto contour = std::ranges::find(drawn.cluster.contours, static_cast<std::int32_t>(place),
                                               &surface::PartitionContour::building);
        lost.push_back({id, drawn.buildings[static_cast<std::size_t>(place)].area_m2,
                        contour->outline.exterior.front()});
    }
}

std::vector<PlacedProblem> surface_problems(const surface::SurfaceCluster& cluster,
                                            const surface::MadeSurfaces& made,
                                            const std::vector<LostBuilding>& lost,
                                            const SurfaceFrame& frame) {
    std::vector<PlacedProblem> problems;
    for (const surface::VertexRepair& mend : made.repairs)
        problems.push_back({record_of(mend, cluster, frame), position_of(mend.place, frame)});
    for (const LostBuilding& building : lost) {
        if (!building.corner)
            continue;
        ProblemRecord record;
        record.kind = kind_of(Reason::surface_lost);
        record.building = building.id;
        record.before = building.area_m2;
        problems.push_back({record, position_of(*building.corner, frame)});
    }
    return problems;
}

std::vector<PlacedProblem> step_problems(const surface::SurfaceCluster& cluster,
                                         const std::vector<surface::RoofStep>& steps,
                                         const SurfaceFrame& frame) {
    std::vector<PlacedProblem> problems;
    const double metres = frame.scale[2] * frame.vertical_metres;
    for (const surface::RoofStep& step : steps) {
        ProblemRecord record = between_buildings(step.contours, cluster);
        record.kind = "flow_step";
        record.before = static_cast<double>(step.before) * metres;
        record.after = static_cast<double>(step.after) * metres;
        record.changed = step.after == 0;
        problems.push_back({record, position_of(step.place, frame)});
    }
    return problems;
}

}  // namespace d2b::features
