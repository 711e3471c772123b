#include <iostream>
#include <string>
#include <vector>

#include "common/exit_codes.hpp"
#include "common/own_stdout.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/progress.hpp"
#include "dem2buildings/run_interruptibly.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_tiles/command_line.hpp"
#include "dem2buildings_tiles/help.hpp"
#include "dem2buildings_tiles/steps.hpp"
#include "read/gdal_setup.hpp"

namespace d2b {
namespace {

void process(const TileCommand& command) {
    OwnStdout own_stdout;
    TerminalProgress progress(std::cout);
    const Callbacks callbacks = terminal_callbacks(progress, true);
    reading::start_gdal();
    run_step(command, own_stdout, callbacks);
    own_stdout.finish_aside();
}

int run_tool(const std::vector<std::string>& words) {
    const TileCommand command = parse_tile_command_line(words);
    if (command.text == "help")
        std::cout << tiles_help();
    else if (command.text == "version")
        std::cout << "dem2buildings_tiles " << version << ", " << library_versions() << '\n';
    else if (command.text == "man")
        std::cout << tiles_man_page();
    else if (command.text == "bash_completion")
        std::cout << tiles_bash_completion();
    else
        return run_interruptibly([&] { process(command); });
    return exit_code::done;
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    return d2b::run_guarded(
        argc, argv, {d2b::tiles_short_usage, "plan smaller tiles, or use fewer -threads", d2b::run_tool});
}
