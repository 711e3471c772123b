#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "compare/change_layer.hpp"
#include "dem2buildings/help.hpp"
#include "features/attribute_table.hpp"

namespace d2b {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file.is_open()) << path;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

// These pages are written by tests/docs/write_generated; a difference means that it was not run.
TEST(GeneratedDocs, SchemaIsThatOfTheAttributeTable) {
    EXPECT_NE(text_of(D2B_DOCS "/reference/output.md").find(features::schema_markdown()), std::string::npos);
}

TEST(GeneratedDocs, FieldsOfChangesAreThoseOfTheLayer) {
    EXPECT_NE(
        text_of(D2B_DOCS "/reference/compare.md").find(features::schema_table(compare::change_fields())),
        std::string::npos);
}

TEST(GeneratedDocs, OptionsAreThoseOfTheOptionTable) {
    EXPECT_EQ(text_of(D2B_DOCS "/reference/options.md"), options_markdown());
}

}  // namespace
}  // namespace d2b
