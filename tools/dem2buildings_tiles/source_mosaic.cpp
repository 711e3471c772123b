#include "dem2buildings_tiles/source_mosaic.hpp"

#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "core/system/process.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings_tiles/command_line.hpp"
#include "read/raster_mosaic.hpp"

namespace d2b {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

void refuse_folder(const fs::path& work, const std::error_code& error) {
    throw OutputError("'" + work.string() + "' cannot be written to: " + error.message() +
                      "; give another work folder.");
}

void refuse_other_plan(const fs::path& work) {
    throw OptionError("'" + work.string() +
                      "' holds another plan, or the plan of a source that has changed; give another work "
                      "folder, or delete this one.");
}

SourceMosaic::SourceMosaic(const std::string& list, const fs::path& work, int band) {
    const std::vector<std::string> rasters = reading::read_raster_list(list);
    std::error_code error;
    if (!fs::exists(work, error))
        folder_.path = work;
    fs::create_directories(work, error);
    if (error)
        refuse_folder(work, error);
    const fs::path path = mosaic_of_list(work.string());
    // Builds it beside its place, because the names in it are relative to its folder.
    const Passing hidden(work / (".source." + std::to_string(system::process_id()) + ".vrt"));
    reading::build_mosaic(hidden.path.string(), rasters, band);
    if (fs::exists(path, error) && bytes_of(path) == bytes_of(hidden.path))
        return;
    if (fs::exists(work / "plan.json", error))
        refuse_other_plan(work);
    fs::rename(hidden.path, path, error);
    if (error)
        refuse_folder(work, error);
    file_.path = path;
}

void SourceMosaic::keep() {
    folder_.path.clear();
    file_.path.clear();
}

Passing::~Passing() {
    std::error_code ignored;
    if (!path.empty())
        std::filesystem::remove(path, ignored);
}

}  // namespace d2b
