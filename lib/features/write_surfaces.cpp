#include "features/write_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "features/attribute_table.hpp"
#include "features/problem_layer.hpp"
#include "features/write_features.hpp"
#include "geometry/geos.hpp"
#include "options/provenance_text.hpp"
#include "roofs/roof_type.hpp"
#include "surface/level_roofs.hpp"

namespace d2b::features {
namespace {

constexpr std::int64_t max_lost_named = 10;
constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// Per-thread state.
struct SurfaceWorker {
    std::optional<RingTransform> transform;
    Geos geos;
    Tally tally{};
};

/// Closed surfaces of a group, and the cluster from which they are made.
struct ClosedSurfaces {
    DrawnCluster drawn;
    surface::MadeSurfaces made;
};

/// Result for one group.
struct GroupSurfaces {
    surface::MadeSurfaces made;
    std::vector<SurfacePart> tiers;
    std::vector<LostBuilding> lost;
    std::vector<PlacedProblem> problems;  // if asked for
    std::int64_t stacked = 0;             // buildings with tiers instead of the planes of roofs
    std::int64_t levelled_faces = 0;      // faces of roofs that would reach below the ground
    std::int64_t steps_changed = 0;       // roof steps lower than -min_wall that were levelled
    std::int64_t steps_left = 0;          // roof steps lower than -min_wall that remain
};

/// @param records sorted by id
void fill_values(const std::vector<BuildingRecord>& records,
                 std::span<const Attribute<BuildingRecord>> attributes, std::vector<SurfacePart>& parts) {
    for (SurfacePart& part : parts)
        for (SurfaceBuilding& building : part.buildings) {
            const auto record = std::ranges::lower_bound(records, building.id, {}, &BuildingRecord::id);
            building.values = field_values(attributes, *record);
            building.whole = record->whole;
        }
}

/// Returns twice the signed area of a ring in plan view, counter-clockwise positive.
double twice_signed_area(const std::vector<SurfacePoint>& points, std::span<const std::uint32_t> ring) {
    double twice = 0;
    const SurfacePoint& from = points[ring[0]];
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const SurfacePoint& a = points[ring[i]];
        const SurfacePoint& b = points[ring[i + 1]];
        twice += static_cast<double>(a.x - from.x) * static_cast<double>(b.y - from.y) -
                 static_cast<double>(b.x - from.x) * static_cast<double>(a.y - from.y);
    }
    return twice;
}

/// Roof area per building of a cluster, in square steps.
std::vector<double> roof_areas(const surface::SurfaceCluster& cluster, const surface::MadeSurfaces& made) {
    std::vector<double> areas(cluster.buildings.size());
    for (const SurfacePart& part : made.shell.empty() ? made.solids : made.shell)
        for (const SurfaceBuilding& building : part.buildings) {
            double twice = 0;
            for (const SurfaceTriangle& triangle : building.triangles)
                if (triangle.kind == FaceKind::roof)
                    twice += twice_signed_area(part.points, triangle.corners);
            for (const SurfaceFace& face : building.faces)
                if (face.kind == FaceKind::roof) {
                    twice += twice_signed_area(part.points, face.exterior);
                    for (const std::vector<std::uint32_t>& interior : face.interiors)
                        twice += twice_signed_area(part.points, interior);
                }
            const auto place =
                std::ranges::lower_bound(cluster.buildings, building.id, {}, &surface::ClusterBuilding::id);
            areas[static_cast<std::size_t>(place - cluster.buildings.begin())] = twice / 2;
        }
    return areas;
}

/// Slope and azimuth of a plane, in the plane of the CRS.
SurfaceRoofPlane plane_of(const surface::RoofPlane& plane, const SurfaceFrame& frame) {
    const double height = frame.scale[2] * frame.vertical_metres;
    const double east = plane.per_col * height / (frame.scale[0] * frame.horizontal_metres);
    const double south = plane.per_row * height / (frame.scale[1] * frame.horizontal_metres);
    const double slope = std::atan(std::hypot(east, south)) * degrees_per_radian;
    if (slope < roofs::flat_degrees)
        return {slope, std::numeric_limits<double>::quiet_NaN()};
    const double azimuth = std::atan2(-east, south) * degrees_per_radian;
    return {slope, azimuth < 0 ? azimuth + 360 : azimuth};
}

/// Lists the planes of a building's roof. @param building whose faces refer to contours of the cluster
void describe_roofs(const surface::SurfaceCluster& cluster, const SurfaceFrame& frame,
                    SurfaceBuilding& building) {
    std::map<std::int32_t, std::int32_t> numbers;
    for (SurfaceFace& face : building.faces) {
        if (face.roof < 0)
            continue;
        const auto [found, is_new] =
            numbers.try_emplace(face.roof, static_cast<std::int32_t>(building.roofs.size()));
        if (is_new)
            building.roofs.push_back(
                plane_of(*cluster.contours[static_cast<std::size_t>(face.roof)].plane, frame));
        face.roof = found->second;
    }
}

/// Adds the faces of roofs to the tiers of the same buildings.
void add_roof_faces(const std::vector<SurfacePart>& solids, std::vector<SurfacePart>& tiers) {
    std::map<std::int64_t, const SurfacePart*> solid_of;
    for (const SurfacePart& part : solids)
        solid_of[part.buildings.front().id] = &part;
    for (SurfacePart& part : tiers) {
        SurfaceBuilding& building = part.buildings.front();
        const auto solid = solid_of.find(building.id);
        if (solid == solid_of.end())
            continue;
        part.points = solid->second->points;
        std::ranges::copy_if(solid->second->buildings.front().faces, std::back_inserter(building.faces),
                             [](const SurfaceFace& face) { return face.kind == FaceKind::roof; });
    }
}

/// Makes the surfaces of groups and passes them to the sinks. make() is thread-safe because each thread has a
/// SurfaceWorker; add() is called in the order of groups, so that files do not depend on the number of
/// threads.
class SurfaceWriter {
  public:
    SurfaceWriter(const SurfaceInput& input, std::span<SurfaceSink* const> sinks, Context& context);

