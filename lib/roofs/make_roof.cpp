#include "roofs/make_roof.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/for_rings.hpp"
#include "roofs/meeting_planes.hpp"

namespace d2b::roofs {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;
constexpr std::int32_t margin = 5;  // cells
constexpr int merge_rounds = 3;
/// Price of a border with a low step, in prices of borders.
constexpr double coplanar_price = 4;
/// Width in cells of the largest square in a face below which its slope is doubtful.
constexpr std::int32_t least_width = 3;
/// Share of the points of a face below which its slope is doubtful, because most lie elsewhere.
constexpr double least_near = 0.5;
constexpr double near_points_m = 0.5;  // distance of such points from its plane

LatticeBox box_of(const FinePolygon& polygon) {
    const auto floor_cell = [](std::int64_t fine) {
        return static_cast<std::int32_t>(fine >= 0 ? fine / FinePoint::steps
                                                   : -((-fine + FinePoint::steps - 1) / FinePoint::steps));
    };
    FinePoint low = polygon.exterior.front();
    FinePoint high = low;
    for (const FinePoint& p : polygon.exterior) {
        low = {std::min(low.row, p.row), std::min(low.col, p.col)};
        high = {std::max(high.row, p.row), std::max(high.col, p.col)};
    }
    return {{floor_cell(low.row), floor_cell(low.col)}, {floor_cell(high.row) + 1, floor_cell(high.col) + 1}};
}

/// True if the cells contain a square of the least width.
bool is_wide(const std::vector<std::size_t>& cells, const BuildingGrid& grid,
             std::vector<std::int32_t>& sides) {
    const auto width = static_cast<std::size_t>(grid.cols);
    bool wide = false;
    for (const std::size_t i : cells) {
        sides[i] = 1 + std::min({sides[i - 1], sides[i - width], sides[i - width - 1]});
        wide = wide || sides[i] >= least_width;
    }
    for (const std::size_t i : cells)
        sides[i] = 0;
    return wide;
}

/// Measures the deviation of cells from a plane.
FaceMeasure measured(const Plane& plane, const std::vector<std::size_t>& cells, const BuildingGrid& grid) {
    FaceMeasure face;
    face.slope_col = plane.slope_x / grid.cell_m;
    face.slope_row = plane.slope_y / grid.cell_m;
    face.slope = grid.steepness(face.slope_col, face.slope_row);
    double squares = 0;
    std::int64_t near = 0;
    for (const std::size_t cell : cells) {
        const double z = grid.elevation(cell);
        if (std::isnan(z))
            continue;
        const Vec2 p = grid.centre(cell);
        const double residual = z - plane.at(p.x, p.y);
        squares += residual * residual;
        near += std::abs(residual) <= near_points_m ? 1 : 0;
        ++face.cells;
    }
    if (face.cells > 0) {
        face.rmse_m = std::sqrt(squares / static_cast<double>(face.cells));
        face.near = static_cast<double>(near) / static_cast<double>(face.cells);
    }
    return face;
}

/// Upper end of a face, along the contour.
struct UpperEnd {
    double taper = 1;  ///< length near its top as a share of the longest one below
    double top = std::numeric_limits<double>::infinity();  ///< its length, in the unit of Vec2
};

/// Measures lengths at several heights, because a narrow part may reach farther down than the eaves.
UpperEnd upper_end(const RoofFace& face, const Plane& plane, const RoofLattice& lattice) {
    constexpr int heights = 7;
    constexpr double near = 0.15;  // of the height of the face
    const double slope = std::hypot(plane.slope_x, plane.slope_y);
    if (slope == 0)
        return {};
    const auto [low, high] = std::ranges::minmax(face.elevations);
    const auto length = [&](double z) {
        std::vector<double> crossings;
        std::size_t first = 0;
        const auto add_crossings = [&](const FineRing& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const std::size_t j = i + 1 < ring.size() ? i + 1 : 0;
                const double a = face.elevations[first + i];
                const double b = face.elevations[first + j];
                if ((a < z) == (b < z))
                    continue;
                const Vec2 p = lattice.position(ring[i]);
                const Vec2 q = lattice.position(ring[j]);
                const double share = (z - a) / (b - a);
                crossings.push_back(cross({plane.slope_x, plane.slope_y}, p + share * (q - p)) / slope);
            }
            first += ring.size();
        };
        for_rings(face.outline, add_crossings);
        std::ranges::sort(crossings);
        double sum = 0;
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            sum += crossings[i + 1] - crossings[i];
        return sum;
    };
    const double upper = length(high - near * (high - low));
    double longest = upper;
    double share = 1 - near;  // of the height, where it is longest
    for (int i = 0; i < heights; ++i) {
        const double at = near + (1 - 2 * near) * i / heights;
        if (const double here = length(low + at * (high - low)); here > longest) {
            longest = here;
            share = at;
        }
    }
    if (longest <= 0)
        return {};
    const double narrowing = longest > upper ? (longest - upper) / (1 - near - share) : 0;
    return {upper / longest, std::max(upper - near * narrowing, 0.0)};
}

