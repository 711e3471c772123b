#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/context.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/sinks.hpp"
#include "features/contour_drawer.hpp"
#include "features/run_setup.hpp"
#include "roofs/make_roof.hpp"

namespace d2b::features {

/// Draws the faces of a roof. Those that the output CRS tears are left out. @param area_m2 of its outline
[[nodiscard]] std::vector<DrawnFace> draw_faces(const roofs::Roof& roof, double area_m2,
                                                const RunSetup& setup, PolygonMaker& maker);

/// Names the building of faces, and numbers them from an id on. @return the id after the last one
std::int64_t number_faces(std::vector<DrawnFace>& faces, const BuildingRecord& building,
                          std::int64_t first_id);

[[nodiscard]] std::string_view face_kind_name(roofs::FaceKind kind);

/// Layer of the faces of the roofs of written buildings.
class RoofLayer {
  public:
    /// @param layer index of the layer in the sink @param level true if no face has a slope
    /// @param sink, context must outlive this
    RoofLayer(std::size_t layer, bool level, FeatureSink& sink, Context& context);

    /// Writes the numbered faces of a building, and counts them. @throws OutputError
    void add(std::vector<DrawnFace>&& faces);
    /// Warns if many faces are doubtful.
    void finish();

  private:
    std::size_t layer_;
    FeatureSink& sink_;
    Context& context_;
};

}  // namespace d2b::features