    [[nodiscard]] GroupSurfaces make(std::span<const std::uint32_t> group, std::size_t thread);
    void add(GroupSurfaces&& group);
    void finish();

  private:
    [[nodiscard]] surface::MadeSurfaces made_of(const surface::SurfaceCluster& cluster,
                                                const surface::SurfaceForms& forms,
                                                SurfaceWorker& worker) const;
    [[nodiscard]] ClosedSurfaces close(const SurfaceInput& input, const surface::SurfaceForms& forms,
                                       std::span<const std::uint32_t> group, SurfaceWorker& worker) const;
    void make_closed(std::span<const std::uint32_t> group, SurfaceWorker& worker, GroupSurfaces& result);
    void make_tiers(std::span<const std::uint32_t> group, SurfaceWorker& worker, GroupSurfaces& result);
    /// False if outlines are flow-ready, because levelled roofs may change volumes by more.
    [[nodiscard]] bool fits_volumes() const {
        return input_.of == SurfaceOf::buildings && input_.roof == SurfaceRoof::mean &&
               !input_.features.setup.plan.asked.outline.is_flow_ready();
    }
    [[nodiscard]] bool has_closed() const { return forms_.solids || forms_.shell; }
    [[nodiscard]] const char* whole() const { return has_closed() ? "surface" : "page"; }
    void count(const surface::MadeSurfaces& made);
    void warn_of_lost(const std::vector<LostBuilding>& lost);

