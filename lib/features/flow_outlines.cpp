#include "features/flow_outlines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "features/reprojection.hpp"
#include "geometry/box_tree.hpp"

namespace d2b::features {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Groups contours above the ground that may come close to each other, with the contours on top of them.
/// @param reach distance in cells beyond which nothing changes
std::vector<Indices> flow_clusters(const contours::ContourList& contours, const outline::Outliner& outliner,
                                   double reach, const StopToken& stop) {
    const auto count = static_cast<std::uint32_t>(contours.size());
    DisjointSets sets(count);
    const auto is_above_ground = [&](std::uint32_t i) { return contours.head(i).key.level > 0; };
    for (const Indices& group : outliner.groups(stop)) {
        std::optional<std::uint32_t> first;
        for (const std::uint32_t i : group)
            if (is_above_ground(i))
                first = first ? sets.join(*first, i) : i;
    }
    Indices lowest;
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < count; ++i)
        if (contours.head(i).key.level == 1) {
            lowest.push_back(i);
            Box& box = boxes.emplace_back();
            for (const FinePoint& point : outliner.outline(i).exterior)
                box.add(Position{static_cast<double>(point.col), static_cast<double>(point.row)});
        }
    const BoxTree tree(boxes);
    const double margin = reach * FinePoint::steps;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box& box = boxes[i];
        tree.query({box.left - margin, box.low - margin, box.right + margin, box.high + margin},
                   [&](std::size_t other) { sets.join(lowest[i], lowest[other]); });
    }
    std::map<std::uint32_t, Indices> by_first;
    for (std::uint32_t i = 0; i < count; ++i)
        if (is_above_ground(i))
            by_first[sets.find(i)].push_back(i);
    std::vector<Indices> clusters;
    clusters.reserve(by_first.size());
    for (auto& [first, numbers] : by_first)
        clusters.push_back(std::move(numbers));
    return clusters;
}

/// Border of the valid area. The thesis preset has a contour along it that other contours must not cross.
class TerrainBorder {
  public:
    /// @param reach in cells
    TerrainBorder(const contours::ContourList& contours, const outline::Outliner& outliner, double reach)
        : tree_(boxes(contours, outliner)), margin_(reach * FinePoint::steps) {}

    [[nodiscard]] bool is_near(const FinePolygon& outline) const {
        bool near = false;
        for_each_edge(outline, [&](const Box& box) {
            tree_.query({box.left - margin_, box.low - margin_, box.right + margin_, box.high + margin_},
                        [&](std::size_t) { near = true; });
        });
        return near;
    }

  private:
    template <typename Visit>
    static void for_each_edge(const FinePolygon& outline, const Visit& visit) {
        const auto along = [&](const FineRing& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                Box box;
                for (const FinePoint& end : {ring[i], ring[(i + 1) % ring.size()]})
                    box.add(Position{static_cast<double>(end.col), static_cast<double>(end.row)});
                visit(box);
            }
        };
        along(outline.exterior);
        for (const FineRing& ring : outline.interiors)
            along(ring);
    }
    static std::vector<Box> boxes(const contours::ContourList& contours, const outline::Outliner& outliner) {
        std::vector<Box> boxes;
        for (std::uint32_t i = 0; i < contours.size(); ++i)
            if (contours.head(i).key.level == 0)
                for_each_edge(outliner.outline(i), [&](const Box& box) { boxes.push_back(box); });
        return boxes;
    }

    BoxTree tree_;
    double margin_;
};

/// @param footprints true for the footprints of the lowest contours, false for all outlines
std::vector<surface::PartitionContour> drawn(const contours::ContourList& contours,
                                             const outline::Outliner& outliner, const Indices& numbers,
                                             bool footprints) {
    std::map<std::int64_t, std::int32_t> place;
    std::vector<surface::PartitionContour> result;
    for (const std::uint32_t i : numbers) {
        surface::PartitionContour contour;
        contour.outline = footprints ? outliner.footprint(i) : outliner.outline(i);
        contour.building = static_cast<std::int32_t>(contours.head(i).building);
        if (const auto parent = place.find(contours.head(i).parent); parent != place.end())
            contour.parent = parent->second;
        place[i] = static_cast<std::int32_t>(result.size());
        result.push_back(std::move(contour));
    }
    return result;
}

/// Keeps the lowest contours, because footprints are made ready without the tiers above them.
std::vector<Indices> without_upper_levels(const contours::ContourList& contours,
                                          std::vector<Indices> clusters) {
    for (Indices& numbers : clusters)
        std::erase_if(numbers, [&](std::uint32_t i) { return contours.head(i).key.level != 1; });
    return clusters;
}

/// Marks contours near the border of the terrain, which stay as they are.
std::vector<bool> near_border(const std::vector<surface::PartitionContour>& cluster,
                              const TerrainBorder& border) {
    std::vector<bool> marked;
    marked.reserve(cluster.size());
    for (const surface::PartitionContour& contour : cluster)
        marked.push_back(border.is_near(contour.outline));
    return marked;
}

