#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "compare/change_layer.hpp"
#include "compare/change_page.hpp"
#include "compare/find_changes.hpp"
#include "compare/height_grid.hpp"
#include "compare/surveyed_building.hpp"
#include "core/crs.hpp"
#include "core/number_from_chars.hpp"
#include "core/statistics.hpp"
#include "core/text.hpp"
#include "core/warnings.hpp"
#include "dem2buildings/compare.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"
#include "dem2buildings/version.hpp"
#include "read/field_layer.hpp"
#include "read/gdal_setup.hpp"
#include "read/polygon_layer.hpp"
#include "score/measure.hpp"
#include "write/vector/layer_sink.hpp"

namespace d2b::compare {
namespace {

/// Survey in its own CRS.
struct ReadSurvey {
    ComparedSurvey about;
    Crs crs;
    SurveyedPlace place;
};

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
    return parse_number<double>(text.value_or("")).value_or(RoofHeights::nan);
}

/// Collects a survey's buildings with the values that a comparison needs.
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

/// Reads the buildings of a result: its layer `buildings`, or the first one. Its cells follow from areas and
/// numbers of cells. @throws InputError: cannot be read @throws OptionError: a field is missing
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

/// Returns true if a message advises an option.
bool names_option(const std::string& message) {
    const std::size_t dash = message.find(" -");
    return dash != std::string::npos && dash + 2 < message.size() && std::isalpha(message[dash + 2]) != 0;
}

/// Finds the buildings of a DSM with the defaults. @throws Error as run()
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

/// Brings outlines to the plane of the comparison and to the CRS of the result.
void transform(ReadSurvey& survey, const score::MeasurePlane& plane, const Crs& written, Warnings& warnings) {
    SurveyedPlace& place = survey.place;
    std::vector<Polygons> outlines;
    for (SurveyedBuilding& building : place.buildings)
        outlines.push_back(std::move(building.outline));
    std::vector<Polygons> written_outlines = outlines;
    const std::string& name = survey.about.dataset;
    score::transform_to({written}, survey.crs, name, written_outlines, score::LongEdges::keep, warnings);
    score::transform_to(plane, survey.crs, name, outlines, score::LongEdges::keep, warnings);
    Overlay overlay;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        SurveyedBuilding& building = place.buildings[i];
        building.outline =
            overlay.valid(outlines[i]) ? std::move(outlines[i]) : overlay.make_valid(outlines[i]);
        building.written = std::move(written_outlines[i]);
    }
    std::erase_if(place.buildings, [](const SurveyedBuilding& building) { return building.outline.empty(); });
    if (place.heights && plane.crs.kind() != Crs::Kind::none && survey.crs.kind() != Crs::Kind::none &&
        plane.crs.wkt() != survey.crs.wkt() && !place.buildings.empty()) {
        const auto transform = std::make_shared<CoordinateTransform>(
            plane.crs, survey.crs, place.buildings.front().outline.front().exterior);
        place.heights->to_grid = [transform](std::span<Position> positions) {
            static_cast<void>(transform->try_apply(positions));
        };
    }
}

Box box_of_place(const SurveyedPlace& place) {
    Box box;
    for (const SurveyedBuilding& building : place.buildings)
        box.add(box_of(building.outline));
    return box;
}

/// Callbacks whose progress fills a part of the whole.
Callbacks part_of(const Callbacks& callbacks, double from, double to) {
    Callbacks part = callbacks;
    if (callbacks.on_progress)
        part.on_progress = [tell = callbacks.on_progress, from, to](double share) {
            return tell(from + share * (to - from));
        };
    return part;
}

struct BothSurveys {
    ReadSurvey old_survey;
    ReadSurvey new_survey;
};

BothSurveys read_both(const SurveyRequest& request, const Callbacks& callbacks, Warnings& warnings) {
    const bool old_found = reading::is_vector_dataset(request.old_survey);
    const bool new_found = reading::is_vector_dataset(request.new_survey);
    if (old_found != new_found) {
        const std::string& result = old_found ? request.old_survey : request.new_survey;
        const std::string& raster = old_found ? request.new_survey : request.old_survey;
        ReadOptions options;
        options.source = raster;
        static_cast<void>(open_dem(options));  // complains of a file that is no raster
        throw OptionError("'" + result + "' has buildings and '" + raster +
                          "' is a raster; give two results or two DSMs.");
    }
    if (old_found)
        return {read_buildings(request.old_survey, warnings), read_buildings(request.new_survey, warnings)};
    // A comparison has none of the options that its rasters' warnings advise.
    bool explained = false;
    Callbacks explaining = callbacks;
    if (callbacks.on_warning)
        explaining.on_warning = [&](const std::string& text) {
            callbacks.on_warning(text);
            if (explained || !names_option(text))
                return;
            explained = true;
            callbacks.on_warning(
                "These options are those of dem2buildings; to use them, run it on each DSM and "
                "compare the two results.");
        };
    ReadSurvey before = find_buildings(request.old_survey, part_of(explaining, 0, 0.45));
    return {std::move(before), find_buildings(request.new_survey, part_of(explaining, 0.45, 0.9))};
}

/// Opens the destination. @return null if there is none
std::unique_ptr<FeatureSink> open_destination(const SurveyRequest& request, const Callbacks& callbacks) {
    if (request.destination.empty())
        return nullptr;
    for (const std::string& source : {request.old_survey, request.new_survey})
        if (request.destination == source)
            throw OptionError("The destination '" + source + "' is a survey; give another name.");
    std::error_code error;
    if (!request.overwrite && std::filesystem::exists(request.destination, error))
        throw OptionError("\"" + request.destination +
                          "\" exists; give -overwrite to replace the changes in it, or another name.");
    WriteOptions options;
    options.destination = request.destination;
    options.format = request.format;
    options.overwrite = request.overwrite;
    return writing::open_layer_sink(options, "changes", callbacks);
}

