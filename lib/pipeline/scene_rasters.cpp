#include "pipeline/scene_rasters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace d2b {
namespace {

constexpr std::int32_t rows_at_once = 256;

/// Rows of a grid.
void write_grid(RasterSink& sink, const MetreGrid& grid, RowBand rows) {
    for (std::int32_t r = rows.begin; r < rows.end; r += rows_at_once) {
        const std::int32_t some = std::min(rows_at_once, rows.end - r);
        sink.write(
            some, {grid.row(r).data(), static_cast<std::size_t>(some) * static_cast<std::size_t>(grid.cols)});
    }
}

/// The same, value(i) for each cell: i is its index in a grid of as many columns.
void write_values(RasterSink& sink, RowBand rows, std::int32_t cols,
                  const std::function<float(std::size_t i)>& value) {
    std::vector<float> values;
    std::size_t next = static_cast<std::size_t>(rows.begin) * static_cast<std::size_t>(cols);
    for (std::int32_t r = rows.begin; r < rows.end; r += rows_at_once) {
        const std::int32_t some = std::min(rows_at_once, rows.end - r);
        values.resize(static_cast<std::size_t>(some) * static_cast<std::size_t>(cols));
        for (float& each : values)
            each = value(next++);
        sink.write(some, values);
    }
}

/// Heights above the ground; of the canopy 0 where no plant stands.
class Heights {
  public:
    Heights(const Scene& scene, const Detection& detection, double min_height)
        : scene_(scene), detection_(detection), least_(static_cast<float>(min_height)) {}

    [[nodiscard]] float height(std::size_t i) const { return scene_.height(i); }
    [[nodiscard]] float canopy(std::size_t i) const {
        const float height = scene_.height(i);
        const Label label = detection_.labels.values[i];
        const bool building = label != 0 && label <= detection_.buildings;
        return !std::isnan(height) && (building || height <= least_) ? 0 : height;
    }

  private:
    const Scene& scene_;
    const Detection& detection_;
    float least_;
};

}  // namespace

void write_scene_rasters(const Sinks& sinks, const Scene& scene, const Detection& detection,
                         double min_height, RowBand rows) {
    const Heights heights(scene, detection, min_height);
    if (sinks.ground != nullptr)
        write_grid(*sinks.ground, scene.terrain, rows);
    if (sinks.height != nullptr)
        write_values(*sinks.height, rows, scene.surface.cols,
                     [&](std::size_t i) { return heights.height(i); });
    if (sinks.canopy != nullptr)
        write_values(*sinks.canopy, rows, scene.surface.cols,
                     [&](std::size_t i) { return heights.canopy(i); });
}

}  // namespace d2b
