#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem2buildings/error.hpp"
#include "pipeline/pipeline_case.hpp"
#include "pipeline/tiles/tile_steps.hpp"
#include "support/temporary_folder.hpp"

namespace d2b::test {

inline constexpr std::uint64_t some_plan = 0x1234;

/// How a run in tiles goes.
struct TileOrder {
    std::int32_t side = 1;   ///< units of a tile in a row
    bool backwards = false;  ///< the last tile first
    bool twice = false;      ///< each step a second time
    int threads = 1;
};

/// All steps of a run in tiles, each as a process would do it.
class StepsInTiles {
  public:
    /// @param layers that the destination gets
    StepsInTiles(const Sources& sources, Options options, tiles::TileRunParameters work,
                 Layers layers = Layers::both)
        : sources_(sources), options_(std::move(options)), work_(std::move(work)), layers_(layers) {}

    [[nodiscard]] std::int64_t count();
    void plan();
    void find(std::int64_t tile);
    void join();
    void draw(std::int64_t tile);
    void merge(Result& result);
    /// Replaces merge: writes the features of all tiles that are written in parts, in the order of their
    /// numbers. Begins with the last tile.
    void number_and_write(Result& result);
    /// All of them.
    void run(const TileOrder& order, Result& result);

  private:
    template <typename Step>
    void each(const TileOrder& order, const Step& step);

    Sources sources_;
    Options options_;
    tiles::TileRunParameters work_;
    Layers layers_;
};

/// Error that ends a step; "(nothing)" where it ends well.
template <typename Step>
std::string refusal(const Step& step) {
    try {
        step();
    } catch (const Error& error) {
        return error.what();
    }
    return "(nothing)";
}

/// Features, numbers, provenance and reports, but for seconds, memory and threads.
void expect_same(const Result& a, const Result& b);

/// Runs all steps and one run, whose result it compares with theirs and gives back.
void expect_same_in_tiles(const Sources& sources, const Options& options, const detect::UnitSize& units,
                          const TileOrder& order, Result& whole);

}  // namespace d2b::test
