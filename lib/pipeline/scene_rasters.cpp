#include "pipeline/scene_rasters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace d2b {
namespace {

constexpr std::int32_t rows_given_at_once = 256;

/// Writes value(i) for each of the unit's own cells, i being the index in a grid of the unit's extent.
template <typename Value>
void write_values(RasterSink& sink, const Unit& unit, const Value& value) {
    std::vector<float> values;
    for (std::int32_t row = unit.own.row; row < unit.own.end_row(); row += rows_given_at_once) {
        const Window part{row, unit.own.col, std::min(rows_given_at_once, unit.own.end_row() - row),
                          unit.own.cols};
        values.clear();
        for (std::int32_t r = part.row; r < part.end_row(); ++r) {
            const auto first = static_cast<std::size_t>(std::int64_t{r - unit.seen.row} * unit.seen.cols +
                                                        (part.col - unit.seen.col));
            for (std::size_t i = first; i < first + static_cast<std::size_t>(part.cols); ++i)
                values.push_back(value(i));
        }
        sink.write(part, values);
    }
}

/// Heights above the ground. The canopy height of a cell without vegetation is 0.
class Heights {
  public:
    Heights(const Scene& scene, const Detection& detection, double min_height)
        : scene_(scene), detection_(detection), least_(static_cast<float>(min_height)) {}

    [[nodiscard]] float height(std::size_t i) const { return scene_.height(i); }
    [[nodiscard]] float canopy(std::size_t i) const {
        const float height = scene_.height(i);
        const bool building = detection_.is_building(detection_.labels.values[i]);
        return !std::isnan(height) && (building || height <= least_) ? 0 : height;
    }

  private:
    const Scene& scene_;
    const Detection& detection_;
    float least_;
};

}  // namespace

void write_scene_rasters(const Sinks& sinks, const Scene& scene, const Detection& detection,
                         double min_height, const Unit& unit) {
    const Heights heights(scene, detection, min_height);
    if (sinks.ground != nullptr)
        write_values(*sinks.ground, unit, [&](std::size_t i) { return scene.terrain.values[i]; });
    if (sinks.height != nullptr)
        write_values(*sinks.height, unit, [&](std::size_t i) { return heights.height(i); });
    if (sinks.canopy != nullptr)
        write_values(*sinks.canopy, unit, [&](std::size_t i) { return heights.canopy(i); });
}

}  // namespace d2b
