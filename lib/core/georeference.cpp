#include "core/georeference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

#include "dem2buildings/error.hpp"

namespace d2b {

Georeference::Georeference(const AffineTransform& transform, TraceMode mode)
    : transform_(transform),
      shift_(mode == TraceMode::points ? 0.5 : 0.0),
      mirrored_(transform[1] * transform[5] - transform[2] * transform[4] > 0) {}

Position Georeference::position(FinePoint point, std::int64_t divisor) const {
    // Exact, because the divisor is a power of two.
    const auto steps = static_cast<double>(FinePoint::steps * divisor);
    const double col = static_cast<double>(point.col) / steps + shift_;
    const double row = static_cast<double>(point.row) / steps + shift_;
    return {transform_[0] + col * transform_[1] + row * transform_[2],
            transform_[3] + col * transform_[4] + row * transform_[5]};
}

Position Georeference::step(double rows, double cols) const {
    return {cols * transform_[1] + rows * transform_[2], cols * transform_[4] + rows * transform_[5]};
}

double Georeference::cell_area() const {
    return std::abs(transform_[1] * transform_[5] - transform_[2] * transform_[4]);
}

bool Georeference::is_exact(const Window& window) const {
    constexpr double roundings = 8;  // more than occur while computing a coordinate
    const auto keeps_apart = [](double origin, double step, std::int64_t steps) {
        const double largest = std::abs(origin) + std::abs(step) * (static_cast<double>(steps) + 1);
        return std::abs(step) > roundings * std::numeric_limits<double>::epsilon() * largest;
    };
    return axis_parallel() &&
           keeps_apart(transform_[0], transform_[1], std::int64_t{window.col} + window.cols) &&
           keeps_apart(transform_[3], transform_[5], std::int64_t{window.row} + window.rows);
}

WorldRing Georeference::corners(const LatticeBox& box) const {
    const auto& [low, high] = box;
    return {position(low), position(LatticePoint{high.row, low.col}), position(high),
            position(LatticePoint{low.row, high.col})};
}

WorldRing Georeference::ring(const FineRing& ring, std::int64_t divisor) const {
    WorldRing result;
    result.reserve(ring.size());
    for (const FinePoint point : ring)
        result.push_back(position(point, divisor));
    if (mirrored_)
        std::reverse(result.begin() + 1, result.end());
    return result;
}

WorldPolygon Georeference::polygon(const FinePolygon& polygon, std::int64_t divisor) const {
    WorldPolygon result{ring(polygon.exterior, divisor), {}};
    result.interiors.reserve(polygon.interiors.size());
    for (const FineRing& interior : polygon.interiors)
        result.interiors.push_back(ring(interior, divisor));
    result.arcs = polygon.arcs;
    if (mirrored_)
        for (CircularArc& arc : result.arcs) {
            // Reversing a ring about its first vertex turns vertex i into n - i, and an arc then begins at
            // its old end.
            const std::size_t n =
                arc.ring == 0 ? polygon.exterior.size() : polygon.interiors[arc.ring - 1].size();
            arc.first = static_cast<std::uint32_t>((2 * n - arc.first - arc.edges) % n);
        }
    return result;
}

namespace {

constexpr int block_shift = 8;
// Lower limit, because search windows are counted in cells: near a pole, or with a wrong unit, they would
// have millions.
constexpr double finest_cell_m = 0.001;

/// Caches measured areas per block. Copies share the cache. Thread-safe.
class CachedCellArea {
  public:
    CachedCellArea(const Georeference& georeference, const Crs& crs, const LatticeBox& raster)
        : state_(std::make_shared<State>(georeference, crs, raster)) {}

    double operator()(LatticePoint square) const {
        const LatticePoint block{square.row >> block_shift, square.col >> block_shift};
        const std::scoped_lock lock(state_->mutex);
        const auto [found, is_new] = state_->blocks.try_emplace(block, 0.0);
        if (is_new)
            found->second = measure(block);
        return found->second;
    }

  private:
    struct State {
        State(const Georeference& the_georeference, const Crs& crs, const LatticeBox& the_raster)
            : georeference(the_georeference), geodesy(crs), raster(the_raster) {}
        Georeference georeference;
        Geodesy geodesy;
        LatticeBox raster;
        std::mutex mutex;
        std::map<LatticePoint, double> blocks;
    };

