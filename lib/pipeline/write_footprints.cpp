#include "pipeline/write_footprints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "contours/for_each_building.hpp"
#include "core/byte_stream.hpp"
#include "features/attribute_table.hpp"
#include "features/contour_drawer.hpp"
#include "features/record_builder.hpp"
#include "features/roof_layer.hpp"
#include "pipeline/extract_roofs.hpp"
#include "pipeline/find_buildings.hpp"
#include "pipeline/polygon_bytes.hpp"
#include "pipeline/trace_contours.hpp"

namespace d2b::pipeline {
namespace {

/// Outlines in given footprints follow the cells, because their walls are those of the footprints.
features::RunSetup setup_of_contours(const features::RunSetup& setup) {
    features::RunSetup traced = setup;
    traced.plan.walls = Walls::off;
    traced.plan.asked.outline.arcs = false;
    traced.plan.asked.detect.min_building_height = 0;
    return traced;
}

/// Labels of given footprints in the form that found buildings have.
FoundBuildings as_found(const GivenFootprints& given, FootprintLayer& layer) {
    FoundBuildings found;
    found.labels = std::move(layer.labels);
    found.buildings = layer.count();
    for (Label label = 1; label <= layer.count(); ++label)
        found.add({given.all[layer.footprints[label]].ground, RoofElevations::unknown, {}});
    return found;
}

/// Measures the elevations of the cells of each footprint.
void measure_cells(GivenFootprints& given, const FootprintLayer& layer, const FoundBuildings& labels,
                   ElevationReader& reader, const ElevationFrame& frame, Context& context) {
    contours::for_each_building(reader, labels.labels, labels.count(), given.window, Stage::attributes,
                                context, [&](Label label, contours::BuildingCells&& cells) {
                                    PlacedFootprint& placed = given.all[layer.footprints[label]];
                                    PointStats stats;
                                    for (const double z : cells.elevations)
                                        if (!std::isnan(z))
                                            stats.add(z, frame.fixed);
                                    placed.points = stats.n;
                                    if (stats.n > 0)
                                        placed.mean = frame.fixed.mean(stats.sum, stats.n);
                                    for (const std::size_t spire : cells.spires)
                                        cells.elevations[spire] = RoofElevations::unknown;
                                    ElevationSample sample;
                                    sample.add(cells.elevations, frame.range);
                                    placed.roof = summarize_roof(sample, frame.range);
                                });
}

/// Signed area in squared fine steps, positive if the ring is counter-clockwise with y up.
double signed_area(const FineRing& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const FinePoint& a = ring[i];
        const FinePoint& b = ring[i + 1 < ring.size() ? i + 1 : 0];
        sum += static_cast<double>(b.col - a.col) * static_cast<double>(a.row + b.row) / 2;
    }
    return sum;
}

/// True if the rectangle around an outline is so much larger than the cells with elevations that a grid of it
/// could take all memory, because the outline reaches far beyond the raster.
bool is_far_larger(const FinePolygon& outline, std::size_t cells) {
    constexpr double most_per_cell = 16;
    constexpr double always = 1e6;
    const auto [top, bottom] = std::ranges::minmax(outline.exterior, {}, &FinePoint::row);
    const auto [west, east] = std::ranges::minmax(outline.exterior, {}, &FinePoint::col);
    const double rectangle = static_cast<double>(bottom.row - top.row) / FinePoint::steps *
                             static_cast<double>(east.col - west.col) / FinePoint::steps;
    return rectangle > most_per_cell * static_cast<double>(cells) + always;
}

/// Roofs of given footprints, one per polygon.
class GivenRoofs {
  public:
    GivenRoofs(GivenFootprints& given, const features::RunSetup& setup, Context& context)
        : given_(given),
          setup_(setup),
          context_(context),
          parameters_(roof_parameters(setup, context.report)),
          to_lattice_(inverse_of(setup.dem.transform)),
          shift_(setup.plan.trace == TraceMode::points ? 0.5 : 0) {
        std::size_t polygons = 0;
        for (std::size_t i = 0; i < given.all.size(); ++i) {
            first_.push_back(polygons);
            polygons += given.shape(i).size();
        }
        first_.push_back(polygons);
        roofs_.emplace(context.make_spool(), polygons, roofs_are_level(context.report));
        areas_.resize(polygons);
    }

