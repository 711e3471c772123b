#include "options/option_scene.hpp"

#include <cmath>
#include <random>
#include <type_traits>
#include <utility>
#include <variant>

#include <cpl_vsi.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "core/text.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/run.hpp"
#include "read/gdal_setup.hpp"
#include "read/rasters.hpp"
#include "support/memory_io.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {
namespace {

constexpr int scene_rows = 100;
constexpr int scene_cols = 120;
constexpr double no_data = 98;

/// Hilly, and above 0, so that elevations may pass for heights.
double ground(int row, int col) {
    return 1 + 0.005 * col + 0.5 * std::sin(row / 9.0) * std::cos(col / 11.0);
}

struct Block {
    int row;
    int col;
    int height;
    int width;

    [[nodiscard]] bool holds(int r, int c) const {
        return r >= row && r < row + height && c >= col && c < col + width;
    }
};
constexpr Block flat{8, 8, 14, 18};
constexpr Block hall{30, 8, 13, 15};   // low and large
constexpr Block kiosk{32, 34, 8, 10};  // small and high
constexpr Block gabled{34, 78, 14, 24};
constexpr Block pair{52, 8, 11, 38};  // two houses that share a wall
constexpr Block podium{60, 60, 24, 26};
constexpr Block tower{66, 66, 10, 12};
constexpr Block rough{34, 54, 12, 15};  // hardly a building
constexpr Block ruin{82, 10, 11, 14};   // hardly none
constexpr Block shed{54, 96, 5, 8};
constexpr Block wood{6, 90, 24, 26};

/// Elevation of a roof; NaN where there is none.
double roof(int row, int col) {
    if (flat.holds(row, col))
        return 8;
    if (hall.holds(row, col))
        return 4.8;
    if (kiosk.holds(row, col))
        return 8.5;
    if (gabled.holds(row, col))
        return 12 - 1.1 * std::abs(row - gabled.row - 6.5);
    if (std::hypot(row - 18, col - 54) < 9.3)
        return 16;
    if (pair.holds(row, col))
        return col < 27 ? 7.5 : 11.5;
    if (tower.holds(row, col))
        return 21;
    if (podium.holds(row, col))
        return 10;
    if (shed.holds(row, col))
        return 6;
    return std::nan("");
}

/// Two bands: the surface, and the same with roofs at half their height.
std::vector<double> surface() {
    std::mt19937 random(7);
    const auto share = [&] { return static_cast<double>(random() % 10000) / 10000; };
    std::vector<double> z;
    for (int r = 0; r < scene_rows; ++r)
        for (int c = 0; c < scene_cols; ++c) {
            const double noise = 0.05 * (share() - 0.5);
            const double tree = wood.holds(r, c) && share() < 0.7 ? 3 + 9 * share() : 0;
            const double rubble = ruin.holds(r, c) ? 4 + 1.6 * share() : rough.holds(r, c) ? 4 + share() : 0;
            const double top = roof(r, c);
            z.push_back((std::isnan(top) ? ground(r, c) + tree + rubble : top) + noise);
            if (Block{12, 14, 2, 3}.holds(r, c))
                z.back() = no_data;
            if (Block{55, 34, 2, 2}.holds(r, c))
                z.back() = 16;
        }
    return z;
}

void write_band(GDALDatasetH dataset, int band, std::vector<double> values) {
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, band), GF_Write, 0, 0, scene_cols, scene_rows,
                           values.data(), scene_cols, scene_rows, GDT_Float64, 0, 0),
              CE_None);
}

RasterSpec grid() {
    RasterSpec spec;
    spec.cols = scene_cols;
    spec.rows = scene_rows;
    spec.type = GDT_Float32;
    spec.transform = std::array<double, 6>{391000, 1, 0, 5820000, 0, -1};
    spec.crs = "EPSG:25833";
    return spec;
}

