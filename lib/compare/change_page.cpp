#include "compare/change_page.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/change_layer.hpp"
#include "geometry/overlay.hpp"
#include "view/page/page_sink.hpp"
#include "write/file_target.hpp"

namespace d2b::compare {
namespace {

constexpr double step_m = 0.01;             // of plane coordinates
constexpr double height_step_m = 0.001;     // of heights, as pages have them
constexpr double margin_m = 20;             // of ground around the buildings
constexpr double unknown_height_m = 0.1;    // of a block whose height is not known
constexpr std::int32_t ground_samples = 2;  // per side of the level ground

/// Puts buildings of a survey into the blocks of a page.
class ChangeBlocks {
  public:
    ChangeBlocks(const Box& box, const score::MeasurePlane& plane)
        : frame_{{step_m / plane.metres, step_m / plane.metres, height_step_m},
                 {box.left, box.low, 0},
                 plane.metres,
                 1,
                 {box.left * plane.metres, box.low * plane.metres, 0}} {}

    [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
    /// @param values of its fields
    [[nodiscard]] SurfacePart block(std::int64_t id, const SurveyedPlace& place,
                                    std::span<const std::size_t> indices, double height_m,
                                    std::vector<FieldValue> values) const;

  private:
    [[nodiscard]] std::vector<SurfacePoint> ring_of(const WorldRing& ring) const;

    SurfaceFrame frame_;
};

std::vector<SurfacePoint> ChangeBlocks::ring_of(const WorldRing& ring) const {
    std::vector<SurfacePoint> points;
    for (const Position& p : ring)
        points.push_back({std::llround((p.x - frame_.translate[0]) / frame_.scale[0]),
                          std::llround((p.y - frame_.translate[1]) / frame_.scale[1]), 0});
    return points;
}

SurfacePart ChangeBlocks::block(std::int64_t id, const SurveyedPlace& place,
                                std::span<const std::size_t> indices, double height_m,
                                std::vector<FieldValue> values) const {
    SurfaceBuilding building;
    building.id = id;
    building.values = std::move(values);
    building.roof = std::llround((std::isnan(height_m) ? unknown_height_m : height_m) / height_step_m);
    for (const std::size_t i : indices)
        for (const WorldPolygon& polygon : place.buildings[i].outline) {
            SurfaceTier& tier = building.tiers.emplace_back();
            tier.top = building.roof;
            tier.rings.push_back(ring_of(polygon.exterior));
            for (const WorldRing& hole : polygon.interiors)
                tier.rings.push_back(ring_of(hole));
        }
    SurfacePart part;
    part.buildings.push_back(std::move(building));
    return part;
}

Box box_around(const SurveyedPlace& old_place, const SurveyedPlace& new_place, double margin) {
    Box box;
    for (const SurveyedPlace* place : {&old_place, &new_place})
        for (const SurveyedBuilding& building : place->buildings)
            box.add(box_of(building.outline));
    if (box.empty())
        box.add(Position{0, 0});
    return {box.left - margin, box.low - margin, box.right + margin, box.high + margin};
}

SurfaceMeta meta_of(const ChangeBlocks& blocks, const Box& box, const score::MeasurePlane& plane) {
    SurfaceMeta meta;
    meta.frame = blocks.frame();
    meta.fields = change_fields();
    meta.fields.push_back({"survey", "Survey", FieldType::text, "", "old or new"});
    meta.fields.push_back({"p90", "Height (m)", FieldType::real, "m", "height in this survey"});
    meta.provenance.crs_wkt = plane.crs.wkt();
    meta.corners = {
        Position{box.left, box.high}, {box.left, box.low}, {box.right, box.low}, {box.right, box.high}};
    meta.block_style = change_style();
    meta.block_style.colour = "p90";
    meta.tier_style = meta.block_style;
    meta.first_fields = {"change", "p90_old", "p90_new", "rise", "area_old", "area_new"};
    meta.alternatives = "survey";
    return meta;
}

}  // namespace

std::unique_ptr<SurfaceSink> open_change_page(const SurveyRequest& request) {
    DemInfo ground;
    ground.window = {0, 0, ground_samples, ground_samples};
    view::Page page = view::open_page(
        writing::resolve_file_target({request.page,
                                      request.overwrite,
                                      {request.old_survey, request.new_survey, request.destination},
                                      writing::FileKind::page}),
        {.dem = ground, .title = request.title, .credit = request.credit});
    const std::array<float, std::size_t{ground_samples} * ground_samples> level{};
    page.relief->write(ground.window, level);
    return std::move(page.surface);
}

void write_change_page(const SurveyChanges& changes, const SurveyedPlace& old_place,
                       const SurveyedPlace& new_place, const score::MeasurePlane& plane, SurfaceSink& page) {
    const Box box = box_around(old_place, new_place, margin_m / plane.metres);
    const ChangeBlocks blocks(box, plane);
    page.begin(meta_of(blocks, box, plane));
    std::int64_t id = 0;
    for (const ChangedBuilding& building : changes.buildings) {
        ++id;
        const auto add = [&](const SurveyedPlace& place, std::span<const std::size_t> indices, double p90_m,
                             const char* survey) {
            if (indices.empty())
                return;
            std::vector<FieldValue> values = change_values(building, id, old_place, new_place);
            values.emplace_back(std::string(survey));
            values.push_back(std::isnan(p90_m) ? FieldValue{} : FieldValue{p90_m});
            page.add(blocks.block(id, place, indices, p90_m, std::move(values)));
        };
        add(old_place, building.old_indices, building.p90_old_m, "old");
        add(new_place, building.new_indices, building.p90_new_m, "new");
    }
}

}  // namespace d2b::compare