    /// Makes the roofs of a layer of footprints.
    void extract(const FootprintLayer& layer, const FoundBuildings& labels, ElevationReader& reader);
    /// @param outliner of any contours, because faces have outlines of their own
    void write(const outline::Outliner& outliner, FeatureSink& sink);

  private:
    [[nodiscard]] FinePolygon on_lattice(const WorldPolygon& polygon) const;
    [[nodiscard]] FineRing on_lattice(const WorldRing& ring, bool exterior) const;
    void make(std::size_t footprint, const contours::BuildingCells& cells);

    GivenFootprints& given_;
    const features::RunSetup& setup_;
    Context& context_;
    roofs::RoofParameters parameters_;
    AffineTransform to_lattice_;
    double shift_;
    std::vector<std::size_t> first_;  ///< index of the first polygon by footprint
    std::vector<double> areas_;       ///< of the polygons, in cells
    std::optional<features::StoredRoofs> roofs_;
};

FineRing GivenRoofs::on_lattice(const WorldRing& ring, bool exterior) const {
    const AffineTransform& g = to_lattice_;
    FineRing fine;
    for (const Position& p : ring) {
        const double col = g[0] + p.x * g[1] + p.y * g[2] - shift_;
        const double row = g[3] + p.x * g[4] + p.y * g[5] - shift_;
        const FinePoint point{std::llround(row * FinePoint::steps), std::llround(col * FinePoint::steps)};
        if (fine.empty() || fine.back() != point)
            fine.push_back(point);
    }
    while (fine.size() > 1 && fine.front() == fine.back())
        fine.pop_back();
    if ((signed_area(fine) > 0) != exterior)
        std::ranges::reverse(fine);
    return fine;
}

FinePolygon GivenRoofs::on_lattice(const WorldPolygon& polygon) const {
    constexpr std::size_t least_corners = 3;
    FinePolygon fine{on_lattice(polygon.exterior, true), {}};
    for (const WorldRing& ring : polygon.interiors)
        if (FineRing hole = on_lattice(ring, false); hole.size() >= least_corners)
            fine.interiors.push_back(std::move(hole));
    return fine;
}

/// The type is that of the largest polygon.
void GivenRoofs::make(std::size_t footprint, const contours::BuildingCells& cells) {
    const StopToken& stop = context_.threads->stop();
    Geos geos(stop);
    RoofRecord whole;
    whole.ridge_z = RoofElevations::unknown;
    double all = 0;
    double largest = 0;
    std::size_t index = first_[footprint];
    for (const WorldPolygon& polygon : given_.shape(footprint)) {
        const std::size_t at = index++;
        const FinePolygon outline = on_lattice(polygon);
        double area = signed_area(outline.exterior);
        for (const FineRing& ring : outline.interiors)
            area += signed_area(ring);
        areas_[at] = area;
        if (is_far_larger(outline, cells.elevations.size()))
            continue;  // it stays without faces
        try {
            const roofs::Roof roof = roofs::make_roof(cells, outline, parameters_, geos, stop);
            if (roof.faces.empty())
                continue;
            const RoofRecord record = roof_record(roof, context_.report.units.vertical_metres);
            roofs_->put(at, roof, record);
            if (area > largest)
                whole.type = record.type;
            largest = std::max(largest, area);
            whole.ridge_z = std::fmax(whole.ridge_z, record.ridge_z);
            whole.flat_share += area * record.flat_share;
            whole.eave_z += area * record.eave_z;
            whole.rmse_m += area * record.rmse_m * record.rmse_m;
            all += area;
        } catch (const GeometryError&) {
            continue;  // it stays without faces
        }
    }
    // Without faces all of these are unknown.
    whole.flat_share /= all;
    whole.eave_z /= all;
    whole.rmse_m = std::sqrt(whole.rmse_m / all);
    given_.all[footprint].roof_shape = whole;
}

void GivenRoofs::extract(const FootprintLayer& layer, const FoundBuildings& labels, ElevationReader& reader) {
    contours::for_each_building(reader, labels.labels, labels.count(), given_.window, Stage::roofs, context_,
                                [&](Label label, contours::BuildingCells&& cells) {
                                    if (given_.all[layer.footprints[label]].points > 0)
                                        make(layer.footprints[label], cells);
                                });
}

void GivenRoofs::write(const outline::Outliner& outliner, FeatureSink& sink) {
    std::vector<BuildingRecord> of_polygons(areas_.size());  // only their ids and areas
    for (std::size_t i = 0; i < given_.all.size(); ++i) {
        double all = 0;
        for (std::size_t polygon = first_[i]; polygon < first_[i + 1]; ++polygon)
            all += areas_[polygon];
        for (std::size_t polygon = first_[i]; polygon < first_[i + 1]; ++polygon) {
            of_polygons[polygon].id = static_cast<std::int64_t>(i) + 1;
            of_polygons[polygon].area_m2 =
                all > 0 ? given_.all[i].measure.area_m2 * areas_[polygon] / all : 0;
        }
    }
    const GroupedIndices no_children;
    std::vector<features::PolygonMaker> makers =
        features::polygon_makers(setup_, outliner, no_children, false, context_);
    features::RoofLayer layer(*setup_.layers.indices.given_roofs, roofs_->are_level(), sink, context_);
    std::int64_t id = sink.first_id();
    features::draw_in_order(
        *context_.threads, of_polygons.size(),
        [&](std::size_t i, std::size_t thread) {
            const std::optional<roofs::Roof> roof = roofs_->roof(i);
            return roof ? features::draw_faces(*roof, of_polygons[i].area_m2, setup_, makers[thread])
                        : std::vector<features::DrawnFace>();
        },
        [&](std::size_t i, std::vector<features::DrawnFace>&& faces) {
            id = features::number_faces(faces, of_polygons[i], id);
            layer.add(std::move(faces));
        });
    layer.finish();
    for (features::PolygonMaker& maker : makers)
        context_.report.merge(maker.tally());
}

/// Contour cut off at its footprint.
struct CutContour {
    ContourRecord record;
    std::int64_t parent = -1;
    PointStats own;
    features::FeaturePolygon made;
};

/// Writes the contours of one layer of footprints after another.
class CutContours {
  public:
    CutContours(GivenFootprints& given, const features::RunSetup& setup, const ElevationFrame& frame,
                FeatureSink& sink, Context& context)
        : given_(given),
          setup_(setup),
          frame_(frame),
          sink_(sink),
          context_(context),
          layer_(setup.layers.indices.given_contours) {}