    const SurfaceInput& input_;
    std::span<SurfaceSink* const> sinks_;
    Context& context_;
    surface::SurfaceForms forms_;
    std::int64_t min_step_ = 0;  // minimum roof step in units of height; 0: any
    bool has_tiers_ = false;
    std::vector<SurfaceWorker> workers_;
    SurfaceReport report_;
    std::int64_t lost_ = 0;
    std::int64_t steps_left_ = 0;
};

SurfaceWriter::SurfaceWriter(const SurfaceInput& input, std::span<SurfaceSink* const> sinks, Context& context)
    : input_(input), sinks_(sinks), context_(context) {
    for (const SurfaceSink* sink : sinks)
        (sink->form() == SurfaceForm::solids  ? forms_.solids
         : sink->form() == SurfaceForm::shell ? forms_.shell
                                              : has_tiers_) = true;
    const RunSetup& setup = input.features.setup;
    const SurfaceFrame& frame = input.lattice.frame();
    forms_.move_steps = std::llround(setup.plan.asked.outline.shortest_wall() /
                                     (std::min(frame.scale[0], frame.scale[1]) * frame.horizontal_metres));
    forms_.gaps = input.lattice.gaps();
    for (int thread = 0; thread < context.threads->threads(); ++thread)
        workers_.push_back({output_transform(setup.crs, setup.target, setup.georeference, setup.dem.window,
                                             context.threads->stop()),
                            Geos(context.threads->stop())});
    min_step_ =
        std::llround(setup.plan.asked.outline.shortest_wall() / (frame.scale[2] * frame.vertical_metres));
    report_.origin = input.lattice.frame().origin;
}

surface::MadeSurfaces SurfaceWriter::made_of(const surface::SurfaceCluster& cluster,
                                             const surface::SurfaceForms& forms,
                                             SurfaceWorker& worker) const {
    return surface::make_surfaces(
        cluster, forms, [&](const FinePolygon& polygon) { return worker.geos.triangles(polygon); },
        context_.threads->stop());
}

ClosedSurfaces SurfaceWriter::close(const SurfaceInput& input, const surface::SurfaceForms& forms,
                                    std::span<const std::uint32_t> group, SurfaceWorker& worker) const {
    // A building whose roof prevents a closed surface gets tiers, and is left out only if these do so as
    // well.
    std::set<std::int64_t> stacked;
    while (true) {
        ClosedSurfaces result{draw_cluster(input, group, worker.transform, stacked), {}};
        if (input.of != SurfaceOf::buildings)
            merge_equal_tiers(result.drawn);
        result.made = made_of(result.drawn.cluster, forms, worker);
        const auto has_tiers = [&](std::int64_t id) {
            return std::ranges::find(result.drawn.stacked, id) != result.drawn.stacked.end();
        };
        if (input.of != SurfaceOf::roofs || std::ranges::all_of(result.made.left_out, has_tiers))
            return result;
        stacked.insert(result.made.left_out.begin(), result.made.left_out.end());
    }
}

void SurfaceWriter::make_closed(std::span<const std::uint32_t> group, SurfaceWorker& worker,
                                GroupSurfaces& result) {
    ClosedSurfaces closed = close(input_, forms_, group, worker);
    DrawnCluster& drawn = closed.drawn;
    result.made = std::move(closed.made);
    result.stacked = std::ssize(drawn.stacked);
    result.levelled_faces = drawn.levelled_faces;
    const bool moved = fits_volumes() && !result.made.repairs.empty() &&
                       preserve_volumes(roof_areas(drawn.cluster, result.made), drawn.cluster);
    // Levelled last, because other steps would separate equal roofs again.
    const std::vector<surface::RoofStep> steps = surface::level_roofs(drawn.cluster, min_step_);
    result.steps_left =
        std::ranges::count_if(steps, [](const surface::RoofStep& step) { return step.after > 0; });
    result.steps_changed = std::ssize(steps) - result.steps_left;
    if (moved || result.steps_changed > 0)
        result.made = made_of(drawn.cluster, forms_, worker);
    const auto attributes = building_attributes(input_.features.setup.plan.asked);
    fill_values(drawn.buildings, attributes, result.made.solids);
    fill_values(drawn.buildings, attributes, result.made.shell);
    for (SurfacePart& part : result.made.solids)
        describe_roofs(drawn.cluster, input_.lattice.frame(), part.buildings.front());
    result.lost = std::move(drawn.lost);
    add_left_out(drawn, result.made, result.lost);
    std::ranges::sort(result.lost, {}, &LostBuilding::id);
    if (input_.problems != nullptr) {
        result.problems = surface_problems(drawn.cluster, result.made, result.lost, input_.lattice.frame());
        std::ranges::move(step_problems(drawn.cluster, steps, input_.lattice.frame()),
                          std::back_inserter(result.problems));
    }
}

/// Reports lost buildings only if closed surfaces are not made, because these report them already.
void SurfaceWriter::make_tiers(std::span<const std::uint32_t> group, SurfaceWorker& worker,
                               GroupSurfaces& result) {
    SurfaceInput input = input_;
    input.of = SurfaceOf::contours;
    DrawnCluster drawn = draw_cluster(input, group, worker.transform);
    result.tiers = building_tiers(drawn, input.roof, input.lattice);
    fill_values(drawn.buildings, building_attributes(input_.features.setup.plan.asked), result.tiers);
    if (input_.features.roofs != nullptr && input_.of == SurfaceOf::roofs && forms_.solids) {
        add_roof_faces(result.made.solids, result.tiers);
    } else if (input_.features.roofs != nullptr) {
        input.of = SurfaceOf::roofs;
        add_roof_faces(
            close(input, {.solids = true, .gaps = input_.lattice.gaps()}, group, worker).made.solids,
            result.tiers);
    }
    if (!has_closed())
        result.lost = std::move(drawn.lost);
}

GroupSurfaces SurfaceWriter::make(std::span<const std::uint32_t> group, std::size_t thread) {
    SurfaceWorker& worker = workers_[thread];
    const StageClock clock(worker.tally, Stage::surface);
    GroupSurfaces result;
    if (has_closed())
        make_closed(group, worker, result);
    if (has_tiers_)
        make_tiers(group, worker, result);
    return result;
}

void SurfaceWriter::count(const surface::MadeSurfaces& made) {
    for (const surface::VertexRepair& mend : made.repairs)
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
        if (++lost_ <= max_lost_named)
            context_.warn("Building " + std::to_string(building.id) + " is not in the " + whole() +
                          (has_closed() ? ": it has no height above its ground, or no closed surface was "
                                          "found for it."
                                        : ": it has no ground, or no place in the CRS."));
    context_.report.count(Reason::surface_lost, static_cast<std::int64_t>(lost.size()));
}

void SurfaceWriter::add(GroupSurfaces&& group) {
    count(group.made);
    context_.report.count(Reason::surface_roof_tiers, group.stacked);
    context_.report.count(Reason::surface_face_level, group.levelled_faces);
    context_.report.count(Reason::flow_changed, group.steps_changed);
    context_.report.count(Reason::flow_unchanged, group.steps_left);
    steps_left_ += group.steps_left;
    warn_of_lost(group.lost);
    if (input_.problems != nullptr)
        input_.problems->note(std::move(group.problems));
    const StageClock clock(context_.report, Stage::write);
    for (SurfaceSink* sink : sinks_) {
        for (const SurfacePart& part : sink->form() == SurfaceForm::tiers    ? group.tiers
                                       : sink->form() == SurfaceForm::solids ? group.made.solids
                                                                             : group.made.shell)
            sink->add(part);
        sink->end_group();
    }
}

void SurfaceWriter::finish() {
    if (lost_ > max_lost_named)
        context_.warn(std::to_string(lost_ - max_lost_named) + " more buildings are not in the " + whole() +
                      ".");
    if (steps_left_ > 0)
        context_.warn(std::to_string(steps_left_) +
                      (steps_left_ == 1 ? " step between roofs is" : " steps between roofs are") +
                      " lower than -min_wall and left, because one roof would move more than 1 % of the "
                      "volume of a block; -write_problems shows where.");
    for (SurfaceWorker& worker : workers_)
        context_.report.merge(worker.tally);
    if (has_closed())
        context_.report.surface = report_;
}

}  // namespace