    [[nodiscard]] double measure(LatticePoint block) const;
    [[nodiscard]] LatticePoint in_raster(std::int32_t row, std::int32_t col) const {
        const auto& [low, high] = state_->raster;
        return {std::clamp(row, low.row, std::max(low.row, high.row - 1)),
                std::clamp(col, low.col, std::max(low.col, high.col - 1))};
    }
    [[nodiscard]] double measure_square(LatticePoint square) const {
        const auto [row, col] = square;
        WorldRing ring;
        for (const LatticePoint corner :
             {LatticePoint{row, col}, {row + 1, col}, {row + 1, col + 1}, {row, col + 1}})
            ring.push_back(state_->georeference.position(corner));
        return state_->geodesy.ring(ring).area_m2;
    }

    std::shared_ptr<State> state_;
};

/// Sets the angle between rows and columns on the ground.
void measure_angle(const Georeference& georeference, double stretch, CellSize& cell) {
    constexpr double rounding = 1e-6;
    const Position col = georeference.step(0, 1);
    const Position row = georeference.step(1, 0);
    const double lengths = std::hypot(col.x * stretch, col.y) * std::hypot(row.x * stretch, row.y);
    const double cosine = (col.x * row.x * stretch * stretch + col.y * row.y) / lengths;
    if (std::abs(cosine) < rounding)
        return;
    cell.cosine = cosine;
    cell.sine = std::abs(stretch * (col.x * row.y - col.y * row.x)) / lengths;
}

/// Measures the square at the centre of the block, or as near to it as the raster reaches, because near a
/// pole or the edge of a CRS there may be nothing beyond. If that fails (the raster itself extends beyond the
/// CRS: a full disk, a world grid), tries other squares of the block.
double CachedCellArea::measure(LatticePoint block) const {
    constexpr std::int32_t size = 1 << block_shift;
    const LatticePoint first{block.row * size, block.col * size};
    try {
        return measure_square(in_raster(first.row + size / 2, first.col + size / 2));
    } catch (const InputError&) {
        constexpr std::int32_t step = size / 8;
        for (std::int32_t row = 0; row < size; row += step)
            for (std::int32_t col = 0; col < size; col += step)
                try {
                    return measure_square(in_raster(first.row + row, first.col + col));
                } catch (const InputError&) {
                    continue;
                }
        throw;
    }
}

}  // namespace

double x_stretch(const Georeference& georeference, const Crs& crs, const Window& window) {
    constexpr double steepest = 89;  // degrees; near the poles no angle is a right angle
    if (crs.kind() != Crs::Kind::geographic)
        return 1;
    const Position middle =
        georeference.position(LatticePoint{window.row + window.rows / 2, window.col + window.cols / 2});
    return std::cos(std::clamp(middle.y, -steepest, steepest) * std::numbers::pi / 180);
}

SquareArea make_square_area(const Georeference& georeference, const Crs& crs, const LatticeBox& raster) {
    if (crs.on_ellipsoid())
        return CachedCellArea(georeference, crs, raster);
    const auto unit = crs.horizontal_unit();
    const double metres = unit ? unit->metres : 1.0;
    return [area = georeference.cell_area() * metres * metres](LatticePoint) { return area; };
}

CellSize cell_steps(const Window& window, const Georeference& georeference, const Crs& crs) {
    Geodesy geodesy(crs);
    const LatticePoint middle{window.row + window.rows / 2, window.col + window.cols / 2};
    // There and back: half the perimeter of a degenerate ring.
    const auto length = [&](LatticePoint to) {
        const WorldRing ring{georeference.position(middle), georeference.position(to)};
        return geodesy.ring(ring).perimeter_m / 2;
    };
    CellSize cell{std::max(finest_cell_m, length({middle.row, middle.col + 1})),
                  std::max(finest_cell_m, length({middle.row + 1, middle.col}))};
    measure_angle(georeference, x_stretch(georeference, crs, window), cell);
    return cell;
}

double cell_size_m(const Window& window, const SquareArea& area) {
    return std::sqrt(area({window.row + window.rows / 2, window.col + window.cols / 2}));
}

}  // namespace d2b
