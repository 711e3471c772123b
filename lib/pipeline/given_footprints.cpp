#include "pipeline/given_footprints.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "core/byte_stream.hpp"
#include "diagnose/search_warnings.hpp"
#include "features/reprojection.hpp"
#include "geometry/geos.hpp"
#include "pipeline/polygon_bytes.hpp"

namespace d2b::pipeline {

AffineTransform inverse_of(const AffineTransform& g) {
    const double determinant = g[1] * g[5] - g[2] * g[4];
    return {(g[2] * g[3] - g[0] * g[5]) / determinant, g[5] / determinant,  -g[2] / determinant,
            (g[0] * g[4] - g[1] * g[3]) / determinant, -g[4] / determinant, g[1] / determinant};
}

namespace {

constexpr std::int64_t most_invalid_named = 5;

/// Box in columns and rows.
struct PixelBox {
    double left = HUGE_VAL;
    double top = HUGE_VAL;
    double right = -HUGE_VAL;
    double bottom = -HUGE_VAL;

    void add(const Position& p) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
    }
    [[nodiscard]] bool meets(const Window& window) const {
        return right > window.col && left < window.end_col() && bottom > window.row && top < window.end_row();
    }
    [[nodiscard]] bool is_within(const Window& window) const {
        return left > window.col && right < window.end_col() && top > window.row && bottom < window.end_row();
    }
};

/// Projects polygons of the footprints' CRS to that of the DEM.
class ToDem {
  public:
    ToDem(const std::string& wkt, const features::RunSetup& setup, const StopToken& stop);

    /// @return false if the polygons have no image, as in places that the CRS of the DEM does not cover
    [[nodiscard]] bool apply(std::vector<WorldPolygon>& polygons);

  private:
    bool same_crs_;
    std::optional<features::RingTransform> transform_;  ///< nullopt also if the DEM has no image
};

ToDem::ToDem(const std::string& wkt, const features::RunSetup& setup, const StopToken& stop)
    : same_crs_(wkt.empty()) {
    if (same_crs_)
        return;
    constexpr double longest_cells = 100;
    const Crs own(wkt);
    const Window& window = setup.dem.window;
    const AffineTransform& g = setup.dem.transform;
    std::vector<Position> corners;
    for (const double row : {double(window.row), double(window.end_row())})
        for (const double col : {double(window.col), double(window.end_col())})
            corners.push_back({g[0] + col * g[1] + row * g[2], g[3] + col * g[4] + row * g[5]});
    CoordinateTransform back(setup.crs, own, corners);
    static_cast<void>(back.try_apply(corners));
    std::erase_if(corners, [](const Position& p) { return !std::isfinite(p.x + p.y); });
    if (corners.size() < 2)
        return;
    const double across =
        std::hypot(corners.back().x - corners.front().x, corners.back().y - corners.front().y);
    const double longest = longest_cells * across / std::max(window.rows, window.cols);
    transform_.emplace(own, setup.crs, corners, longest > 0 ? longest : 1, stop);
}

bool ToDem::apply(std::vector<WorldPolygon>& polygons) {
    if (same_crs_)
        return true;
    if (!transform_)
        return false;
    const auto project = [&](WorldRing& ring) {
        return transform_->apply(ring) == features::RingProjection::whole;
    };
    return std::ranges::all_of(polygons, [&](WorldPolygon& polygon) {
        return project(polygon.exterior) && std::ranges::all_of(polygon.interiors, project);
    });
}

/// Finds the cells of footprints, one after the other.
class FootprintPlacer {
  public:
    FootprintPlacer(const std::string& wkt, const features::RunSetup& setup, Spool& spool, Context& context)
        : window_(setup.dem.window),
          to_pixels_(inverse_of(setup.dem.transform)),
          to_dem_(wkt, setup, context.threads->stop()),
          geodesy_(wkt.empty() ? setup.crs : Crs(wkt), context.threads->stop()),
          geos_(context.threads->stop()),
          spool_(spool),
          report_(*context.report.footprints) {}

