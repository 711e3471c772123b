#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "features/polygon_maker.hpp"
#include "features/rounded_polygons.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// Layer of contours that were dropped, filled or changed: their traced shape with the reason.
class RejectedLayer {
  public:
    /// @param input must outlive this @param layer index of the layer in the sink
    RejectedLayer(const FeatureInput& input, std::size_t layer) : input_(input), layer_(layer) {}

    /// Records a contour whose polygon differs from what was requested.
    void note(std::size_t contour, LayerRole role, std::int64_t id, const FeaturePolygon& made);
    /// Writes contours dropped or filled by filters, in the order of keys, followed by the recorded ones.
    /// @param makers one per thread @param rounded null if the destination does not round
    /// @throws OutputError
    void write(std::vector<PolygonMaker>& makers, FeatureSink& sink, RoundedPolygons* rounded,
               Context& context) const;

  private:
    struct Changed {
        std::size_t contour;
        RejectedRecord record;
    };
    struct Drawn {
        RejectedRecord record;
        FeaturePolygon made;
    };
    [[nodiscard]] Drawn draw(std::size_t i, PolygonMaker& maker) const;

    const FeatureInput& input_;
    std::size_t layer_;
    std::vector<Changed> changed_;
};

}  // namespace d2b
