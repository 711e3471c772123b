#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem2buildings/feature_sink.hpp"
#include "features/emit.hpp"
#include "features/placer.hpp"

namespace d2b {

/// The layer of what was dropped, filled or changed on its way, as it was traced, with the reason.
class RejectedLayer {
  public:
    /// @param emission must outlive this @param layer index of the layer in the sink
    RejectedLayer(const Emission& emission, std::size_t layer) : emission_(emission), layer_(layer) {}

    /// Takes a contour down where its polygon is not what was asked for.
    void note(std::size_t contour, LayerRole role, std::int64_t id, const Placed& placed);
    /// Writes what the filters dropped and filled, in the order of keys, and then what was taken down.
    /// @param placers one a thread @throws OutputError
    void write(std::vector<Placer>& placers, FeatureSink& sink, Context& context) const;

  private:
    struct Changed {
        std::size_t contour;
        RejectedRecord record;
    };
    struct Drawn {
        RejectedRecord record;
        Placed placed;
    };
    [[nodiscard]] Drawn draw(std::size_t i, Placer& placer) const;

    const Emission& emission_;
    std::size_t layer_;
    std::vector<Changed> changed_;
};

}  // namespace d2b
