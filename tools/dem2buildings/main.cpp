#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/exit_codes.hpp"
#include "dem2buildings/help.hpp"
#include "dem2buildings/interrupt.hpp"
#include "dem2buildings/json_report.hpp"
#include "dem2buildings/progress.hpp"
#include "geometry/geos.hpp"
#include "pipeline/pipeline.hpp"
#include "read/gdal_command_line.hpp"
#include "read/gdal_dem_source.hpp"
#include "write/ogr_feature_sink.hpp"

namespace d2b {
namespace {

/// One line, whatever a file name in it may hold.
void print_line(const char* kind, std::string text) {
    std::ranges::replace_if(
        text, [](char letter) { return static_cast<unsigned char>(letter) < ' '; }, ' ');
    std::cerr << kind << text << '\n';
}

void process(const Request& request) {
    Options options = request.options;
    const bool quiet = request.tool.quiet;
    TerminalProgress progress(std::cout);
    Context context;
    context.on_warning = [](const std::string& text) { print_line("Warning: ", text); };
    context.on_progress = [&progress, quiet](double share) {
        if (!quiet)
            progress.update(share);
        return !interrupted();
    };
    start_gdal();
    catch_interrupts();
    const auto source = open_dem(options.read, context);
    const auto sink = open_sink(options.write, context);
    options.write.layers = layers_for(options.write);
    run(options, *source, *sink, context);
    if (!quiet) {
        progress.update(1);
        std::cout << summary(context.report, options.write.layers, options.write.destination);
    }
    if (request.tool.json)
        std::cout << json_report(context.report);
}

int run_tool(const std::vector<std::string>& arguments) {
    if (arguments.empty()) {
        std::cerr << short_usage();
        return exit_code::wrong_usage;
    }
    const auto left = apply_gdal_switches(arguments);
    if (!left)
        return exit_code::done;
    const Request request = parse_command_line(*left);
    if (request.tool.help)
        std::cout << full_help();
    else if (request.tool.version)
        std::cout << "dem2buildings " << version << ", GDAL " << gdal_version() << ", GEOS " << geos_version()
                  << ", PROJ " << proj_version() << ", GeographicLib " << geographiclib_version() << '\n';
    else if (request.tool.man_page)
        std::cout << man_page();
    else if (request.tool.options_markdown)
        std::cout << options_markdown();
    else
        process(request);
    // What cannot be written, a report say, must not look as if it had been.
    // The second condition holds where GDAL could not write to /vsistdout/, of which it says nothing.
    if (!std::cout.flush() || std::ferror(stdout) != 0)
        throw OutputError("Cannot write to stdout; see whether the disk is full or the reader has gone.");
    return exit_code::done;
}

/// run_tool() with every exception as a line on stderr and an exit status.
int run_guarded(const std::vector<std::string>& arguments) {
    try {
        return run_tool(arguments);
    } catch (const OptionError& error) {
        print_line("ERROR: ", error.what());
        return exit_code::wrong_usage;
    } catch (const Cancelled& error) {
        print_line("ERROR: ", error.what());
        return exit_code::cancelled;
    } catch (const std::bad_alloc&) {
        print_line("ERROR: ",
                   "There is not enough memory; use a part of the input (-srcwin, -projwin or -te).");
    } catch (const std::exception& error) {
        print_line("ERROR: ", error.what());
    }
    return exit_code::failed;
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    // At a limit of the size of files writing then fails, with a message, and cleans up.
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
    return d2b::run_guarded({argv + std::min(argc, 1), argv + argc});
}
