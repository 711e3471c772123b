#include "features/roof_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include "diagnose/warnings.hpp"
#include "features/attribute_table.hpp"
#include "roofs/roof_type.hpp"

namespace d2b::features {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::string_view kind_name(roofs::FaceKind kind) {
    return kind == roofs::FaceKind::flat ? "flat" : kind == roofs::FaceKind::pitched ? "pitched" : "doubtful";
}

/// Direction in which water runs, along x and y of the raster's CRS.
Position fall_of(const roofs::FaceMeasure& face, const RunSetup& setup) {
    const double stretch = x_stretch(setup.georeference, setup.crs, setup.dem.window);
    const auto unit = [&](Position step) {
        const double length = std::hypot(step.x * stretch, step.y);
        return Position{step.x * stretch / length, step.y / length};
    };
    const Position col = unit(setup.georeference.step(0, 1));
    const Position row = unit(setup.georeference.step(1, 0));
    // The gradient rises by slope_col along a row and by slope_row down a column.
    const double determinant = col.x * row.y - col.y * row.x;
    return {(face.slope_row * col.y - face.slope_col * row.y) / determinant,
            (face.slope_col * row.x - face.slope_row * col.x) / determinant};
}

void count(const RoofFaceRecord& face, RunReport& report) {
    RoofReport& roofs = *report.roofs;
    roofs.area_m2 += face.area_m2;
    if (face.kind == kind_name(roofs::FaceKind::doubtful)) {
        ++roofs.doubtful;
        roofs.doubtful_area_m2 += face.area_m2;
        report.count(Reason::roof_face_doubtful);
    } else {
        ++(face.kind == kind_name(roofs::FaceKind::flat) ? roofs.flat : roofs.pitched);
    }
}

}  // namespace

std::vector<RoofLayer::Face> RoofLayer::draw(const Building& building, PolygonMaker& maker) const {
    std::vector<Face> faces;
    const std::optional<roofs::Roof> roof = roofs_.roof(building.roof);
    if (!roof)
        return faces;
    for (const roofs::RoofFace& face : roof->faces) {
        const roofs::FaceMeasure& measure = face.measure;
        const double slope = roofs::slope_degrees(measure);
        Face& drawn = faces.emplace_back();
        drawn.made = maker.roof_face(face);
        RoofFaceRecord& record = drawn.record;
        record.building_id = building.id;
        record.whole = building.whole;
        record.slope = measure.kind == roofs::FaceKind::doubtful ? no_value : slope;
        record.azimuth = measure.kind == roofs::FaceKind::pitched
                             ? maker.azimuth(setup_.georeference.position(face.outline.exterior.front(),
                                                                          roofs::roof_steps),
                                             fall_of(measure, setup_))
                             : no_value;
        record.area_m2 = measure.area * building.area_m2;
        record.roof_m2 = record.area_m2 / std::cos(slope * std::numbers::pi / 180);
        const auto [low, high] = std::ranges::minmax(face.elevations);
        record.lowest = low / maker.metres();
        record.highest = high / maker.metres();
        record.rmse_m = measure.rmse_m;
        record.cells = measure.cells;
        record.kind = kind_name(measure.kind);
    }
    return faces;
}

void RoofLayer::write(std::vector<PolygonMaker>& makers, FeatureSink& sink, Context& context) const {
    std::int64_t id = sink.first_id();
    context.report.roofs.emplace().level = roofs_.are_level();
    draw_in_order(
        *context.threads, buildings_.size(),
        [&](std::size_t i, std::size_t thread) { return draw(buildings_[i], makers[thread]); },
        [&](std::size_t, std::vector<Face>&& faces) {
            const StageClock clock(context.report, Stage::write);
            for (Face& face : faces) {
                if (face.made.parts.empty()) {
                    context.report.count(Reason::outline_split);
                    continue;
                }
                count(face.record, context.report);
                face.record.id = id++;
                sink.add(layer_, {field_values(roof_face_attributes(), face.record),
                                  std::move(face.made.parts), 0, face.record});
            }
        });
    diagnose::warn_unless_empty(diagnose::doubtful_roofs_warning(*context.report.roofs), context);
}

}  // namespace d2b::features