/// Sets the type and error of a roof from its faces.
void summarize(Roof& roof, const std::vector<FacePlane>& planes, const RoofLattice& lattice, double cell_m,
               double roundness) {
    std::vector<FaceShape> shapes;
    double squares = 0;
    double cells = 0;
    for (std::size_t i = 0; i < roof.faces.size(); ++i) {
        const FaceMeasure& m = roof.faces[i].measure;
        const UpperEnd end = upper_end(roof.faces[i], planes[i].plane, lattice);
        shapes.push_back({m.area, slope_degrees(m),
                          std::atan2(-m.slope_col, m.slope_row) * degrees_per_radian, end.taper,
                          planes[i].level, std::ranges::min(roof.faces[i].elevations),
                          std::ranges::max(roof.faces[i].elevations), end.top * cell_m});
        squares += m.rmse_m * m.rmse_m * static_cast<double>(m.cells);
        cells += static_cast<double>(m.cells);
    }
    roof.type = roof_type(shapes, roundness, cell_m);
    roof.rmse_m = cells > 0 ? std::sqrt(squares / cells) : 0;
}

/// 4 pi times the area of an exterior ring by the square of its perimeter.
double roundness_of(const FineRing& ring, const RoofLattice& lattice) {
    double twice = 0;
    double length = 0;
    const Vec2 origin = lattice.position(ring.front());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = lattice.position(ring[i]);
        const Vec2 b = lattice.position(ring[i + 1 < ring.size() ? i + 1 : 0]);
        twice += cross(a - origin, b - origin);
        length += std::hypot(b.x - a.x, b.y - a.y);
    }
    return 2 * std::numbers::pi * std::abs(twice) / (length * length);
}

/// Tiers as level planes.
PlaneSegments level_segments(const contours::BuildingCells& cells, const contours::RegionOptions& options,
                             const BuildingGrid& grid, double metres, const StopToken& stop) {
    const contours::TierRegions tiers = contours::merge_regions(cells, options, stop);
    PlaneSegments segments;
    for (const contours::TierRegion& tier : tiers.regions)
        segments.planes.push_back({0, 0, tier.points > 0 ? tier.mean * metres - grid.datum : 0});
    segments.labels.assign(grid.size(), -1);
    std::size_t next = 0;
    for (const RowSpan& run : cells.runs)
        for (std::int32_t col = run.begin; col < run.end; ++col, ++next)
            segments.labels[grid.index(run.row - grid.first_row, col - grid.first_col)] =
                static_cast<std::int32_t>(tiers.of_cell[next]);
    return segments;
}

/// Faces with their cells and planes.
struct FittedFaces {
    std::vector<std::vector<std::size_t>> cells;
    std::vector<FacePlane> planes;
};

/// @param level true if the planes stay as they are
FittedFaces fit_faces(const std::vector<LabelledFace>& faces, const std::vector<Plane>& first, bool level,
                      const BuildingGrid& grid, const RoofLattice& lattice) {
    FittedFaces fitted;
    for (const LabelledFace& face : faces)
        fitted.cells.push_back(cells_of(face.outline, grid, lattice));
    if (level) {
        for (const Plane& plane : first)
            fitted.planes.push_back({plane, true, true});
        return fitted;
    }
    fitted.planes = meeting_planes(faces, face_edges(faces), first, fitted.cells, grid, lattice);
    return fitted;
}

