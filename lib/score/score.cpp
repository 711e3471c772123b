#include "score/score.hpp"

#include <algorithm>
#include <utility>

#include "score/measure.hpp"
#include "score/objects.hpp"
#include "score/outline_distance.hpp"
#include "score/shape.hpp"

namespace d2b::score {
namespace {

/// Far below measured lengths, far above rounding errors of coordinates.
constexpr double border_m = 0.001;

/// Clips rings to a region with half-open borders: left and upper belong to it, right and lower do not, as
/// for raster cells. Along the border of the data, half of the outlines count.
std::vector<Polyline> rings_in_region(Polygons area, const Polygons& region, double border,
                                      Overlay& overlay) {
    translate(area, border, -border);
    std::vector<Polyline> rings = overlay.clip_rings(area, region);
    for (Polyline& ring : rings)
        for (Position& p : ring)
            p = {p.x - border, p.y + border};
    return rings;
}

/// Repairs areas that became invalid by transformation.
void repair(std::vector<Polygons>& areas, Overlay& overlay) {
    for (Polygons& area : areas)
        if (!overlay.valid(area))
            area = overlay.make_valid(area);
}

class Scorer {
  public:
    Scorer(ScoreSide found, ScoreSide reference, ScoreOptions options)
        : options_(std::move(options)), found_(std::move(found)), reference_(std::move(reference)) {
        repair(found_.areas, overlay_);
        repair(reference_.areas, overlay_);
    }

    Score run() {
        const Dissolved found = overlay_.dissolve(found_.areas);
        const Polygons reference = overlay_.union_of(reference_.areas);
        score_.overlap = share(area_of(found.twice), area_of(found.once));
        measure_outline(found.once, reference);
        count_vertices();
        const Comparison comparison = compare(in_region(found.once), in_region(reference), overlay_);
        measure_areas(comparison);
        measure_pairs(comparison);
        measure_shapes();
        // Objects are whole here, because cuts at the border of the region are no walls.
        measure_directions(options_.region
                               ? compare(touching_region(found.once), touching_region(reference), overlay_)
                               : comparison);
        return score_;
    }

  private:
    [[nodiscard]] Polygons in_region(const Polygons& area) {
        return options_.region ? overlay_.intersection(area, *options_.region) : area;
    }

    void measure_outline(const Polygons& found, const Polygons& reference) {
        const double metres = options_.metres;
        const std::vector<Polyline> outline =
            options_.region ? rings_in_region(found, *options_.region, border_m / metres, overlay_)
                            : rings_of(found);
        const OutlineDistance distance =
            outline_distance(outline, rings_of(reference), options_.outline_limit_m / metres,
                             options_.outline_step_m / metres);
        score_.outline_m = distance.length * metres;
        score_.outline_near_m = distance.near * metres;
        if (distance.rms)
            score_.outline_rms_m = *distance.rms * metres;
    }

    [[nodiscard]] std::vector<bool> counted(const ScoreSide& side) {
        return options_.region ? overlay_.intersecting(side.areas, *options_.region)
                               : std::vector<bool>(side.areas.size(), true);
    }

    void count_vertices() {
        const std::vector<bool> found = counted(found_);
        for (std::size_t i = 0; i < found.size(); ++i)
            if (found[i])
                score_.found.vertices += found_.vertices[i];
        const std::vector<bool> reference = counted(reference_);
        for (std::size_t i = 0; i < reference.size(); ++i)
            if (reference[i])
                score_.reference.vertices +=
                    overlay_.simplified_vertices(reference_.areas[i], options_.simplify_m / options_.metres);
        score_.vertex_ratio = share(score_.found.vertices, score_.reference.vertices);
    }

    void measure_areas(const Comparison& comparison) {
        const double square_metres = options_.metres * options_.metres;
        const double both = comparison.found_area + comparison.reference_area - comparison.shared_area;
        score_.shared_m2 = comparison.shared_area * square_metres;
        score_.completeness = share(comparison.shared_area, comparison.reference_area);
        score_.correctness = share(comparison.shared_area, comparison.found_area);
        score_.iou = share(comparison.shared_area, both);
        describe(score_.found, found_, comparison.found, comparison.found_area * square_metres);
        describe(score_.reference, reference_, comparison.reference,
                 comparison.reference_area * square_metres);
        score_.object_completeness = share(score_.reference.objects_covered, score_.reference.objects);
        score_.object_correctness = share(score_.found.objects_covered, score_.found.objects);
    }

