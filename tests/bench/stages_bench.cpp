// Times each stage alone, on a synthetic city; takes the options of Google Benchmark. Items are points.
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "city_file.hpp"
#include "dem2buildings/open_sources.hpp"
#include "read/gdal_setup.hpp"
#include "stages.hpp"

namespace d2b::bench {
namespace {

#if defined(NDEBUG) && defined(__OPTIMIZE__)
constexpr bool optimised = true;
#else
constexpr bool optimised = false;
#endif

int run_all(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    reading::start_gdal();
    write_city(city_path, {}, 2);
    register_stages();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace d2b::bench

int main(int argc, char** argv) {
    if (!d2b::bench::optimised) {
        std::cerr << "stages_bench: this is a debug build, whose times say nothing; build with "
                     "-D CMAKE_BUILD_TYPE=Release.\n";
        return EXIT_FAILURE;
    }
    try {
        return d2b::bench::run_all(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "stages_bench: " << error.what() << '\n';
        return EXIT_FAILURE;
    }
}
