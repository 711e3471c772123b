#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/contour_drawer.hpp"
#include "features/write_features.hpp"

namespace d2b::features {

/// Layer of the faces of the roofs of written buildings.
class RoofLayer {
  public:
    /// @param setup, roofs must outlive this @param layer index of the layer in the sink
    RoofLayer(const RunSetup& setup, const StoredRoofs& roofs, std::size_t layer)
        : setup_(setup), roofs_(roofs), layer_(layer) {}

    /// Records a building that is written. @param roof its index among the roofs @param area_m2 of its
    /// outline
    void note(std::size_t roof, const BuildingRecord& record, double area_m2) {
        buildings_.push_back({roof, record.id, record.whole, area_m2});
    }
    /// Writes the faces of the recorded buildings in their order. @param makers one per thread
    /// @throws OutputError
    void write(std::vector<PolygonMaker>& makers, FeatureSink& sink, Context& context) const;

  private:
    struct Building {
        std::size_t roof;
        std::int64_t id;
        std::int64_t whole;
        double area_m2;
    };
    struct Face {
        RoofFaceRecord record;
        FeaturePolygon made;
    };
    [[nodiscard]] std::vector<Face> draw(const Building& building, PolygonMaker& maker) const;

    const RunSetup& setup_;
    const StoredRoofs& roofs_;
    std::size_t layer_;
    std::vector<Building> buildings_;
};

}  // namespace d2b::features
