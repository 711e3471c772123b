#include <iostream>
#include <string>
#include <vector>

#include "common/exit_codes.hpp"
#include "common/own_stdout.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/help.hpp"
#include "dem2buildings/json_report.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/progress.hpp"
#include "dem2buildings/run_interruptibly.hpp"
#include "dem2buildings/sweep.hpp"
#include "dem2buildings/version.hpp"
#include "read/gdal_setup.hpp"

namespace d2b {
namespace {

void process(const Request& request) {
    OwnStdout own_stdout;
    const Options& options = request.options;
    const bool quiet = request.tool.quiet;
    TerminalProgress progress(std::cout);
    const Callbacks callbacks = terminal_callbacks(progress, quiet);
    reading::start_gdal();
    if (!request.tool.sweep.empty()) {
        const Inputs inputs = open_inputs(options, callbacks);
        run_sweep(
            options, inputs.sources(), request.tool.sweep_plan, callbacks,
            own_stdout.reader<std::vector<pipeline::Trial>>([&](const std::vector<pipeline::Trial>& trials) {
                if (!quiet)
                    progress.update(1);
                const SweepPlan& plan = request.tool.sweep_plan;
                return request.tool.json ? sweep_json(plan, trials) : sweep_table(plan, trials);
            }));
        return;
    }
    const RunReport report = extract_file(
        options, callbacks,
        request.tool.json ? own_stdout.reader<RunReport>(json_report) : ReportReader<RunReport>());
    if (!quiet) {
        progress.update(1);
        std::cout << summary(report, report.layers, report.output) << advice(report, options);
    }
    own_stdout.finish_aside();
}

int run_tool(const std::vector<std::string>& words) {
    const Request request = parse_command_line(words);
    if (request.tool.help)
        std::cout << everyday_help();
    else if (request.tool.help_all)
        std::cout << full_help();
    else if (request.tool.version)
        std::cout << "dem2buildings " << version << ", " << library_versions() << '\n';
    else if (request.tool.man_page)
        std::cout << man_page();
    else if (request.tool.options_markdown)
        std::cout << options_markdown();
    else if (request.tool.options_json)
        std::cout << options_json();
    else if (request.tool.bash_completion)
        std::cout << bash_completion();
    else
        return run_interruptibly([&] { process(request); });
    return exit_code::done;
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    return d2b::run_guarded(
        argc, argv,
        {d2b::short_usage, "use a part of the input (-srcwin, -projwin or -te) or fewer -threads",
         d2b::run_tool});
}