    /// @param footprints index of the footprint by label
    void write(const contours::StoredContours& contours, const features::RecordBuilder& records,
               const outline::Outliner& outliner, const std::vector<std::size_t>& footprints);
    [[nodiscard]] double rmse() const { return rmse_.value(); }

  private:
    /// @param is_whole true for the only contour of level 1 of its footprint
    [[nodiscard]] CutContour draw(const contours::StoredContours& contours,
                                  const features::RecordBuilder& records, std::size_t i,
                                  std::size_t footprint, bool is_whole, features::PolygonMaker& maker) const;
    void add(CutContour&& cut);

    GivenFootprints& given_;
    const features::RunSetup& setup_;
    const ElevationFrame& frame_;
    FeatureSink& sink_;
    Context& context_;
    std::optional<std::size_t> layer_;
    std::int64_t next_id_ = 1;
    features::StackRmse rmse_;
};

CutContour CutContours::draw(const contours::StoredContours& contours, const features::RecordBuilder& records,
                             std::size_t i, std::size_t footprint, bool is_whole,
                             features::PolygonMaker& maker) const {
    const contours::Contour contour = contours.fetch(i);
    CutContour cut;
    cut.record = records.contour(i, contour);
    cut.record.building_id = static_cast<std::int64_t>(footprint) + 1;
    cut.parent = contours.head(i).parent;
    cut.own = contour.own;
    if (!layer_)
        return cut;
    // Beyond the border of the raster the footprint has no cells.
    if (is_whole && !given_.all[footprint].at_edge && !setup_.plan.asked.outline.disjoint)
        cut.made = maker.given(given_.shape(footprint));
    else
        cut.made = maker.within(i, given_.shape(footprint));
    return cut;
}

void CutContours::add(CutContour&& cut) {
    RunReport& report = context_.report;
    while (report.levels.size() <= static_cast<std::size_t>(cut.record.level))
        report.levels.push_back({static_cast<int>(report.levels.size()), RoofElevations::unknown, 0, 0});
    LevelReport& level = report.levels[static_cast<std::size_t>(cut.record.level)];
    ++level.contours;
    level.points += cut.record.points;
    rmse_.add(cut.own, frame_.fixed);
    if (!layer_)
        return;
    ++report.contours;
    report.contour_outlines.traced += cut.made.measure.perimeter_m;
    report.vertices += features::vertices_of(cut.made.parts);
    cut.record.area_m2 = cut.made.measure.area_m2;
    cut.record.perimeter_m = cut.made.measure.perimeter_m;
    cut.record.status = cut.made.status;
    const StageClock clock(report, Stage::write);
    sink_.add(*layer_, {features::field_values(features::contour_attributes(), cut.record),
                        std::move(cut.made.parts), cut.record.threshold, cut.record});
}

void CutContours::write(const contours::StoredContours& contours, const features::RecordBuilder& records,
                        const outline::Outliner& outliner, const std::vector<std::size_t>& footprints) {
    const GroupedIndices children =
        setup_.plan.asked.outline.disjoint ? features::contour_children(contours) : GroupedIndices();
    std::vector<features::PolygonMaker> makers =
        features::polygon_makers(setup_, outliner, children, false, context_);
    std::vector<std::size_t> lowest(footprints.size());  // number of contours of level 1 by label
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (contours.head(i).key.level == 1)
            ++lowest[contours.head(i).label];
    std::vector<std::int64_t> ids;  // by contour; if it is not written, that of the one below
    features::draw_in_order(
        *context_.threads, contours.size(),
        [&](std::size_t i, std::size_t thread) {
            const contours::ContourHead& head = contours.head(i);
            return draw(contours, records, i, footprints[head.label],
                        head.key.level == 1 && lowest[head.label] == 1, makers[thread]);
        },
        [&](std::size_t i, CutContour&& cut) {
            PlacedFootprint& placed = given_.all[footprints[contours.head(i).label]];
            const std::int64_t below = cut.parent < 0 ? 0 : ids[static_cast<std::size_t>(cut.parent)];
            if (layer_ && cut.made.parts.empty()) {
                ids.push_back(below);
                return;
            }
            ++placed.parts;
            placed.levels = std::max(placed.levels, cut.record.level);
            cut.record.parent_id = below;
            cut.record.id = next_id_++;
            ids.push_back(cut.record.id);
            add(std::move(cut));
        });
    for (features::PolygonMaker& maker : makers)
        context_.report.merge(maker.tally());
}

BuildingRecord given_record(const PlacedFootprint& placed, std::int64_t id, double metres, double storey_m) {
    BuildingRecord record;
    record.storey_m = storey_m;
    record.id = id;
    record.ground = placed.ground;
    record.roof = placed.roof.highest;
    record.height_m = (record.roof - record.ground) * metres;
    record.heights_m = heights_above(record.ground, placed.roof, metres);
    record.parts = placed.parts;
    record.levels = placed.levels;
    record.points = placed.points;
    record.cells = placed.cell_count;
    record.mean_m = (placed.mean - placed.ground) * metres;
    record.confidence = RoofElevations::unknown;
    record.at_edge = placed.at_edge;
    record.area_m2 = placed.measure.area_m2;
    record.perimeter_m = placed.measure.perimeter_m;
    record.status = OutlineStatus::given;
    record.roof_shape = placed.roof_shape;
    if (placed.cell_count == 0)
        return record;
    const auto cells = static_cast<double>(placed.cell_count);
    record.seen_share = static_cast<double>(placed.elevated) / cells;
    record.tree_share = static_cast<double>(placed.trees) / cells;
    if (record.seen_share >= detect::least_seen_share)
        record.shift_m = placed.shift_m;
    return record;
}

void write_features_of(const GivenFootprints& given, const features::RunSetup& setup, FeatureSink& sink,
                       Context& context) {
    FootprintReport& report = *context.report.footprints;
    const std::size_t layer = *setup.layers.indices.given;
    constexpr double flat_share = 0.1;
    for (std::size_t i = 0; i < given.all.size(); ++i) {
        context.check_stop();
        const PlacedFootprint& placed = given.all[i];
        const BuildingRecord record =
            given_record(placed, static_cast<std::int64_t>(i) + 1, context.report.units.vertical_metres,
                         setup.plan.asked.write.storey_height);
        report.measured += placed.points > 0 ? 1 : 0;
        report.without_data += placed.cell_count > 0 && placed.points == 0 ? 1 : 0;
        report.flat += placed.points > 0 && record.seen_share < flat_share ? 1 : 0;
        ByteReader reader(*given.spool, placed.feature);
        Feature feature{features::given_values(setup.plan.asked, record), load_polygons(reader), 0, record};
        feature.original = reader.take_list<std::byte>();
        const StageClock clock(context.report, Stage::write);
        sink.add(layer, feature);
    }
}

}  // namespace

