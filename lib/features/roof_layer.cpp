#include "features/roof_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "diagnose/warnings.hpp"
#include "features/attribute_table.hpp"
#include "roofs/roof_type.hpp"

namespace d2b::features {

std::string_view face_kind_name(roofs::FaceKind kind) {
    return kind == roofs::FaceKind::flat ? "flat" : kind == roofs::FaceKind::pitched ? "pitched" : "doubtful";
}

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

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
    if (face.kind == face_kind_name(roofs::FaceKind::doubtful)) {
        ++roofs.doubtful;
        roofs.doubtful_area_m2 += face.area_m2;
        report.count(Reason::roof_face_doubtful);
    } else {
        ++(face.kind == face_kind_name(roofs::FaceKind::flat) ? roofs.flat : roofs.pitched);
    }
}

}  // namespace

std::vector<DrawnFace> draw_faces(const roofs::Roof& roof, double area_m2, const RunSetup& setup,
                                  PolygonMaker& maker) {
    std::vector<DrawnFace> faces;
    for (const roofs::RoofFace& face : roof.faces) {
        FeaturePolygon made = maker.roof_face(face);
        if (made.parts.empty())
            continue;
        const roofs::FaceMeasure& measure = face.measure;
        const double slope = roofs::slope_degrees(measure);
        DrawnFace& drawn = faces.emplace_back();
        drawn.parts = std::move(made.parts);
        RoofFaceRecord& record = drawn.record;
        record.slope = measure.kind == roofs::FaceKind::doubtful ? no_value : slope;
        record.azimuth =
            measure.kind == roofs::FaceKind::pitched
                ? maker.azimuth(setup.georeference.position(face.outline.exterior.front(), roofs::roof_steps),
                                fall_of(measure, setup))
                : no_value;
        record.area_m2 = measure.area * area_m2;
        record.roof_m2 = record.area_m2 / std::cos(slope * std::numbers::pi / 180);
        const auto [low, high] = std::ranges::minmax(face.elevations);
        record.lowest = low / maker.metres();
        record.highest = high / maker.metres();
        record.rmse_m = measure.rmse_m;
        record.cells = measure.cells;
        record.kind = face_kind_name(measure.kind);
    }
    return faces;
}

std::int64_t number_faces(std::vector<DrawnFace>& faces, const BuildingRecord& building,
                          std::int64_t first_id) {
    for (DrawnFace& face : faces) {
        face.record.id = first_id++;
        face.record.building_id = building.id;
        face.record.whole = building.whole;
    }
    return first_id;
}

RoofLayer::RoofLayer(std::size_t layer, bool level, FeatureSink& sink, Context& context)
    : layer_(layer), sink_(sink), context_(context) {
    context.report.roofs.emplace().level = level;
}

void RoofLayer::add(std::vector<DrawnFace>&& faces) {
    const StageClock clock(context_.report, Stage::write);
    for (DrawnFace& face : faces) {
        count(face.record, context_.report);
        sink_.add(layer_,
                  {field_values(roof_face_attributes(), face.record), std::move(face.parts), 0, face.record});
    }
}

void RoofLayer::finish() {
    diagnose::warn_unless_empty(diagnose::doubtful_roofs_warning(*context_.report.roofs), context_);
}

}  // namespace d2b::features