    [[nodiscard]] PlacedFootprint place(GivenFootprint&& given);
    void warn_of_invalid(Context& context) const;

  private:
    [[nodiscard]] std::vector<WorldPolygon> valid_copy(const GivenFootprint& given);
    void find_cells(std::vector<WorldPolygon>&& polygons, PlacedFootprint& placed);

    Window window_;
    AffineTransform to_pixels_;
    ToDem to_dem_;
    Geodesy geodesy_;
    Geos geos_;
    Spool& spool_;
    FootprintReport& report_;
    std::string invalid_;  ///< the first invalid ones, for a warning
};

std::vector<WorldPolygon> FootprintPlacer::valid_copy(const GivenFootprint& given) {
    std::vector<WorldPolygon> polygons = given.polygons;
    const std::string reason = geos_.invalidity(polygons);
    if (reason.empty())
        return polygons;
    if (++report_.invalid <= most_invalid_named)
        invalid_ += (invalid_.empty() ? "" : ", ") + std::to_string(given.fid) + " (" + reason + ")";
    const auto is_broken = [](const WorldRing& ring) {
        return ring.size() < 3 ||
               std::ranges::any_of(ring, [](const Position& p) { return !std::isfinite(p.x + p.y); });
    };
    std::erase_if(polygons, [&](const WorldPolygon& polygon) { return is_broken(polygon.exterior); });
    for (WorldPolygon& polygon : polygons)
        std::erase_if(polygon.interiors, is_broken);
    try {
        return geos_.repaired(polygons);
    } catch (const GeometryError&) {
        return {};
    }
}

void FootprintPlacer::warn_of_invalid(Context& context) const {
    if (report_.invalid == 0)
        return;
    const std::int64_t more = report_.invalid - most_invalid_named;
    context.warn(
        (report_.invalid == 1 ? "1 footprint is" : std::to_string(report_.invalid) + " footprints are") +
        " not valid, written as given and measured on a repaired copy: feature " + invalid_ +
        (more > 0 ? " and " + std::to_string(more) + " more" : "") + ".");
}

void FootprintPlacer::find_cells(std::vector<WorldPolygon>&& polygons, PlacedFootprint& placed) {
    ByteWriter shape;
    save(polygons, shape);
    PixelBox box;
    std::vector<WorldRing> rings;
    const auto add = [&](WorldRing&& ring) {
        for (Position& p : ring) {
            const AffineTransform& g = to_pixels_;
            p = {g[0] + p.x * g[1] + p.y * g[2], g[3] + p.x * g[4] + p.y * g[5]};
            box.add(p);
        }
        rings.push_back(std::move(ring));
    };
    for (WorldPolygon& polygon : polygons) {
        add(std::move(polygon.exterior));
        for (WorldRing& ring : polygon.interiors)
            add(std::move(ring));
    }
    if (!box.meets(window_)) {
        placed.place = PlacedFootprint::Place::outside;
        return;
    }
    placed.at_edge = !box.is_within(window_);
    const std::vector<RowSpan> spans = row_spans(rings, window_);
    if (spans.empty()) {
        placed.place = PlacedFootprint::Place::without_cell;
        return;
    }
    for (const RowSpan& span : spans)
        placed.cell_count += span.end - span.begin;
    placed.first_row = spans.front().row;
    placed.end_row = spans.back().row + 1;
    ByteWriter cells;
    cells.put_list(spans);
    placed.cells = append(spool_, cells);
    placed.shape = append(spool_, shape);
}

PlacedFootprint FootprintPlacer::place(GivenFootprint&& given) {
    PlacedFootprint placed;
    ++report_.given;
    ByteWriter feature;
    save(given.projected.empty() ? given.polygons : given.projected, feature);
    feature.put_list(given.original);
    placed.feature = append(spool_, feature);
    if (given.polygons.empty()) {
        placed.place = PlacedFootprint::Place::without_polygon;
        return placed;
    }
    std::vector<WorldPolygon> polygons = valid_copy(given);
    for (const WorldPolygon& polygon : polygons) {
        const Geodesy::Measure one = geodesy_.polygon(polygon);
        placed.measure.area_m2 += one.area_m2;
        placed.measure.perimeter_m += one.perimeter_m;
    }
    if (polygons.empty() || !to_dem_.apply(polygons))
        placed.place =
            polygons.empty() ? PlacedFootprint::Place::without_cell : PlacedFootprint::Place::outside;
    else
        find_cells(std::move(polygons), placed);
    return placed;
}

std::vector<RowSpan> spans_of(const PlacedFootprint& placed, const Spool& spool) {
    return ByteReader(spool, placed.cells).take_list<RowSpan>();
}

/// Cells of a layer that footprints have taken, from a row on.
class TakenCells {
  public:
    explicit TakenCells(const Window& window) : window_(window), first_(window.row) {}

