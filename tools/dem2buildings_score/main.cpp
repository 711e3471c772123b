#include <iostream>
#include <string>
#include <vector>

#include "common/exit_codes.hpp"
#include "common/own_stdout.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings_score/command_line.hpp"
#include "dem2buildings_score/help.hpp"
#include "dem2buildings_score/report.hpp"
#include "read/gdal_setup.hpp"

namespace d2b {
namespace {

void measure(const ScoreCommand& request) {
    OwnStdout own_stdout;
    std::vector<std::string> warnings;
    Callbacks callbacks;
    callbacks.on_warning = [&](const std::string& text) {
        warnings.push_back(text);
        print_line("Warning: ", text);
    };
    reading::start_gdal();
    if (request.roofs) {
        const RoofScoreRun run = compare_roofs(request, callbacks);
        std::cout << (request.json ? roof_score_json(request, run, warnings)
                                   : roof_score_text(request, run, request.quiet));
    } else {
        const ScoreRun run = compare_datasets(request, callbacks);
        std::cout << (request.json ? score_json(request, run, warnings)
                                   : score_text(request, run, request.quiet));
    }
    own_stdout.finish();
}

int run_tool(const std::vector<std::string>& words) {
    const ScoreCommand request = parse_score_command_line(words);
    if (request.asks_for_text())
        std::cout << asked_text(request, score_texts());
    else
        measure(request);
    return exit_code::done;
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    return d2b::run_guarded(argc, argv,
                            {[] { return d2b::tool_short_usage(d2b::score_texts()); },
                             "clip the footprints and the reference to a part of the city", d2b::run_tool});
}