void write(const SurveyChanges& changes, const BothSurveys& surveys, FeatureSink& sink, CommitList& commit) {
    const ComparedSurvey& before = surveys.old_survey.about;
    const ComparedSurvey& after = surveys.new_survey.about;
    const std::vector<LayerSpec> layers{change_layer(sink.layer_name(LayerRole::buildings, Layers::buildings),
                                                     before.dataset, after.dataset)};
    Provenance provenance;
    provenance.crs_wkt = surveys.new_survey.crs.wkt();
    provenance.metadata = {
        {"D2B_VERSION", std::string(version)},
        {"D2B_OLD", utf8_text(before.dataset)},
        {"D2B_NEW", utf8_text(after.dataset)},
        {"D2B_SHIFT_M", fixed_text(changes.shift.east_m, 2) + " " + fixed_text(changes.shift.north_m, 2)},
    };
    Position place;
    for (const ReadSurvey* survey : {&surveys.old_survey, &surveys.new_survey})
        if (!survey->place.buildings.empty())
            place = survey->place.buildings.front().written.front().exterior.front();
    sink.require_crs(provenance.crs_wkt, surveys.new_survey.crs.name(), place);
    sink.preflight(layers, provenance, place);
    sink.begin(layers, provenance);
    write_changes(changes, surveys.old_survey.place, surveys.new_survey.place, sink);
    sink.prepare(commit);
}

/// Surveys without a common building are probably of different places.
void warn_of_strangers(const BothSurveys& surveys, const SurveyChanges& changes, Warnings& warnings) {
    const ComparedSurvey& before = surveys.old_survey.about;
    const ComparedSurvey& after = surveys.new_survey.about;
    const auto in_one = [](const ChangedBuilding& building) {
        return building.change == Change::built || building.change == Change::gone;
    };
    if (before.buildings > 0 && after.buildings > 0 && std::ranges::all_of(changes.buildings, in_one))
        warnings.add("'" + before.dataset + "' and '" + after.dataset +
                     "' have no building in common; check the files and their coordinate reference systems.");
}

/// Returns the plane of the comparison.
score::MeasurePlane plane_of(const BothSurveys& surveys, Warnings& warnings) {
    const ReadSurvey& reference =
        surveys.new_survey.crs.kind() == Crs::Kind::none ? surveys.old_survey : surveys.new_survey;
    return score::measure_plane(reference.crs, box_of_place(reference.place), warnings);
}

/// Compares surveys that have been read. Their outlines are in the plane of the comparison afterwards.
SurveyChanges compare_read(BothSurveys& surveys, const score::MeasurePlane& plane,
                           SurveyComparison& comparison, Warnings& warnings) {
    ReadSurvey& before = surveys.old_survey;
    ReadSurvey& after = surveys.new_survey;
    for (ReadSurvey* survey : {&before, &after})
        transform(*survey, plane, after.crs, warnings);
    const double cell = after.about.cell_m.value_or(before.about.cell_m.value_or(1));
    before.place.cell_m = before.about.cell_m.value_or(cell);
    after.place.cell_m = after.about.cell_m.value_or(before.place.cell_m);
    SurveyChanges changes = find_changes(before.place, after.place, plane.metres);
    warn_of_strangers(surveys, changes, warnings);
    comparison.shift = changes.shift;
    for (const ChangedBuilding& building : changes.buildings)
        ++comparison.counts[static_cast<std::size_t>(building.change)];
    before.about.outside = changes.old_outside;
    after.about.outside = changes.new_outside;
    comparison.old_survey = before.about;
    comparison.new_survey = after.about;
    comparison.crs = after.crs.name();
    return changes;
}

}  // namespace
}  // namespace d2b::compare

namespace d2b {

SurveyComparison compare_surveys(const SurveyRequest& request, const Callbacks& callbacks,
                                 const ReportReader<SurveyComparison>& reader) {
    reading::register_formats();
    std::vector<std::string> told;
    const Callbacks recorded = recording_warnings(callbacks, told);
    Warnings warnings(recorded.on_warning);
    SurveyComparison comparison;
    comparison.output = request.destination;
    comparison.page = request.page;
    const std::unique_ptr<FeatureSink> sink = compare::open_destination(request, recorded);
    const std::unique_ptr<SurfaceSink> page =
        request.page.empty() ? nullptr : compare::open_change_page(request);
    compare::BothSurveys surveys = compare::read_both(request, recorded, warnings);
    const score::MeasurePlane plane = compare::plane_of(surveys, warnings);
    const compare::SurveyChanges changes = compare::compare_read(surveys, plane, comparison, warnings);
    CommitList commit;
    if (page) {
        compare::write_change_page(changes, surveys.old_survey.place, surveys.new_survey.place, plane, *page);
        page->prepare(commit);
    }
    if (sink)
        compare::write(changes, surveys, *sink, commit);
    // Only finding buildings takes long enough for progress.
    const bool found_here = surveys.new_survey.about.layer.empty();
    if (found_here && callbacks.on_progress && !callbacks.on_progress(1))
        throw Cancelled();
    comparison.warnings = told;
    if (reader.prepare)
        reader.prepare(comparison);
    commit.publish([&] {
        if (sink)
            std::ranges::for_each(sink->take_warnings(), recorded.on_warning);
        if (page)
            std::ranges::for_each(page->take_warnings(), recorded.on_warning);
        comparison.warnings = told;
        if (reader.show)
            reader.show(comparison);
    });
    return comparison;
}

}  // namespace d2b
