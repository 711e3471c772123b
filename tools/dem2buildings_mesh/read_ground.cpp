// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem2buildings_mesh/read_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/invalid_elevations.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/side_rasters.hpp"

namespace d2b::mesh {
namespace {

Position at(const AffineTransform& g, double col, double row) {
    return {g[0] + col * g[1] + row * g[2], g[3] + col * g[4] + row * g[5]};
}

/// Points along the border of a raster.
std::vector<Position> border(const DemInfo& raster) {
    constexpr int parts = 16;
    std::vector<Position> points;
    for (int i = 0; i <= parts; ++i) {
        const double col = static_cast<double>(raster.cols) * i / parts;
        const double row = static_cast<double>(raster.rows) * i / parts;
        points.push_back(at(raster.transform, col, 0));
        points.push_back(at(raster.transform, col, raster.rows));
        points.push_back(at(raster.transform, 0, row));
        points.push_back(at(raster.transform, raster.cols, row));
    }
    return points;
}

/// The grid of the raster, in the CRS of the city: its own where both have the same.
DemInfo grid_of(const DemInfo& raster, const CityModel& city, const Crs& crs) {
    DemInfo grid = raster;
    grid.name = city.name;
    grid.crs_wkt = crs.wkt();
    grid.window = {0, 0, raster.rows, raster.cols};
    if (raster.crs_wkt.empty() || grid.crs_wkt.empty())
        return grid;
    const std::vector<Position> before = border(raster);
    std::vector<Position> after = before;
    CoordinateTransform(Crs(raster.crs_wkt), crs, before).apply(after);
    const double cell = std::abs(raster.transform[1]) + std::abs(raster.transform[4]);
    constexpr double share = 1e-3;  // of a cell
    if (std::ranges::equal(before, after, [&](const Position& a, const Position& b) {
            return std::hypot(a.x - b.x, a.y - b.y) < cell * share;
        }))
        return grid;
    Position low = after.front();
    Position high = low;
    for (const Position& point : after) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    grid.transform = {low.x, (high.x - low.x) / raster.cols, 0, high.y, 0, (low.y - high.y) / raster.rows};
    return grid;
}

/// Transform from the plane of the plan to cells, derived from three points.
GroundGrid::Affine to_cells(const DemInfo& grid, const PlanFrame& frame) {
    const Position origin = frame.plane(at(grid.transform, 0, 0));
    const Position right = frame.plane(at(grid.transform, 1, 0));
    const Position below = frame.plane(at(grid.transform, 0, 1));
    const double ux = right.x - origin.x;
    const double uy = right.y - origin.y;
    const double vx = below.x - origin.x;
    const double vy = below.y - origin.y;
    const double determinant = ux * vy - uy * vx;
    return {(-origin.x * vy + origin.y * vx) / determinant, vy / determinant,  -vx / determinant,
            (origin.x * uy - origin.y * ux) / determinant,  -uy / determinant, ux / determinant};
}

}  // namespace

GroundGrid read_ground(const MeshRequest& request, const CityModel& city, const Crs& crs,
                       const PlanFrame& frame, const Callbacks& callbacks) {
    const std::string& path = request.ground;
    ReadOptions options;
    options.source = path;
    const DemInfo grid = grid_of(open_dem(options)->info(), city, crs);
    const double unit = frame.surface.vertical_metres;
    const std::unique_ptr<DemSource> source =
        reading::open_terrain(path, grid, unit, land_elevations.times(1 / unit), callbacks,
                              {reading::TerrainGaps::expected, request.keeps_undeclared});
    std::vector<double> elevations(static_cast<std::size_t>(grid.window.points()));
    source->read(grid.window, elevations);
    for (const std::string& warning : source->take_warnings())
        if (callbacks.on_warning)
            callbacks.on_warning(warning);
    if (std::ranges::all_of(elevations, [](double z) { return std::isnan(z); }))
        throw InputError("The terrain '" + path + "' has no elevations; give one that -write_ground wrote.");
    for (double& z : elevations)
        z = (z - frame.surface.translate[2]) / frame.surface.scale[2];
    return {grid.rows, grid.cols, std::move(elevations), to_cells(grid, frame)};
}

}  // namespace d2b::mesh
