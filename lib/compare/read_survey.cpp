#include "compare/read_survey.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "compare/height_grid.hpp"
#include "core/number_from_chars.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/run.hpp"
#include "read/field_layer.hpp"
#include "read/polygon_layer.hpp"

namespace d2b::compare {
namespace {

/// Places of the fields in a row of values.
enum Field { id, p90, p50, p70, p95, height, confidence, cells };

const std::vector<reading::WantedField>& wanted_fields() {
    static const std::vector<reading::WantedField> fields{{{"id", "ID_BUILD", "unique_id"}},
                                                          {{"p90", "ROOF_HEIGHT"}},
                                                          {{"p50"}, false},
                                                          {{"p70"}, false},
                                                          {{"p95"}, false},
                                                          {{"height"}, false},
                                                          {{"confidence"}, false},
                                                          {{"n_cells"}, false}};
    return fields;
}

double number_of(const reading::FieldFeature& feature, Field field) {
    const std::optional<std::string>& text = feature.values[field];
    double value = RoofHeights::nan;
    if (!text)
        return value;
    const char* const end = text->data() + text->size();
    const auto [stop, error] = number_from_chars(text->data(), end, value);
    return error == std::errc() && stop == end ? value : RoofHeights::nan;
}

/// Collects what a comparison needs of the buildings of a survey.
class SurveyCollector {
  public:
    explicit SurveyCollector(const Crs& crs) : geodesy_(crs) {}

    void add(SurveyedBuilding building, Polygons outline, double cells) {
        if (!overlay_.valid(outline))
            outline = overlay_.make_valid(outline);
        if (outline.empty())
            return;
        for (const WorldPolygon& polygon : outline)
            building.area_m2 += geodesy_.polygon(polygon).area_m2;
        building.outline = std::move(outline);
        if (cells > 0)
            areas_per_cell_.push_back(building.area_m2 / cells);
        place_.buildings.push_back(std::move(building));
    }
    /// Side of a cell in metres: the median, because straight walls make buildings larger or smaller.
    [[nodiscard]] std::optional<double> cell_m() {
        if (areas_per_cell_.empty())
            return std::nullopt;
        return std::sqrt(upper_median(areas_per_cell_));
    }
    [[nodiscard]] SurveyedPlace take() { return std::move(place_); }

  private:
    Geodesy geodesy_;
    Overlay overlay_;
    SurveyedPlace place_;
    std::vector<double> areas_per_cell_;
};

void collect(const reading::FieldLayer& layer, SurveyCollector& collector) {
    for (const reading::FieldFeature& feature : layer.features) {
        SurveyedBuilding building;
        building.id = std::llround(number_of(feature, id));
        building.heights = {{number_of(feature, p50), number_of(feature, p70), number_of(feature, p90),
                             number_of(feature, p95)},
                            number_of(feature, height)};
        building.confidence = number_of(feature, confidence);
        collector.add(std::move(building), feature.shape.polygons, number_of(feature, cells));
    }
}

/// Keeps the buildings of a run in memory.
class SurveySink final : public FeatureSink {
  public:
    struct Found {
        BuildingRecord record;
        Polygons outline;
    };

    void begin(std::span<const LayerSpec> /*layers*/, const Provenance& provenance) override {
        crs_wkt_ = provenance.crs_wkt;
    }
    void add(std::size_t /*layer*/, const Feature& feature) override {
        found_.push_back({std::get<BuildingRecord>(feature.record), feature.parts});
    }
    void finish() override {}

    [[nodiscard]] const std::vector<Found>& found() const { return found_; }
    [[nodiscard]] const std::string& crs_wkt() const { return crs_wkt_; }

  private:
    std::vector<Found> found_;
    std::string crs_wkt_;
};

/// Keeps the heights above ground of a run in memory.
class HeightSink final : public RasterSink {
  public:
    explicit HeightSink(const DemInfo& dem) : grid_(dem.rows, dem.cols, dem.transform) {}

    void write(const Window& part, std::span<const float> values) override { grid_.set(part, values); }
    void finish() override {}
    [[nodiscard]] HeightGrid take() { return std::move(grid_); }

  private:
    HeightGrid grid_;
};

}  // namespace

ReadSurvey read_buildings(const std::string& dataset, Warnings& warnings) {
    const reading::FieldLayer layer =
        reading::read_field_layer({dataset, {}, {"buildings"}, {}, {}}, wanted_fields(), warnings);
    ReadSurvey survey{{dataset, layer.name, layer.features.size(), 0, {}}, Crs(layer.crs_wkt), {}};
    SurveyCollector collector(survey.crs);
    collect(layer, collector);
    survey.about.cell_m = collector.cell_m();
    survey.place = collector.take();
    return survey;
}

ReadSurvey find_buildings(const std::string& dsm, const Callbacks& callbacks) {
    Options options;
    options.read.source = dsm;
    options.write.layers = Layers::buildings;
    const Inputs inputs = open_inputs(options, callbacks);
    SurveySink sink;
    HeightSink heights(inputs.dem->info());
    static_cast<void>(run(options, inputs.sources(), {.features = sink, .height = &heights}, callbacks));
    ReadSurvey survey{{dsm, {}, sink.found().size(), 0, {}}, Crs(sink.crs_wkt()), {}};
    SurveyCollector collector(survey.crs);
    for (const SurveySink::Found& found : sink.found()) {
        SurveyedBuilding building;
        building.id = found.record.id;
        building.heights = {found.record.heights_m, found.record.height_m};
        building.confidence = found.record.confidence;
        collector.add(std::move(building), found.outline, static_cast<double>(found.record.cells));
    }
    survey.about.cell_m = collector.cell_m();
    survey.place = collector.take();
    survey.place.heights = SurveyHeights{heights.take()};
    return survey;
}

}  // namespace d2b::compare
