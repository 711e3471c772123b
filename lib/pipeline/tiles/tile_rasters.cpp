#include "pipeline/tiles/tile_rasters.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "dem2buildings/commit_list.hpp"
#include "dem2buildings/error.hpp"
#include "pipeline/auxiliary_files.hpp"
#include "write/raster/geotiff.hpp"

namespace d2b::tiles {
namespace {

namespace fs = std::filesystem;

struct RasterOption {
    const char* option;
    const std::string& name;  ///< "" if not asked for
};

std::array<RasterOption, 3> asked(const Options& options) {
    const WriteOptions& write = options.write;
    return {
        {{"-write_ground", write.ground}, {"-write_height", write.height}, {"-write_canopy", write.canopy}}};
}

fs::path folder_of(const std::string& vrt) {
    return fs::path(vrt).replace_extension();
}

std::string file_of(std::int64_t tile) {
    return std::to_string(tile) + ".tif";
}

/// Returns "" if `vrt` is empty.
std::string path_of(const std::string& vrt, std::int64_t tile) {
    return vrt.empty() ? "" : (folder_of(vrt) / file_of(tile)).string();
}

/// Creates the folder, which may still hold files of an interrupted process.
void make_folder(const std::string& vrt) {
    if (vrt.empty())
        return;
    std::error_code error;
    fs::create_directories(folder_of(vrt), error);
    if (error)
        throw OutputError("\"" + folder_of(vrt).string() + "\" cannot be made: " + error.message() +
                          "; free some space, or allow writing to it.");
}

void remove_left_over(const fs::path& folder) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with(".dem2buildings."))
            fs::remove_all(entry.path(), ignored);
}

}  // namespace

void require_raster_names(const Options& options) {
    std::vector<std::string> names;
    for (const auto& [option, name] : asked(options)) {
        if (name.empty())
            continue;
        if (fs::path(name).extension() != ".vrt" || name.starts_with("/vsi"))
            throw OptionError(std::string(option) +
                              " in tiles is one file per tile and a VRT that joins them; give the name of "
                              "the VRT on a disk, such as " +
                              fs::path(name).filename().replace_extension(".vrt").string() + ", not \"" +
                              name + "\".");
        std::error_code error;
        for (const fs::path& path : {fs::path(name), folder_of(name)})
            if (fs::exists(path, error))
                throw OptionError(
                    "\"" + path.string() +
                    "\" exists, and tiles do not replace rasters; give another name, or delete it.");
        for (const std::string& other : names)
            if (other == name)
                throw OptionError("\"" + name + "\" is the name of two rasters; give each its own.");
        names.push_back(name);
    }
}

bool has_rasters(const TileRun& run, std::int64_t tile) {
    std::error_code error;
    for (const auto& [option, name] : asked(run.setup().plan.asked))
        if (!name.empty() && !fs::exists(path_of(name, tile), error))
            return false;
    return true;
}

AuxiliarySinks open_tile_rasters(const TileRun& run, std::int64_t tile) {
    Options options = run.setup().plan.asked;
    options.write.overwrite = true;  // files that an interrupted process has published
    for (std::string* name : {&options.write.ground, &options.write.height, &options.write.canopy}) {
        make_folder(*name);
        *name = path_of(*name, tile);
    }
    DemInfo grid = run.setup().dem;
    grid.window = run.tiles().whole(tile).own;
    std::vector<std::string> in_use;
    return pipeline::open_scene_rasters(options, grid, in_use);
}

void finish_tile_rasters(const TileRun& run, std::int64_t tile, AuxiliarySinks& sinks) {
    const WriteOptions& write = run.setup().plan.asked.write;
    const std::array<std::pair<RasterSink*, const std::string&>, 3> rasters{
        {{sinks.ground.get(), write.ground},
         {sinks.height.get(), write.height},
         {sinks.canopy.get(), write.canopy}}};
    std::array<CommitList, rasters.size()> commits;
    for (std::size_t i = 0; i < rasters.size(); ++i)
        if (rasters.at(i).first != nullptr)
            rasters.at(i).first->prepare(commits.at(i));
    for (std::size_t i = 0; i < rasters.size(); ++i)
        try {
            commits.at(i).publish();
        } catch (const OutputError&) {
            std::error_code error;
            if (!fs::exists(path_of(rasters.at(i).second, tile), error))
                throw;
        }
}

void publish_rasters(const TileRun& run) {
    const Window& window = run.window();
    CommitList commit;
    std::vector<std::unique_ptr<PendingResult>> files;
    for (const auto& [option, name] : asked(run.setup().plan.asked)) {
        if (name.empty())
            continue;
        std::vector<writing::RasterPart> parts;
        for (std::int64_t tile = 0; tile < run.tiles().count(); ++tile) {
            const Window own = run.tiles().whole(tile).own;
            parts.push_back({(folder_of(name).filename() / file_of(tile)).string(),
                             {own.row - window.row, own.col - window.col, own.rows, own.cols}});
        }
        files.push_back(writing::prepare_raster_parts(name, window.rows, window.cols, parts));
        commit.add(*files.back());
    }
    commit.publish();
    for (const auto& [option, name] : asked(run.setup().plan.asked))
        if (!name.empty())
            remove_left_over(folder_of(name));
}

}  // namespace d2b::tiles
