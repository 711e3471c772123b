// Runs the whole job once and prints the work of each thread with its times: see run.py --trace.
#include <chrono>
#include <cstdlib>
#include <cxxabi.h>
#include <exception>
#include <iostream>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/options.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view usage =
    "Usage: timeline [-preset <preset>] [-threads <n>] [-keep <MiB of elevations>] <dem> <destination>\n"
    "Prints a line for each stretch of work: the thread, its begin and end in microseconds, what was called; "
    "and\n"
    "a line for the whole run, whose thread is `run`.\n";

std::string demangled(const std::type_info& type) {
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> name(
        abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), &std::free);
    return status == 0 ? name.get() : type.name();
}

/// The stretches of all threads.
class Timeline {
  public:
    void add(const WorkSpan& span) {
        const std::lock_guard lock(mutex_);
        spans_.push_back(span);
    }
    void print(Clock::time_point begin, Clock::time_point end) const {
        const auto microseconds = [&](Clock::time_point at) {
            return std::chrono::duration_cast<std::chrono::microseconds>(at - begin).count();
        };
        std::cout << "run\t0\t" << microseconds(end) << "\trun\n";
        for (const WorkSpan& span : spans_)
            std::cout << span.thread << '\t' << microseconds(span.begin) << '\t' << microseconds(span.end)
                      << '\t' << demangled(*span.work) << '\n';
    }

  private:
    std::mutex mutex_;
    std::vector<WorkSpan> spans_;
};

bool parse(std::span<char* const> words, Options& options, BandSize& size) {
    std::vector<std::string> places;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string word = words[i];
        if (!word.starts_with('-'))
            places.push_back(word);
        else if (++i == words.size())
            return false;
        else if (word == "-keep")
            size.keep_bytes = std::strtoull(words[i], nullptr, 10) << 20;
        else
            set_option(options, word.substr(1), {words[i]});
    }
    if (places.size() != 2)
        return false;
    options.read.source = places[0];
    options.write.destination = places[1];
    options.write.overwrite = true;
    return true;
}

int run_once(std::span<char* const> words) {
    Options options;
    BandSize size;
    if (!parse(words, options, size)) {
        std::cerr << usage;
        return 2;
    }
    Timeline timeline;
    Callbacks callbacks;
    callbacks.make_spool = [] { return std::make_unique<FileSpool>(); };
    callbacks.on_work = [&](const WorkSpan& span) { timeline.add(span); };
    const Clock::time_point begin = Clock::now();
    reading::start_gdal();
    const Inputs inputs = open_inputs(options, callbacks);
    const auto sink = open_sink(options.write, callbacks);
    run(options, inputs.sources(), {*sink}, callbacks, size);
    timeline.print(begin, Clock::now());
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace d2b::bench

int main(int argc, char** argv) {
    try {
        return d2b::bench::run_once({argv, static_cast<std::size_t>(argc)});
    } catch (const std::exception& error) {
        std::cerr << "timeline: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
