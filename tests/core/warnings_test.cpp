#include "core/warnings.hpp"

#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace d2b {
namespace {

using Texts = std::vector<std::string>;

TEST(Warnings, AreToldAtOnceUntilTheyAreHeld) {
    Texts heard;
    Warnings warnings([&](const std::string& text) { heard.push_back(text); });
    warnings.add("opening");
    EXPECT_EQ(heard, Texts{"opening"});
    EXPECT_EQ(warnings.take(), Texts{});
    warnings.hold();
    warnings.add("opening");  // has been said
    warnings.add("reading");
    EXPECT_EQ(heard, Texts{"opening"});
    EXPECT_EQ(warnings.take(), Texts{"reading"});
    warnings.add("reading");
    EXPECT_EQ(warnings.take(), Texts{});
}

TEST(Warnings, OneOfAFloodOfQuotesSaysThatMoreAreLeftOut) {
    Texts heard;
    Warnings warnings([&](const std::string& text) { heard.push_back(text); });
    for (int i = 0; i < 30; ++i) {
        warnings.add_library_message("GDAL", "block " + std::to_string(i));
        warnings.add_library_message("GDAL", "block 3");
    }
    ASSERT_EQ(heard.size(), 21U);
    EXPECT_EQ(heard[0], "GDAL: block 0.");
    EXPECT_EQ(heard[20], "GDAL: further warnings are left out.");
    warnings.add("of our own");
    warnings.add_library_message("PROJ", "no grid");
    EXPECT_EQ(heard.size(), 23U);
}

TEST(Warnings, MayComeFromManyThreads) {
    Warnings warnings;
    warnings.hold();
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread)
        threads.emplace_back([&warnings] {
            for (int i = 0; i < 100; ++i)
                warnings.add(std::to_string(i));
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(warnings.take().size(), 100U);
}

}  // namespace
}  // namespace d2b
