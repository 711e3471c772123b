#include "pipeline/extract_roofs.hpp"

#include <algorithm>
#include <limits>

#include "contours/clean_tiers.hpp"
#include "contours/for_each_building.hpp"
#include "diagnose/warnings.hpp"
#include "geometry/geos.hpp"

namespace d2b::pipeline {

roofs::RoofParameters roof_parameters(const features::RunSetup& setup, const RunReport& report) {
    const double metres = report.units.vertical_metres;
    const double detail = setup.plan.detail;
    roofs::RoofParameters parameters;
    parameters.segments.price_m3 = 2 * detail * detail * std::max(1.0, setup.cell_m());
    parameters.segments.min_area_m2 = setup.plan.asked.roofs.min_area_m2;
    parameters.cell = setup.cell;
    parameters.metres = metres;
    if (roofs_are_level(report))
        parameters.tiers = contours::region_options(detail, setup.cell, metres);
    parameters.cell_centre = setup.plan.trace == TraceMode::points ? 0 : 0.5;
    return parameters;
}

bool roofs_are_level(const RunReport& report) {
    return report.sampling && diagnose::is_blurred(*report.sampling);
}

RoofRecord roof_record(const roofs::Roof& roof, double metres) {
    RoofRecord record;
    record.type = roof.type;
    record.rmse_m = roof.rmse_m;
    record.ridge_z = -std::numeric_limits<double>::infinity();
    for (const roofs::RoofFace& face : roof.faces) {
        const auto [low, high] = std::ranges::minmax(face.elevations);
        record.ridge_z = std::max(record.ridge_z, high / metres);
        record.eave_z += face.measure.area * low / metres;
        if (face.measure.kind == roofs::FaceKind::flat)
            record.flat_share += face.measure.area;
    }
    return record;
}

namespace {

/// Contours of level 1, by the label of their building.
std::vector<std::vector<std::size_t>> footprints_by_label(const contours::ContourList& contours,
                                                          Label count) {
    std::vector<std::vector<std::size_t>> footprints(count + std::size_t{1});
    for (std::size_t i = 0; i < contours.size(); ++i)
        if (const contours::ContourHead& head = contours.head(i); head.key.level == 1 && head.label <= count)
            footprints[head.label].push_back(i);
    return footprints;
}

}  // namespace

RoofExtractor::RoofExtractor(const contours::ContourList& contours, const outline::Outliner& outliner,
                             Label buildings, const features::RunSetup& setup, Context& context)
    : outliner_(outliner),
      context_(context),
      parameters_(roof_parameters(setup, context.report)),
      footprints_(footprints_by_label(contours, buildings)),
      roofs_(context.make_spool(), contours.size(), roofs_are_level(context.report)) {}

void RoofExtractor::extract(Label label, const contours::BuildingCells& cells) {
    if (label >= footprints_.size() || footprints_[label].empty())
        return;
    const StopToken& stop = context_.threads->stop();
    Geos geos(stop);
    for (const std::size_t contour : footprints_[label]) {
        const roofs::Roof roof =
            roofs::make_roof(cells, outliner_.footprint(contour), parameters_, geos, stop);
        roofs_.put(contour, roof, roof_record(roof, parameters_.metres));
    }
}

features::StoredRoofs extract_roofs(ElevationReader& reader, const FoundBuildings& found,
                                    const contours::ContourList& contours, const outline::Outliner& outliner,
                                    const features::RunSetup& setup, Context& context) {
    RoofExtractor roofs(contours, outliner, found.buildings, setup, context);
    contours::for_each_building(
        reader, found.labels, found.count(), setup.dem.window, Stage::roofs, context,
        [&](Label label, contours::BuildingCells&& cells) { roofs.extract(label, cells); });
    return roofs.take();
}

}  // namespace d2b::pipeline