    void describe(SideScore& score, const ScoreSide& side, const ScoredObjects& objects,
                  double area_m2) const {
        const ObjectCount count =
            count_objects(objects, options_.min_object_m2 / (options_.metres * options_.metres));
        score.features = side.areas.size();
        score.invalid = side.invalid;
        score.area_m2 = area_m2;
        score.objects = count.large;
        score.objects_covered = count.covered;
    }

    void measure_pairs(const Comparison& comparison) {
        const auto found = object_heights(found_.heights, found_.areas, comparison.found.pieces, overlay_);
        const auto reference =
            object_heights(reference_.heights, reference_.areas, comparison.reference.pieces, overlay_);
        double polis = 0;
        std::vector<double> errors;
        for (const ObjectPair& pair : comparison.pairs) {
            if (!at_least(pair.iou, options_.match_iou))
                continue;
            ++score_.pairs;
            polis += polis_distance(comparison.found.pieces[pair.found],
                                    comparison.reference.pieces[pair.reference]);
            if (found[pair.found] && reference[pair.reference])
                errors.push_back(*found[pair.found] - *reference[pair.reference]);
        }
        if (score_.pairs > 0)
            score_.polis_m = polis / static_cast<double>(score_.pairs) * options_.metres;
        score_.heights = height_errors(errors);
    }

    [[nodiscard]] Polygons touching_region(const Polygons& polygons) {
        if (!options_.region)
            return polygons;
        std::vector<Polygons> features;
        for (const WorldPolygon& polygon : polygons)
            features.push_back({polygon});
        const std::vector<bool> touches = overlay_.intersecting(features, *options_.region);
        Polygons result;
        for (std::size_t i = 0; i < polygons.size(); ++i)
            if (touches[i])
                result.push_back(polygons[i]);
        return result;
    }

    [[nodiscard]] CornerRings corners_of(const WorldPolygon& polygon) {
        const double tolerance = options_.simplify_m / options_.metres;
        CornerRings rings{overlay_.simplified_ring(from_leftmost(polygon.exterior), tolerance)};
        for (const WorldRing& interior : polygon.interiors)
            rings.push_back(overlay_.simplified_ring(from_leftmost(interior), tolerance));
        return rings;
    }

    [[nodiscard]] ShapeScore shape_of(const ScoreSide& side) {
        ShapeLimits limits;
        if (options_.cell_m)
            limits.short_edge = 2 * *options_.cell_m / options_.metres;
        Polygons all;
        for (const Polygons& area : side.areas)
            all.insert(all.end(), area.begin(), area.end());
        std::vector<CornerRings> polygons;
        for (const WorldPolygon& polygon : touching_region(all))
            polygons.push_back(corners_of(polygon));
        return measure_shape(polygons, limits);
    }

    void measure_shapes() {
        score_.found.shape = shape_of(found_);
        score_.reference.shape = shape_of(reference_);
    }

    void measure_directions(const Comparison& comparison) {
        const double largest = options_.direction_below_m2 / (options_.metres * options_.metres);
        const auto direction = [&](const ScoredObjects& objects, std::size_t i) {
            return main_direction(corners_of(objects.pieces[i]), ShapeLimits{}.near_deg).degrees;
        };
        std::vector<double> angles;
        for (const ObjectPair& pair : comparison.pairs)
            if (at_least(pair.iou, options_.match_iou) &&
                !at_least(comparison.found.areas[pair.found], largest) &&
                !at_least(comparison.reference.areas[pair.reference], largest))
                angles.push_back(angle_between(direction(comparison.found, pair.found),
                                               direction(comparison.reference, pair.reference)));
        score_.directions = direction_errors(std::move(angles));
    }

    Overlay overlay_;
    ScoreOptions options_;
    ScoreSide found_;
    ScoreSide reference_;
    Score score_;
};

}  // namespace

ScoreSide score_side(const std::vector<PolygonFeature>& footprints, Overlay& overlay) {
    ScoreSide side;
    for (const PolygonFeature& feature : footprints) {
        const bool valid = !feature.open_ring && overlay.valid(feature.polygons);
        if (!valid)
            ++side.invalid;
        side.areas.push_back(valid ? feature.polygons : overlay.make_valid(feature.polygons));
        side.heights.push_back(feature.height);
        side.vertices.push_back(vertex_count(feature.polygons, true));
    }
    return side;
}

Score score(ScoreSide found, ScoreSide reference, const ScoreOptions& options) {
    return Scorer(std::move(found), std::move(reference), options).run();
}

}  // namespace d2b::score