void write_footprints(GivenFootprints&& given, ElevationReader& reader, const ElevationFrame& frame,
                      const features::RunSetup& setup, FeatureSink& sink, Context& context) {
    const features::RunSetup traced = setup_of_contours(setup);
    CutContours contours_out(given, traced, frame, sink, context);
    std::optional<GivenRoofs> roofs;
    if (setup.plan.asked.write.roofs)
        roofs.emplace(given, setup, context);
    const auto count = static_cast<double>(given.layers.size());
    for (FootprintLayer& layer : given.layers) {
        const auto before = static_cast<double>(&layer - given.layers.data());
        const ProgressSpan span(context, before / (count + 1), (before + 1) / (count + 1));
        const FoundBuildings labels = as_found(given, layer);
        measure_cells(given, layer, labels, reader, frame, context);
        const Tiers tiers =
            plan_tiers(reader, labels, given.window, traced, frame.fixed, frame.global, context);
        const contours::TraceFrame trace_frame{given.window, tiers.plan.level_count(), frame.fixed,
                                               frame.range};
        const auto contours = trace_contours(reader, trace_frame, tiers, &labels, traced, context);
        const features::RecordBuilder records(
            *contours, {tiers.plan, frame.fixed, labels.footprints, context.report.units.vertical_metres,
                        features::lattice_frame(given.window, traced.plan.trace)});
        const outline::Outliner outliner = features::draw_outlines(*contours, traced, context);
        contours_out.write(*contours, records, outliner, layer.footprints);
        if (roofs)
            roofs->extract(layer, labels, reader);
        if (roofs && &layer == &given.layers.back())
            roofs->write(outliner, sink);
    }
    RunReport& report = context.report;
    report.stack_rmse_m = contours_out.rmse() * report.units.vertical_metres;
    report.footprints->missing = report.buildings;
    report.buildings = report.footprints->given;
    write_features_of(given, setup, sink, context);
}

}  // namespace d2b::pipeline
