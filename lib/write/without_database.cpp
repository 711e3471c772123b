#include "write/without_database.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include <cpl_string.h>

namespace d2b {

namespace {

struct Name {
    std::string text;     ///< without quotes
    std::size_t end = 0;  ///< end in the statement; the begin if there is none
};

bool is_bare(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$' ||
           static_cast<unsigned char>(c) >= 128;
}

/// Returns the name, number or text at a position; quoted text is one token.
Name name_at(const std::string& sql, std::size_t at) {
    if (at >= sql.size())
        return {"", at};
    const char open = sql[at];
    if (open == '"' || open == '`' || open == '\'' || open == '[') {
        const char close = open == '[' ? ']' : open;
        Name name{"", at + 1};
        for (; name.end < sql.size(); ++name.end) {
            if (sql[name.end] == close && (open == '[' || sql[name.end + 1] != close))
                break;
            if (sql[name.end] == close)
                ++name.end;
            name.text += sql[name.end];
        }
        name.end = std::min(name.end + 1, sql.size());
        return name;
    }
    Name name{"", at};
    while (name.end < sql.size() && is_bare(sql[name.end]))
        name.text += sql[name.end++];
    return name;
}

std::size_t after_spaces(const std::string& sql, std::size_t at) {
    while (at < sql.size() && std::isspace(static_cast<unsigned char>(sql[at])) != 0)
        ++at;
    return at;
}

}  // namespace

std::string without_database(const std::string& sql, std::span<const std::string> tables) {
    std::string bare;
    for (std::size_t at = 0; at < sql.size();) {
        const Name name = name_at(sql, at);
        const std::size_t dot = after_spaces(sql, name.end);
        if (EQUAL(name.text.c_str(), "main") && dot < sql.size() && sql[dot] == '.') {
            const std::size_t next = after_spaces(sql, dot + 1);
            const std::string table = name_at(sql, next).text;
            if (std::any_of(tables.begin(), tables.end(),
                            [&](const std::string& each) { return EQUAL(each.c_str(), table.c_str()); })) {
                at = next;
                continue;
            }
        }
        const std::size_t end = std::max(name.end, at + 1);
        bare.append(sql, at, end - at);
        at = end;
    }
    return bare;
}

}  // namespace d2b