using ChangedContours = std::vector<std::pair<std::uint32_t, FinePolygon>>;

void replace_outlines(outline::Outliner& outliner, ChangedContours& changed, bool footprints) {
    for (auto& [contour, outline] : changed)
        if (footprints)
            outliner.replace_footprint(contour, outline);
        else
            outliner.replace(contour, outline);
}

void warn_of_remaining(Context& context) {
    const std::int64_t left = context.report.counted(Reason::flow_unchanged);
    if (left == 0)
        return;
    context.warn(std::to_string(left) + (left == 1 ? " place is" : " places are") +
                 " still too narrow or too short, because a repair would change more than 1 % of a block, or "
                 "cross a neighbour or the border of the terrain; -write_problems shows where.");
}

constexpr std::array<std::string_view, 6> kind_names{"flow_wall", "flow_angle", "flow_gap",
                                                     "flow_neck", "flow_touch", "flow_crossing"};

}  // namespace

surface::FlowMetric flow_metric(const Georeference& georeference, double x_stretch, double cell_size_m) {
    const Position col = georeference.step(0, 1);
    const Position row = georeference.step(1, 0);
    const double area = std::abs(x_stretch * (col.x * row.y - col.y * row.x));
    const double scale = cell_size_m / std::sqrt(area) / FinePoint::steps;
    return {{scale * x_stretch * col.x, scale * col.y}, {scale * x_stretch * row.x, scale * row.y}};
}

std::vector<surface::FlowProblem> make_outlines_flow_ready(const contours::ContourList& contours,
                                                           outline::Outliner& outliner,
                                                           const surface::FlowLimits& limits,
                                                           Context& context) {
    const StageClock clock(context.report, Stage::outline);
    const double cell = FinePoint::steps * limits.metric.shorter_step();
    const double reach = 3 * std::max(limits.gap, limits.wall) / cell;
    const TerrainBorder border(contours, outliner, reach);
    const std::vector<Indices> clusters = flow_clusters(contours, outliner, reach, context.threads->stop());
    std::vector<surface::FlowProblem> problems;
    std::set<std::tuple<surface::FlowKind, FinePoint, bool>> known;
    const auto make_ready = [&](bool footprints) {
        const std::vector<Indices> drawn_numbers =
            footprints ? without_upper_levels(contours, clusters) : clusters;
        // Applied at the end, because other threads still read the outlines of their clusters.
        ChangedContours changed;
        context.threads->in_order(
            clusters.size(),
            [&](std::size_t k, std::size_t) {
                const std::vector<surface::PartitionContour> cluster =
                    drawn(contours, outliner, drawn_numbers[k], footprints);
                return surface::make_flow_ready(cluster, limits, near_border(cluster, border),
                                                context.threads->stop());
            },
            [&](std::size_t k, surface::FlowReady ready) {
                for (std::size_t i = 0; i < ready.outlines.size(); ++i)
                    changed.emplace_back(drawn_numbers[k][i], std::move(ready.outlines[i]));
                for (surface::FlowProblem& problem : ready.problems) {
                    if (!known.emplace(problem.kind, problem.place, problem.changed).second && !footprints)
                        continue;
                    for (std::int32_t& contour : problem.contours)
                        contour =
                            static_cast<std::int32_t>(drawn_numbers[k][static_cast<std::size_t>(contour)]);
                    context.report.count(problem.changed ? Reason::flow_changed : Reason::flow_unchanged);
                    problems.push_back(std::move(problem));
                }
            });
        replace_outlines(outliner, changed, footprints);
    };
    // Footprints come first, because outlines have additional corners that only the contours above them need.
    if (outliner.has_own_footprints())
        make_ready(true);
    make_ready(false);
    warn_of_remaining(context);
    return problems;
}

std::vector<PlacedProblem> placed_problems(const std::vector<surface::FlowProblem>& problems,
                                           const FeatureInput& input, std::int64_t first_id) {
    const RunSetup& setup = input.setup;
    auto transform =
        output_transform(setup.crs, setup.target, setup.georeference, setup.dem.window, StopToken());
    std::vector<PlacedProblem> placed;
    for (const surface::FlowProblem& problem : problems) {
        std::set<std::int64_t> ids;
        for (const std::int32_t contour : problem.contours)
            ids.insert(first_id + input.contours.head(static_cast<std::size_t>(contour)).building);
        ProblemRecord record;
        record.kind = kind_names[static_cast<std::size_t>(problem.kind)];
        record.building = ids.empty() ? 0 : *ids.begin();
        record.other = ids.size() > 1 ? *std::next(ids.begin()) : 0;
        record.before = problem.before;
        record.after = problem.after;
        record.changed = problem.changed;
        std::array<Position, 1> place{setup.georeference.position(problem.place)};
        if (!transform || transform->apply_to_positions(place))
            placed.push_back({record, place[0]});
    }
    return placed;
}

}  // namespace d2b::features