    /// Forgets the rows above, which no later footprint reaches.
    void forget_above(std::int32_t row) {
        for (; first_ < row && !rows_.empty(); ++first_)
            rows_.pop_front();
        first_ = std::max(first_, row);
    }
    /// Takes the cells unless one of them is taken. @pre no cell lies above the rows that are kept
    [[nodiscard]] bool take(std::span<const RowSpan> spans) {
        const auto is_free = [&](const RowSpan& span) {
            const auto row = static_cast<std::size_t>(span.row - first_);
            return row >= rows_.size() ||
                   std::find(at(row, span.begin), at(row, span.end), true) == at(row, span.end);
        };
        if (!std::ranges::all_of(spans, is_free))
            return false;
        for (const RowSpan& span : spans) {
            const auto row = static_cast<std::size_t>(span.row - first_);
            while (rows_.size() <= row)
                rows_.emplace_back(static_cast<std::size_t>(window_.cols));
            std::fill(at(row, span.begin), at(row, span.end), true);
        }
        return true;
    }

  private:
    [[nodiscard]] std::vector<bool>::iterator at(std::size_t row, std::int32_t col) {
        return rows_[row].begin() + (col - window_.col);
    }

    Window window_;
    std::int32_t first_;
    std::deque<std::vector<bool>> rows_;
};

/// Returns the footprints with cells by layer, each ordered by first row: each is in the first layer whose
/// footprints share no cell with it.
std::vector<std::vector<std::size_t>> divide_into_layers(const GivenFootprints& given, Context& context) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < given.all.size(); ++i)
        if (given.all[i].cell_count > 0)
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return given.all[i].first_row; });
    std::vector<std::vector<std::size_t>> layers;
    std::vector<TakenCells> taken;
    for (const std::size_t i : order) {
        context.check_stop();
        const std::vector<RowSpan> spans = spans_of(given.all[i], *given.spool);
        std::size_t layer = 0;
        for (;; ++layer) {
            if (layer == layers.size()) {
                layers.emplace_back();
                taken.emplace_back(given.window);
            }
            taken[layer].forget_above(given.all[i].first_row);
            if (taken[layer].take(spans))
                break;
        }
        layers[layer].push_back(i);
    }
    return layers;
}

constexpr std::int32_t rows_per_strip = 256;

