#include <iostream>
#include <string>
#include <vector>

#include "common/exit_codes.hpp"
#include "common/own_stdout.hpp"
#include "common/run_guarded.hpp"
#include "dem2buildings/progress.hpp"
#include "dem2buildings/run_interruptibly.hpp"
#include "dem2buildings_compare/command_line.hpp"
#include "dem2buildings_compare/help.hpp"
#include "dem2buildings_compare/report.hpp"
#include "read/gdal_setup.hpp"

namespace d2b {
namespace {

void compare(const CompareCommand& request) {
    OwnStdout own_stdout;
    const bool to_stdout = request.destination.find("/vsistdout") != std::string::npos;
    const bool quiet = request.quiet || request.json || to_stdout;
    TerminalProgress progress(std::cout);
    const Callbacks callbacks = terminal_callbacks(progress, quiet);
    reading::start_gdal();
    const auto text = [&request](const SurveyComparison& comparison) {
        return request.json ? comparison_json(comparison) : comparison_text(comparison, request.quiet);
    };
    // The text is the whole result without a file; beside one it is a summary that may be lost.
    const bool is_aside = !request.json && !(request.destination.empty() && request.page.empty());
    const SurveyComparison comparison = compare_surveys(
        request, callbacks,
        is_aside ? ReportReader<SurveyComparison>() : own_stdout.reader<SurveyComparison>(text));
    if (!is_aside || to_stdout)
        return own_stdout.finish();
    std::cout << text(comparison);
    own_stdout.finish_aside();
}

int run_tool(const std::vector<std::string>& words) {
    const CompareCommand request = parse_compare_command_line(words);
    if (!request.asks_for_text())
        return run_interruptibly([&] { compare(request); });
    std::cout << asked_text(request, compare_texts());
    return exit_code::done;
}

}  // namespace
}  // namespace d2b

int main(int argc, char* argv[]) {
    return d2b::run_guarded(argc, argv,
                            {[] { return d2b::tool_short_usage(d2b::compare_texts()); },
                             "compare parts of the surveys", d2b::run_tool});
}
