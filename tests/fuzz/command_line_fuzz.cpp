// Any arguments, one a line, are a request or an OptionError.
#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"
#include "fuzz/bytes.hpp"

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char letter : text)
        if (letter == '\n')
            lines.emplace_back();
        else
            lines.back() += letter;
    return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using d2b::test::demand;
    const std::vector<std::string> arguments = lines_of(d2b::test::Bytes(data, size).rest());
    try {
        const d2b::Request request = d2b::parse_command_line(arguments);
        const d2b::ToolOptions& tool = request.tool;
        if (tool.prints_text())
            return 0;
        const d2b::Options& options = request.options;
        demand(!options.read.source.empty(), "the source is named");
        demand(options.write.destination.empty() != tool.sweep.empty(), "a sweep alone has no destination");
        demand(options.read.source != options.write.destination, "the source is not the destination");
        demand(options.filter.noise_factor >= 0, "a factor is not negative");
        demand(!(options.write.overwrite && options.write.append),
               "overwriting and appending exclude each other");
        demand(options.run.threads >= 0, "threads are not negative");
    } catch (const d2b::OptionError& error) {
        demand(!std::string(error.what()).empty(), "an error says something");
    }
    return 0;
}
