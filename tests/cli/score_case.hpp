#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cli/cli_test_case.hpp"
#include "core/text.hpp"
#include "support/vector_file.hpp"

namespace d2b::test {

/// Runs dem2buildings_score in an empty folder of its own.
class ScoreCase : public CliTest {
  protected:
    static std::string box(double left, double low, double right, double high) {
        const auto x0 = number_text(left);
        const auto y0 = number_text(low);
        const auto x1 = number_text(right);
        const auto y1 = number_text(high);
        return "POLYGON((" + x0 + " " + y0 + "," + x1 + " " + y0 + "," + x1 + " " + y1 + "," + x0 + " " + y1 +
               "," + x0 + " " + y0 + "))";
    }

    [[nodiscard]] ToolResult score(const Arguments& arguments) const {
        Arguments command{D2B_SCORE_TOOL};
        command.insert(command.end(), arguments.begin(), arguments.end());
        ToolSetup setup;
        setup.working_directory = folder_.string();
        return run_tool(command, setup);
    }
    /// @param warnings each a whole line
    nlohmann::json score_json(Arguments arguments, const std::string& warnings = "") const {
        arguments.emplace_back("-json");
        const ToolResult result = score(arguments);
        EXPECT_EQ(result.status, 0);
        EXPECT_EQ(result.err, warnings);
        return nlohmann::json::parse(result.out);
    }
    void expect_refused(int status, const std::string& message, const Arguments& arguments) const {
        const ToolResult result = score(arguments);
        EXPECT_EQ(result.status, status);
        EXPECT_EQ(result.err, "ERROR: " + message + "\n");
        EXPECT_EQ(result.out, "");
    }
    void layer_of(const std::string& file, const VectorLayer& layer) const { write_layer(path(file), layer); }
};

}  // namespace d2b::test
