#include "common/run_guarded.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "common/exit_codes.hpp"
#include "core/system/process.hpp"
#include "core/system/streams.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_setup.hpp"
#include "write/standard_output.hpp"

namespace d2b {
namespace {

int run(const std::vector<std::string>& arguments, const Tool& tool) {
    if (arguments.empty()) {
        std::cerr << tool.short_usage();
        return exit_code::wrong_usage;
    }
    const auto left = reading::apply_gdal_switches(arguments);
    return left ? tool.run(*left) : exit_code::done;
}

}  // namespace

void print_line(const char* kind, std::string text) {
    std::ranges::replace_if(
        text, [](char letter) { return static_cast<unsigned char>(letter) < ' '; }, ' ');
    std::cerr << kind << text << '\n';
}

int run_guarded(int argc, const char* const* argv, const Tool& tool) {
    system::prepare_streams();
    // Writing then fails with a message, and cleans up.
    system::ignore_file_size_signal();
    const std::string no_memory = "There is not enough memory; " + tool.memory_advice + ".";
    try {
        const int status = run(system::arguments(argc, argv), tool);
        // Checks the output, because a lost one, such as a report, must not look as if it had been written.
        // The second condition holds if GDAL could not write to /vsistdout/, because it does not report that.
        if (!std::cout.flush() || std::ferror(stdout) != 0)
            writing::throw_stdout_failure();
        return status;
    } catch (const OptionError& error) {
        print_line("ERROR: ", error.what());
        return exit_code::wrong_usage;
    } catch (const std::bad_alloc&) {
        print_line("ERROR: ", no_memory);
    } catch (const std::length_error&) {  // more than a vector can ever hold
        print_line("ERROR: ", no_memory);
    } catch (const std::exception& error) {
        print_line("ERROR: ", error.what());
    }
    return exit_code::failed;
}

}  // namespace d2b
