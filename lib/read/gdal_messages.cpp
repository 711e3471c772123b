#include "read/gdal_messages.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <cpl_error.h>

#include "read/fetch_gate.hpp"

namespace d2b::reading {

namespace {

constexpr std::size_t longest_message = 500;
constexpr std::size_t max_warnings = 20;  // limited because a damaged file can have one per block

void CPL_STDCALL collect(CPLErr level, CPLErrorNum, const char* text) {
    auto* messages = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (messages == nullptr || level < CE_Warning)
        return;
    try {
        messages->add(level != CE_Warning, text);
    } catch (...) {  // out of memory; exceptions must not pass through GDAL's C frames
        return;
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    if (!from.empty())
        for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    return text;
}

void add_distinct(std::vector<std::string>& list, const std::string& line) {
    if (list.size() <= max_warnings && std::find(list.begin(), list.end(), line) == list.end())
        list.push_back(line);
}

void pass(const std::vector<std::string>& lines, Warnings& warnings) {
    for (const std::string& line : lines)
        warnings.add_library_message("GDAL", line);
}

}  // namespace

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool blank = static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
        if (!blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    if (line.size() > longest_message) {
        std::size_t end = longest_message;
        while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U)
            --end;  // keeps UTF-8 characters whole
        return line.substr(0, end) + "...";
    }
    while (!line.empty() && (line.back() == ' ' || line.back() == '.'))
        line.pop_back();
    return line;
}

GdalMessages::GdalMessages(std::string hidden, std::string shown)
    : hidden_(hidden == shown ? "" : std::move(hidden)), shown_(std::move(shown)) {
    CPLPushErrorHandlerEx(collect, this);
    CPLSetCurrentErrorHandlerCatchDebug(FALSE);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
}

void GdalMessages::add(bool is_error, const char* text) {
    const std::string line = one_line(replaced(text == nullptr ? "" : text, hidden_, shown_));
    if (is_error) {
        last_error_ = line.empty() ? "unknown error" : line;
        if (first_error_.empty())
            first_error_ = last_error_;
    }
    if (!line.empty())
        add_distinct(is_error ? errors_ : warnings_, line);
}

std::string GdalMessages::reason() const {
    return failed() ? last_error_ : "GDAL gives no reason";
}

std::string GdalMessages::first_reason() const {
    return failed() ? first_error_ : reason();
}

std::string GdalMessages::reason_for(const std::string& path) const {
    if (std::string missing = missing_file_system(path); !missing.empty())
        return missing;
    const std::string text = reason();
    const std::string name = one_line(path) + ": ";
    return text.starts_with(name) ? text.substr(name.size()) : text;
}

void GdalMessages::pass_warnings(Warnings& warnings) const {
    pass(warnings_, warnings);
}

void GdalMessages::pass_all(Warnings& warnings) const {
    pass(warnings_, warnings);
    pass(errors_, warnings);
}

}  // namespace d2b::reading