/// Planes of the labels of faces.
std::vector<Plane> planes_of(const std::vector<LabelledFace>& faces, const std::vector<Plane>& by_label) {
    std::vector<Plane> planes(faces.size());
    std::ranges::transform(faces, planes.begin(), [&](const LabelledFace& face) {
        return by_label[static_cast<std::size_t>(face.label)];
    });
    return planes;
}

/// Merges faces between which a low step is left. @param first planes by face @return false if there are none
bool merge_coplanar(std::vector<LabelledFace>& faces, std::vector<Plane>& first, const FittedFaces& fitted,
                    double price, const BuildingGrid& grid, const RoofLattice& lattice, Geos& geos) {
    const std::vector<std::int32_t> merged =
        merged_faces(face_edges(faces), fitted.planes, fitted.cells, price, grid, lattice);
    std::vector<std::int32_t> labels(grid.size(), -1);  // of the cells of merged faces
    std::vector<bool> grown(faces.size(), false);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        faces[i].label = merged[i];
        if (merged[i] != static_cast<std::int32_t>(i))
            grown[static_cast<std::size_t>(merged[i])] = true;
    }
    if (std::ranges::find(grown, true) == grown.end())
        return false;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (grown[static_cast<std::size_t>(merged[i])])
            for (const std::size_t cell : fitted.cells[i])
                labels[cell] = merged[i];
    const std::vector<Plane> planes = fit_planes(grid, labels, faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (grown[i])
            first[i] = planes[i];
    faces = dissolve(std::move(faces), geos);
    first = planes_of(faces, first);
    return true;
}

}  // namespace

double slope_degrees(const FaceMeasure& face) {
    return std::atan(face.slope) * degrees_per_radian;
}

Roof make_roof(const contours::BuildingCells& cells, const FinePolygon& footprint,
               const RoofParameters& options, Geos& geos, const StopToken& stop) {
    const BuildingGrid grid =
        make_building_grid(cells, box_of(footprint), margin, options.cell, options.metres);
    const PlaneSegments segments = options.tiers
                                       ? level_segments(cells, *options.tiers, grid, options.metres, stop)
                                       : segment_planes(grid, options.segments, stop);
    const double price = coplanar_price * options.segments.price_m3 / grid.cell_m;
    const NearestLabels nearest = nearest_labels(segments.labels, grid.rows, grid.cols);
    const RoofLattice lattice(grid, options.cell_centre);
    const FinePolygon area = refined(footprint);
    std::vector<LabelledFace> faces =
        partition(area, border_lines(grid, nearest, segments.planes, options.borders), nearest.labels, grid,
                  lattice, geos, stop);
    std::vector<Plane> first = planes_of(faces, segments.planes);
    FittedFaces fitted = fit_faces(faces, first, options.tiers.has_value(), grid, lattice);
    for (int round = 0; !options.tiers && round < merge_rounds &&
                        merge_coplanar(faces, first, fitted, price, grid, lattice, geos);
         ++round)
        fitted = fit_faces(faces, first, options.tiers.has_value(), grid, lattice);
    const std::vector<FacePlane>& planes = fitted.planes;
    const std::vector<std::vector<std::size_t>>& inside = fitted.cells;
    const std::vector<std::vector<double>> elevations = corner_elevations(faces, planes, lattice);

    Roof roof;
    std::vector<std::int32_t> sides(grid.size(), 0);
    double whole = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        RoofFace& face = roof.faces.emplace_back(RoofFace{faces[i].outline, elevations[i], {}});
        for (double& z : face.elevations)
            z += grid.datum;
        face.measure = measured(planes[i].plane, inside[i], grid);
        face.measure.area = area_in_cells(face.outline);
        whole += face.measure.area;
        const bool trusted =
            !planes[i].level && face.measure.near >= least_near && is_wide(inside[i], grid, sides);
        face.measure.kind = !trusted                                     ? FaceKind::doubtful
                            : slope_degrees(face.measure) < flat_degrees ? FaceKind::flat
                                                                         : FaceKind::pitched;
    }
    for (RoofFace& face : roof.faces)
        face.measure.area /= whole;
    summarize(roof, planes, lattice, grid.cell_m, roundness_of(area.exterior, lattice));
    return roof;
}

}  // namespace d2b::roofs
