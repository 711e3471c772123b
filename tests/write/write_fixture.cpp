#include "write/write_fixture.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdlib.h>

#include <cpl_error.h>
#include <cpl_string.h>

#include "dem2buildings/open_sinks.hpp"
#include "write/vector/layer_names.hpp"
#include "write/vector/vector_format.hpp"

/// Asked by LeakSanitizer. GDAL 3.6 takes no handler of files back, and forgets one whose prefix is used
/// again, which is the address of an IoErrorMonitor. Pango keeps the fonts that a thread has used to its end,
/// as Fontconfig and Cairo have them.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:VSIInstallPluginHandler\nleak:libfontconfig\nleak:libcairo\n";
}

namespace d2b::test {

namespace fs = std::filesystem;

void WriteTest::SetUp() {
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    std::string pattern = (fs::temp_directory_path() / "d2b_write.XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    callbacks_.on_warning = [this](const std::string& text) { warnings_.push_back(text); };
}

void WriteTest::TearDown() {
    CPLPopErrorHandler();
    fs::remove_all(folder_);
}

std::vector<std::string> WriteTest::entries(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

WriteOptions WriteTest::to(const std::string& name, const std::string& format) const {
    WriteOptions options;
    options.destination = path(name);
    options.format = format;
    return options;
}

void WriteTest::put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
}

std::string WriteTest::bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string WriteTest::buildings_layer(const WriteOptions& options) {
    return writing::name_of(options, writing::format_for(options), LayerRole::buildings, layers_for(options));
}

std::int64_t WriteTest::write(const WriteOptions& options, int n) {
    const Layers layers = layers_for(options);
    const auto sink = open_sink(options, callbacks_);
    std::vector<LayerSpec> specs;
    if (layers != Layers::contours)
        specs.push_back(layer_spec(sink->layer_name(LayerRole::buildings, layers), options.with_z));
    if (layers != Layers::buildings)
        specs.push_back(layer_spec(sink->layer_name(LayerRole::contours, layers), options.with_z));
    sink->preflight(specs, provenance(), {});
    sink->begin(specs, provenance());
    for (int i = 0; i < n; ++i)
        for (std::size_t layer = 0; layer < specs.size(); ++layer)
            sink->add(layer, square(sink->first_id() + i));
    sink->finish();
    for (std::string& text : sink->take_warnings())
        warnings_.push_back(std::move(text));
    return sink->first_id();
}

std::string wkt_of(int epsg) {
    return wkt_of("EPSG:" + std::to_string(epsg));
}

std::string wkt_of(const std::string& crs) {
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(nullptr);
    EXPECT_EQ(OSRSetFromUserInput(srs, crs.c_str()), OGRERR_NONE);
    char* text = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    OSRExportToWktEx(srs, &text, options);
    std::string wkt = text;
    CPLFree(text);
    OSRRelease(srs);
    return wkt;
}

LayerSpec layer_spec(const std::string& name, bool with_z) {
    LayerSpec spec;
    spec.name = name;
    spec.title = "Title of " + name;
    spec.description = "What " + name + " are.";
    spec.fields = {{"id", "number", FieldType::integer, "", "number of the building"},
                   {"height", "height [m]", FieldType::real, "m", "height above the ground"},
                   {"status", "status", FieldType::text, "", "what was done"}};
    spec.with_z = with_z;
    spec.style = {.title = "Style of " + name, .colour = "height", .label = "height"};
    return spec;
}

Feature square(std::int64_t id) {
    Feature feature;
    const double x = static_cast<double>(id);
    feature.values = {id, std::monostate(), "text " + std::to_string(id)};
    if (id % 2 != 0)
        feature.values[1] = x + 0.25;
    feature.parts = {{{{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}, {}}};
    feature.z = 7.5;
    return feature;
}

Layers layers_for(const WriteOptions& options) {
    return writing::resolve_layers(options, options.layers, writing::format_for(options));
}

Provenance provenance() {
    return {wkt_of(25832), {{"source", "dem.tif"}, {"thresholds", "1, 2"}}};
}

Dataset open_dataset(const std::string& path, bool update) {
    return Dataset(
        GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | (update ? GDAL_OF_UPDATE : 0U), nullptr, nullptr, nullptr));
}

std::vector<std::string> layer_names(GDALDatasetH dataset) {
    std::vector<std::string> names;
    for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i)
        names.emplace_back(OGR_L_GetName(GDALDatasetGetLayer(dataset, i)));
    std::erase(names, "layer_styles");
    std::sort(names.begin(), names.end());
    return names;
}

std::int64_t count(const std::string& path, const std::string& layer) {
    const Dataset dataset = open_dataset(path);
    OGRLayerH handle = dataset ? GDALDatasetGetLayerByName(dataset.get(), layer.c_str()) : nullptr;
    return handle == nullptr ? -1 : OGR_L_GetFeatureCount(handle, TRUE);
}

std::vector<std::int64_t> ids(const std::string& path, const std::string& layer) {
    std::vector<std::int64_t> found;
    const Dataset dataset = open_dataset(path);
    OGRLayerH handle = dataset ? GDALDatasetGetLayerByName(dataset.get(), layer.c_str()) : nullptr;
    while (OGRFeatureH feature = handle == nullptr ? nullptr : OGR_L_GetNextFeature(handle)) {
        found.push_back(OGR_F_GetFieldAsInteger64(feature, OGR_F_GetFieldIndex(feature, "id")));
        OGR_F_Destroy(feature);
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string sql(const std::string& path, const std::string& statement, bool update) {
    const Dataset dataset = open_dataset(path, update);
    OGRLayerH result =
        dataset ? GDALDatasetExecuteSQL(dataset.get(), statement.c_str(), nullptr, nullptr) : nullptr;
    if (result == nullptr)
        return "";
    OGRFeatureH row = OGR_L_GetNextFeature(result);
    const std::string value = row == nullptr ? "" : OGR_F_GetFieldAsString(row, 0);
    OGR_F_Destroy(row);
    GDALDatasetReleaseResultSet(dataset.get(), result);
    return value;
}

void add_user_layer(const std::string& path, const std::string& layer, int n, const char* format) {
    Dataset dataset = open_dataset(path, true);
    if (!dataset)
        dataset.reset(GDALCreate(GDALGetDriverByName(format), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    ASSERT_TRUE(dataset);
    OGRLayerH handle = GDALDatasetCreateLayer(dataset.get(), layer.c_str(), nullptr, wkbPoint, nullptr);
    ASSERT_NE(handle, nullptr);
    OGRFieldDefnH field = OGR_Fld_Create("note", OFTString);
    OGR_L_CreateField(handle, field, TRUE);
    OGR_Fld_Destroy(field);
    for (int i = 0; i < n; ++i) {
        OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(handle));
        OGR_F_SetFieldString(feature, 0, "mine");
        OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
        OGR_G_SetPoint_2D(point, 0, i, i);
        OGR_F_SetGeometryDirectly(feature, point);
        ASSERT_EQ(OGR_L_CreateFeature(handle, feature), OGRERR_NONE);
        OGR_F_Destroy(feature);
    }
}

}  // namespace d2b::test
