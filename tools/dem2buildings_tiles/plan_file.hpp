#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "pipeline/tiles/tile_run.hpp"
#include "read/source_files.hpp"

namespace d2b {

/// Decisions of `plan`, as <work>/plan.json has them.
struct TilePlan {
    static constexpr int most_side = 1000;

    std::vector<std::string> words;  ///< the command line of dem2buildings that the result is that of
    std::string folder;              ///< in which it was given: relative names of files are of it
    Layers layers = Layers::both;    ///< that the destination gets
    bool parts = false;              ///< the destination is a folder in which each tile has files
    std::int32_t side = 1;           ///< units of a tile in a row, and rows
    std::int64_t tiles = 0;
    Window window;  ///< of the source
    std::vector<reading::SourceFile> files;
    UndeclaredNodata undeclared = {};  ///< of the source
};

/// Expected cost of a tile, with one thread.
struct TileCost {
    double find_seconds = 0;
    double draw_seconds = 0;
    std::int64_t memory_bytes = 0;
    std::int64_t bytes_read = 0;  ///< by all steps on all tiles, as they are in memory
};

[[nodiscard]] std::string plan_text(const TilePlan& plan, const TileCost& cost);
/// Writes the file in one rename. @throws OutputError
void write_plan(const std::filesystem::path& work, const TilePlan& plan, const TileCost& cost);

/// A plan that is there, and its digest.
struct KnownPlan {
    TilePlan plan;
    tiles::TileRunParameters work;
};
/// @throws InputError where there is none, or it is of another version, or damaged
[[nodiscard]] KnownPlan read_plan(const std::filesystem::path& work);
/// The same of a file with these bytes.
[[nodiscard]] KnownPlan plan_from(const std::filesystem::path& work, const std::string& bytes);

}  // namespace d2b
