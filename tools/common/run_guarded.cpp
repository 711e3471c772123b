#include "common/run_guarded.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <stdexcept>
#include <unistd.h>

#include "common/exit_codes.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_setup.hpp"
#include "write/standard_output.hpp"

namespace d2b {
namespace {

/// Files that are opened later would take the numbers of streams that are closed, and what is printed would
/// end up in them. What is read from or written to what stands in for a stream fails.
void fill_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

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
    fill_closed_streams();
    // At a limit of the size of files writing then fails, with a message, and cleans up.
    static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
    const std::string no_memory = "There is not enough memory; " + tool.memory_advice + ".";
    try {
        const int status = run({argv + std::min(argc, 1), argv + argc}, tool);
        // What cannot be written, a report say, must not look as if it had been.
        // The second condition holds where GDAL could not write to /vsistdout/, of which it says nothing.
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
