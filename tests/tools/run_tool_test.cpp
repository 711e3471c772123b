#include "support/run_tool.hpp"

#include <gtest/gtest.h>

namespace d2b::test {
namespace {

TEST(RunTool, capturesBothStreamsAndTheStatus) {
    const ToolResult result = run_tool({"sh", "-c", "echo out; echo err >&2; exit 3"});
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(result.out, "out\n");
    EXPECT_EQ(result.err, "err\n");
}

TEST(RunTool, passesArgumentsWithoutAShell) {
    EXPECT_EQ(run_tool({"printf", "%s|", "a b", "$HOME", "*", ""}).out, "a b|$HOME|*||");
}

TEST(RunTool, feedsStdin) {
    const std::string text(300000, 'x');  // more than a pipe holds
    EXPECT_EQ(run_tool({"cat"}, {.stdin_text = text}).out, text);
    EXPECT_EQ(run_tool({"cat"}).out, "");
}

TEST(RunTool, setsEnvironmentAndFolder) {
    const ToolResult result = run_tool({"sh", "-c", "echo $D2B_TEST; pwd; echo ${PATH:+path}"},
                                       {.environment = {"D2B_TEST=value"}, .working_directory = "/"});
    EXPECT_EQ(result.out, "value\n/\npath\n");
    EXPECT_EQ(run_tool({"sh", "-c", "echo $HOME"}, {.environment = {"HOME=/elsewhere"}}).out, "/elsewhere\n");
}

TEST(RunTool, sendsStdoutElsewhere) {
    const ToolResult result = run_tool({"sh", "-c", "echo lost"}, {.stdout_file = "/dev/null"});
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.status, 0);
}

TEST(RunTool, sendsSignals) {
    const Kill soon{.signal = SIGTERM, .after = std::chrono::milliseconds(50)};
    EXPECT_EQ(run_tool({"sleep", "60"}, {.kill = soon}).status, 128 + SIGTERM);
}

TEST(RunTool, saysWhatCannotBeStarted) {
    EXPECT_THROW((void)run_tool({"/nonexistent/program"}), std::runtime_error);
}

}  // namespace
}  // namespace d2b::test
