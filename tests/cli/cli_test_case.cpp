#include "cli/cli_test_case.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <stdlib.h>

namespace d2b::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

/// Every file under a folder with its bytes; folders with "/".
std::map<std::string, std::string> contents_of(const fs::path& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        contents[entry.path().string()] = entry.is_regular_file() ? read_bytes(entry.path().string()) : "/";
    return contents;
}

}  // namespace

void fill(RasterSpec& spec, int row, int last_row, int col, int last_col, double z) {
    for (int r = row; r <= last_row; ++r)
        for (int c = col; c <= last_col; ++c)
            spec.values[static_cast<std::size_t>(r * spec.cols + c)] = z;
}

void CliTest::SetUpTestSuite() {
    GDALAllRegister();
}

void CliTest::SetUp() {
    std::string pattern = (fs::temp_directory_path() / "d2b_cli_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
}

void CliTest::TearDown() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::vector<std::string> CliTest::entries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
        names.push_back(fs::relative(entry.path(), folder_).string());
    std::sort(names.begin(), names.end());
    return names;
}

ToolResult CliTest::run(const Arguments& arguments, ToolSetup setup) const {
    if (setup.working_directory.empty())
        setup.working_directory = folder_.string();
    Arguments command{D2B_TOOL};
    const bool names_preset = std::ranges::any_of(
        arguments, [](const std::string& argument) { return argument.starts_with("-preset"); });
    if (!preset_.empty() && !names_preset && !arguments.empty())
        command.insert(command.end(), {"-preset", preset_});
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_tool(command, setup);
}

std::string CliTest::run_well(const Arguments& arguments, const ToolSetup& setup) const {
    const ToolResult result = run(arguments, setup);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    return result.out;
}

std::string CliTest::run_warned(const Arguments& arguments, const std::vector<std::string>& parts) const {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.status, 0);
    const std::vector<std::string> lines = lines_of(result.err);
    EXPECT_EQ(lines.size(), parts.size()) << result.err;
    for (std::size_t i = 0; i < std::min(lines.size(), parts.size()); ++i) {
        EXPECT_TRUE(lines[i].starts_with("Warning: ")) << lines[i];
        expect_has(lines[i], parts[i]);
    }
    return result.out;
}

void CliTest::expect_error(int status, const std::string& part, const Arguments& arguments,
                           const ToolSetup& setup, int warnings) const {
    std::string command;
    for (const std::string& argument : arguments)
        command += argument + " ";
    SCOPED_TRACE(command);
    const auto before = contents_of(folder_);
    const ToolResult result = run(arguments, setup);
    EXPECT_EQ(result.status, status);
    const std::vector<std::string> lines = lines_of(result.err);
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(warnings) + 1) << result.err;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        EXPECT_TRUE(lines[i].starts_with("Warning: ")) << lines[i];
    const std::string& error = lines.back();
    EXPECT_TRUE(error.starts_with("ERROR: ")) << error;
    EXPECT_TRUE(error.ends_with('.') || error.ends_with('?')) << error;
    expect_has(error, part);
    EXPECT_TRUE(std::regex_match(result.out, std::regex("([0-9]+|\\.)*\n?"))) << result.out;
    EXPECT_EQ(contents_of(folder_), before);
}

Layer CliTest::layer(const std::string& file, const std::string& name) const {
    return read_layer(path(file), name);
}

std::string sample(const std::string& name) {
    return std::string(D2B_SAMPLES) + "/" + name;
}

RasterSpec blocks() {
    RasterSpec spec;
    spec.cols = 30;
    spec.rows = 20;
    spec.type = GDT_Float32;
    spec.values.assign(600, 0.0);
    spec.transform = std::array<double, 6>{391000, 1, 0, 5820000, 0, -1};
    spec.crs = "EPSG:25833";
    fill(spec, 3, 10, 3, 12, 10);
    fill(spec, 5, 8, 5, 9, 20);
    fill(spec, 5, 7, 18, 21, 6);
    fill(spec, 10, 11, 25, 26, 8);
    return spec;
}

std::string missing_shared(const std::string& file) {
    return "the real DEM " + file + " is not here";
}

}  // namespace d2b::test
