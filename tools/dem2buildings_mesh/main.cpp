// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <string>
#include <vector>

#include "common/exit_codes.hpp"
#include "common/own_stdout.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings_mesh/command_line.hpp"
#include "dem2buildings_mesh/help.hpp"
#include "dem2buildings_mesh/mesh_city.hpp"
#include "dem2buildings_mesh/report.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::mesh {
namespace {

void make_mesh(const MeshCommand& command) {
    OwnStdout own_stdout;
    std::vector<std::string> warnings;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) {
        warnings.push_back(text);
        print_line("Warning: ", text);
    };
    reading::start_gdal();
    ReportReader<MeshReport> reader;
    if (command.json)
        reader = own_stdout.reader<MeshReport>(
            [&](const MeshReport& report) { return mesh_json(command, report, warnings); });
    const MeshReport report = mesh_city(command, callbacks, reader);
    if (!command.quiet && !command.json)
        std::cout << mesh_text(command, report);
    own_stdout.finish_aside();
}

int run_tool(const std::vector<std::string>& words) {
    const MeshCommand command = parse_mesh_command_line(words);
    if (command.asks_for_text())
        std::cout << asked_text(command, mesh_texts());
    else if (command.bash_completion)
        std::cout << mesh_bash_completion();
    else
        make_mesh(command);
    return exit_code::done;
}

}  // namespace
}  // namespace d2b::mesh

int main(int argc, char* argv[]) {
    return d2b::run_guarded(argc, argv,
                            {[] { return d2b::tool_short_usage(d2b::mesh::mesh_texts()); },
                             "mesh a smaller part of the city", d2b::mesh::run_tool});
}