SurfaceMeta surface_meta(const RunPlan& plan, const SurfaceLattice& lattice, const Crs& written,
                         const UnitReport& units) {
    const bool tiers = plan.surface_of == SurfaceOf::contours || plan.asked.detect.split_height > 0;
    const FieldNames names = plan.asked.write.fields;
    SurfaceMeta meta{lattice.frame(),
                     plan.surface_of == SurfaceOf::roofs ? "2.2"
                     : tiers                             ? "1.3"
                                                         : "1.2",
                     field_specs(building_attributes(plan.asked), units.vertical, names),
                     units.vertical_is_known ? units.vertical : "",
                     {written.wkt(), {}}};
    meta.corners = lattice.window_corners();
    meta.block_style = building_style(names);
    meta.tier_style = contour_style(false);
    for (const char* field : {"p90", "num_floors", "area_m2", "volume_m3", "confidence"})
        meta.first_fields.emplace_back(field_name(names, field));
    if (plan.asked.detect.is_split_by())
        meta.first_fields.emplace_back(field_name(names, "parcel"));
    return meta;
}

void write_surfaces(const SurfaceInput& input, SurfaceMeta meta, std::span<SurfaceSink* const> sinks,
                    Context& context) {
    meta.provenance.metadata = strip_folders(make_provenance(input.features.setup, context.report).metadata,
                                             input.features.setup.plan.asked);
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

}  // namespace d2b::features
