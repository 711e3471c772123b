// A run on a thread of its own, as programs with windows have it: it tells how far it is, and can be stopped.
//   progress_and_stop <dem> <destination> [<percent at which it is stopped>]

#include <atomic>
#include <chrono>
#include <dem2buildings/dem2buildings.hpp>
#include <exception>
#include <future>
#include <iostream>
#include <string>

namespace {

/// What the thread that runs and the one that watches share.
struct Job {
    std::atomic<double> done = 0;
    std::atomic<bool> stop = false;
};

d2b::RunReport work(const d2b::Options& options, Job& job) {
    d2b::Callbacks callbacks;
    callbacks.on_progress = [&](double share) {
        job.done = share;
        return true;
    };
    callbacks.stop = [&] { return job.stop.load(); };  // asked often, by many threads
    return d2b::extract_file(options, callbacks);
}

void watch(const d2b::Options& options, double stop_at) {
    Job job;
    std::future<d2b::RunReport> result = std::async(std::launch::async, [&] { return work(options, job); });
    do
        job.stop = job.stop || job.done * 100 >= stop_at;
    while (result.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready);
    std::cout << result.get().buildings << " buildings\n";  // or throws what the run threw
}

}  // namespace

int main(int argc, char* argv[]) {
    if (argc < 3) {
        std::cerr << "usage: progress_and_stop <dem> <destination> [<percent>]\n";
        return 2;
    }
    d2b::Options options;
    options.read.source = argv[1];
    options.write.destination = argv[2];
    try {
        watch(options, argc > 3 ? std::stod(argv[3]) : 1000);
    } catch (const d2b::Cancelled& cancelled) {  // nothing is left of it, and nothing has changed
        std::cout << cancelled.what() << '\n';
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