void write_rasters(const std::string& folder) {
    RasterSpec spec = grid();
    spec.bands = 2;
    spec.nodata = no_data;
    const GDALDatasetH dem = create(folder + "dem.tif", spec);
    std::vector<double> z = surface();
    write_band(dem, 1, z);
    for (int r = 0; r < scene_rows; ++r)
        for (int c = 0; c < scene_cols; ++c)
            if (double& value = z[static_cast<std::size_t>(r * scene_cols + c)]; value != no_data)
                value = ground(r, c) + (value - ground(r, c)) / 2;
    write_band(dem, 2, z);
    GDALClose(dem);
    spec = grid();
    for (int r = 0; r < scene_rows; ++r)
        for (int c = 0; c < scene_cols; ++c)
            spec.values.push_back(ground(r, c) - 0.4);
    write(folder + "dtm.tif", spec);
    spec.values.clear();
    for (int r = 0; r < scene_rows; ++r)
        for (int c = 0; c < scene_cols; ++c)
            spec.values.push_back(wood.holds(r, c) || rough.holds(r, c) ? 0.6 : 0.05);
    write(folder + "ndvi.tif", spec);
}

std::string wkt_of(const Block& block) {
    const auto at = [](int row, int col) {
        return std::to_string(391000 + col) + " " + std::to_string(5820000 - row);
    };
    const int bottom = block.row + block.height;
    const int right = block.col + block.width;
    return "POLYGON((" + at(block.row, block.col) + "," + at(bottom, block.col) + "," + at(bottom, right) +
           "," + at(block.row, right) + "," + at(block.row, block.col) + "))";
}

using Areas = std::vector<std::pair<const char*, Block>>;

/// Two layers of excluded objects: a house and the ridge of two others, and a house.
void write_exclusions(const std::string& path) {
    write_layer(path,
                {"bridges", {{wkt_of(flat)}, {wkt_of({56, 8, 3, 38})}}, 25833, "", OFTReal, wkbPolygon});
    write_layer(path, {"ships", {{wkt_of(pair)}}, 25833, "", OFTReal, wkbPolygon});
}

/// A cut through the flat house, and a point that denies it.
void write_corrections(const std::string& path) {
    write_rows(path, {.name = "lines",
                      .fields = {{"kind"}},
                      .rows = {{"LINESTRING(391017 5819999,391017 5819970)", {"cut"}}},
                      .epsg = 25833,
                      .geometry = wkbLineString});
    write_rows(path, {.name = "points",
                      .fields = {{"kind"}},
                      .rows = {{"POINT(391010.5 5819988.5)", {"no building"}}},
                      .epsg = 25833,
                      .geometry = wkbPoint});
}

void write_areas(const std::string& path, const Areas& areas) {
    for (const auto& [name, block] : areas)
        write_layer(path, {name, {{wkt_of(block)}}, 25833, "", OFTReal, wkbPolygon});
}

/// Two layers of parcels, which cut other blocks.
void write_parcels(const std::string& path) {
    using Parcels = std::vector<Block>;
    for (const auto& [name, parcels] :
         {std::pair<const char*, Parcels>{"strips", {{0, 0, 100, 24}, {0, 24, 100, 66}, {0, 90, 100, 30}}},
          {"halves", {{0, 0, 55, 120}, {55, 0, 45, 120}}}}) {
        VectorLayer layer{name, {}, 25833, "owner", OFTInteger, wkbPolygon};
        for (std::size_t i = 0; i < parcels.size(); ++i)
            layer.features.push_back({wkt_of(parcels[i]), 70.0 + static_cast<double>(i)});
        write_layer(path, layer);
    }
}

/// Numbers of an outcome as text.
class Writer {
  public:
    void add(const std::string& text) { outcome.written += text + " "; }
    void add(double value) {
        outcome.finite = outcome.finite && std::isfinite(value);
        add(number_text(value));
    }
    void add_value(const FieldValue& value) {
        std::visit(
            [this](const auto& held) {
                using Held = std::decay_t<decltype(held)>;
                if constexpr (std::is_same_v<Held, std::monostate>)
                    add("NULL");
                else if constexpr (std::is_same_v<Held, std::int64_t>)
                    add(std::to_string(held));
                else
                    add(held);
            },
            value);
    }
    void add(const WorldRing& ring) {
        add("ring");
        for (const Position& position : ring) {
            add(position.x);
            add(position.y);
        }
    }
    void add(const Feature& feature, bool with_z) {
        add("feature");
        for (const FieldValue& value : feature.values)
            add_value(value);
        if (with_z)
            add(feature.z);
        for (const WorldPolygon& part : feature.parts) {
            add(part.exterior);
            for (const WorldRing& ring : part.interiors)
                add(ring);
            for (const double elevation : part.elevations)
                add(elevation);
            add("arcs " + std::to_string(part.arcs.size()));
        }
    }
    void add(const MemorySink& sink) {
        add(sink.provenance.crs_wkt);
        for (std::size_t i = 0; i < sink.layers.size(); ++i) {
            add("layer " + sink.layers[i].name);
            for (const FieldSpec& field : sink.layers[i].fields)
                add(field.name);
            for (const Feature& feature : sink.features[i])
                add(feature, sink.layers[i].with_z);
        }
    }
    void add(const std::string& name, const MemoryRaster& raster) {
        if (name.empty())
            return;
        add("raster " + name);
        for (const float value : raster.values)
            if (!std::isnan(value))
                add(static_cast<double>(value));
    }

