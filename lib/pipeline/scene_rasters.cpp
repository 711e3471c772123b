#include "pipeline/scene_rasters.hpp"

#include <cmath>

#include "pipeline/side_grids.hpp"

namespace d2b {
namespace {

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
