#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem2buildings/sinks.hpp"
#include "features/polygon_maker.hpp"
#include "features/rounded_polygons.hpp"
#include "features/write_features.hpp"

namespace d2b {

/// The layer of what was dropped, filled or changed on its way, as it was traced, with the reason.
class RejectedLayer {
  public:
    /// @param input must outlive this @param layer index of the layer in the sink
    RejectedLayer(const FeatureInput& input, std::size_t layer) : input_(input), layer_(layer) {}

    /// Takes a contour down where its polygon is not what was asked for.
    void note(std::size_t contour, LayerRole role, std::int64_t id, const FeaturePolygon& made);
    /// Writes what the filters dropped and filled, in the order of keys, and then what was taken down.
    /// @param makers one per thread @param rounded null where the destination does not round
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
