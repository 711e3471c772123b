#include "view/cairo.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "support/error_of.hpp"

namespace d2b::test {
namespace {

std::string refusal(const char* library, const char* function) {
    return error_of<OutputError>([&] { static_cast<void>(view::load_symbol(library, function)); });
}

TEST(LazySymbol, CallsAFunctionOfALibrary) {
    const auto cosine = reinterpret_cast<double (*)(double)>(view::load_symbol("libm.so.6", "cos"));
    EXPECT_EQ(cosine(0), 1);
}

TEST(LazySymbol, SaysWhatIsMissingAndWhatToInstall) {
    for (const auto& [library, function] :
         {std::pair("libof_nobody.so.7", "draw"), std::pair("libm.so.6", "draw_by_nobody")}) {
        const std::string said = refusal(library, function);
        EXPECT_NE(said.find(library), std::string::npos) << said;
        EXPECT_NE(said.find("install Pango 1.50"), std::string::npos) << said;
        EXPECT_NE(said.find("or leave -preview out."), std::string::npos) << said;
    }
    EXPECT_NE(refusal("libm.so.6", "draw_by_nobody").find("draw_by_nobody"), std::string::npos);
}

}  // namespace
}  // namespace d2b::test