    void add(const MemorySurface& surface) {
        add((surface.form() == SurfaceForm::tiers ? "tiers " : "surface ") + surface.meta.lod);
        for (const double metres : surface.meta.frame.origin)
            add(metres);
        for (const SurfacePart& part : surface.parts)
            for (const SurfacePoint& point : part.points)
                for (const double metres : surface.meta.frame.local(point))
                    add(metres);
        for (const SurfacePart& part : surface.parts)
            for (const SurfaceBuilding& building : part.buildings)
                for (const SurfaceTier& tier : building.tiers)
                    for (const double metres : surface.meta.frame.local(tier.rings.front().front()))
                        add(metres);
    }

    Outcome outcome;
};

void run_into(Writer& writer, const Texts& words) {
    const Request request = parse_command_line(words);
    const Options& options = request.options;
    const auto source = open_dem(options.read);
    const AuxiliarySources sides = open_auxiliary_sources(options, source->info());
    MemorySink sink;
    MemoryRaster ground_raster;
    MemoryRaster height;
    MemoryRaster canopy;
    MemorySurface surface;
    std::vector<SurfaceSink*> surfaces;
    if (!options.write.surfaces.empty())
        surfaces.push_back(&surface);
    MemorySurface tiers(SurfaceForm::tiers);
    if (!options.write.page.empty())
        surfaces.push_back(&tiers);
    run(options,
        {*source, sides.terrain.get(), sides.mask.get(), sides.ndvi.get(), sides.parcels.get(),
         sides.footprints.get(), sides.exclusion.get(), sides.corrections.get()},
        {sink, &ground_raster, &height, &canopy, nullptr, surfaces});
    const auto given = sink.provenance.metadata.find("D2B_OPTIONS");
    if (given != sink.provenance.metadata.end())
        writer.outcome.options = given->second;
    writer.add(sink);
    writer.add(options.write.ground, ground_raster);
    writer.add(options.write.height, height);
    writer.add(options.write.canopy, canopy);
    if (!options.write.surfaces.empty())
        writer.add(surface);
    if (!options.write.page.empty())
        writer.add(tiers);
}

}  // namespace

void OptionScene::SetUpTestSuite() {
    reading::start_gdal();
    const std::string folder = "/vsimem/scene/";
    VSIMkdirRecursive(folder.c_str(), 0755);
    write_rasters(folder);
    write_areas(folder + "areas.gpkg", {{"west", {0, 0, 100, 72}}, {"north", {0, 0, 58, 120}}});
    write_parcels(folder + "parcels.gpkg");
    write_corrections(folder + "corrections.gpkg");
    write_exclusions(folder + "exclusions.gpkg");
    write_areas(folder + "footprints.gpkg", {{"low", gabled}, {"high", podium}});
    write_areas(folder + "masks.gpkg", {{"east", {0, 12, 100, 108}}, {"middle", {4, 0, 76, 120}}});
}

void OptionScene::TearDownTestSuite() {
    VSIRmdirRecursive("/vsimem/scene");
}

Outcome outcome_of(const Texts& words) {
    Writer writer;
    Texts all = words;
    all.insert(all.end(), {"-threads", "1", "--", "/vsimem/scene/dem.tif", "out.gpkg"});
    try {
        run_into(writer, all);
    } catch (const Error& error) {
        return {"", error.what(), true, ""};
    }
    return writer.outcome;
}

}  // namespace d2b::test