/// Writes the labels of the footprints of a layer, strip by strip.
FootprintLayer label_cells(const GivenFootprints& given, std::vector<std::size_t>&& members,
                           Context& context) {
    FootprintLayer layer{detect::LabelRows(context.make_spool(), given.window), {0}};
    layer.footprints.insert(layer.footprints.end(), members.begin(), members.end());
    std::vector<Label> open;  // labels that reach the strip
    Label next = 1;
    const Window& window = given.window;
    for (std::int32_t row = window.row; row < window.end_row(); row += rows_per_strip) {
        const Window strip{row, window.col, std::min(rows_per_strip, window.end_row() - row), window.cols};
        for (; next <= layer.count() && given.all[layer.footprints[next]].first_row < strip.end_row(); ++next)
            open.push_back(next);
        Grid<Label> labels(strip.rows, strip.cols);
        for (const Label label : open)
            for (const RowSpan& span : spans_of(given.all[layer.footprints[label]], *given.spool))
                if (span.row >= strip.row && span.row < strip.end_row())
                    std::fill_n(labels.row(span.row - strip.row).begin() + (span.begin - window.col),
                                span.end - span.begin, label);
        layer.labels.append({strip, strip}, labels, *context.threads);
        std::erase_if(
            open, [&](Label label) { return given.all[layer.footprints[label]].end_row <= strip.end_row(); });
    }
    std::vector<Label> number(layer.footprints.size());
    std::iota(number.begin(), number.end(), Label{0});
    layer.labels.renumber(std::move(number));
    return layer;
}

void count_places(const GivenFootprints& given, FootprintReport& report) {
    using Place = PlacedFootprint::Place;
    const auto count = [&](Place place) {
        return std::ranges::count(given.all, place, &PlacedFootprint::place);
    };
    report.outside = count(Place::outside);
    report.without_cell = count(Place::without_cell);
    report.without_polygon = count(Place::without_polygon);
}

}  // namespace

GivenFootprints place_footprints(FootprintSource& source, const features::RunSetup& setup, Context& context) {
    GivenFootprints given{{}, {}, context.make_spool(), setup.dem.window};
    context.report.footprints.emplace();
    const StageClock clock(context.report, Stage::read);
    FootprintPlacer placer(source.crs_wkt(), setup, *given.spool, context);
    source.for_each([&](GivenFootprint&& footprint) {
        context.check_stop();
        given.all.push_back(placer.place(std::move(footprint)));
    });
    placer.warn_of_invalid(context);
    count_places(given, *context.report.footprints);
    diagnose::warn_unless_empty(
        diagnose::unplaced_footprints_warning(*context.report.footprints, setup.plan.asked.write.footprints,
                                              setup.dem.name),
        context);
    return given;
}

void label_footprints(GivenFootprints& given, Context& context) {
    const StageClock clock(context.report, Stage::read);
    for (std::vector<std::size_t>& members : divide_into_layers(given, context))
        given.layers.push_back(label_cells(given, std::move(members), context));
}

std::vector<RowSpan> GivenFootprints::cells(std::size_t footprint) const {
    return all[footprint].cell_count > 0 ? spans_of(all[footprint], *spool) : std::vector<RowSpan>();
}

void GivenFootprints::add(std::size_t footprint, const detect::SeenFootprint& seen, double metres) {
    PlacedFootprint& placed = all[footprint];
    placed.elevated += seen.elevated;
    placed.trees += seen.trees;
    if (seen.own_cells <= placed.most_own_cells)
        return;
    placed.most_own_cells = seen.own_cells;
    placed.ground = seen.ground / metres;
    placed.shift_m = seen.shift_m;
}

Grid<Label> GivenFootprints::labels(std::size_t layer, const Window& part, Executor& threads) const {
    Grid<Label> grid = Grid<Label>::unset(part.rows, part.cols, threads);
    for_row_bands(threads, part.rows, part.cols, [&](RowBand rows) {
        const LabelBand band =
            layers[layer].labels.band({part.row + rows.begin, rows.end - rows.begin, window.cols});
        for (std::int32_t r = rows.begin; r < rows.end; ++r)
            std::ranges::copy(band.row(r - rows.begin)
                                  .subspan(static_cast<std::size_t>(part.col - window.col),
                                           static_cast<std::size_t>(part.cols)),
                              grid.row(r).begin());
    });
    return grid;
}

std::vector<WorldPolygon> GivenFootprints::shape(std::size_t footprint) const {
    if (all[footprint].cell_count == 0)
        return {};
    ByteReader reader(*spool, all[footprint].shape);
    return load_polygons(reader);
}

}  // namespace d2b::pipeline
