#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "options/option_table.hpp"
#include "pipeline/tiles/checkpoint_file.hpp"

namespace d2b {

/// An option of the program's own.
struct TileOption {
    std::string_view name;   ///< without dash
    std::string_view value;  ///< "<units>"; "" for a switch
    std::string_view help;
    std::string_view steps;  ///< that take it, separated by blanks; "" for an option in the place of a step
};
[[nodiscard]] const std::vector<TileOption>& tile_options();

/// A step, by the name that it has on the command line.
struct TileStepName {
    std::string_view name;
    tiles::TileStep kind;
    std::string_view arguments;
    std::string_view help;
};
[[nodiscard]] const std::vector<TileStepName>& tile_step_names();

struct TileCommand {
    tiles::TileStep kind = tiles::TileStep::plan;
    std::string text;  ///< name of the option that asks for a text instead: help, version, man,
                       ///< bash_completion
    std::string work;
    std::string list;  ///< of plan: names of rasters whose mosaic in `work` is the source; "" for none
    std::vector<std::int64_t> tiles;  ///< of find, draw and write, ascending
    std::int32_t side = 1;            ///< of plan
    int threads = 0;                  ///< of all but plan; 0: as plan was given
    bool json = false;                ///< of merge
    bool quiet = false;
    /// The command line of dem2buildings that plan was given, and the request that it makes.
    std::vector<std::string> words;
    Request request;
};

/// The mosaic that plan makes of a list of rasters, as a command line names it.
[[nodiscard]] std::string mosaic_of_list(const std::string& work);

/// Reads a command line; opens no file. @param arguments without the program's name and GDAL's own switches
/// @throws OptionError
[[nodiscard]] TileCommand parse_tile_command_line(const std::vector<std::string>& arguments);

}  // namespace d2b
