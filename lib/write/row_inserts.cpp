#include "write/row_inserts.hpp"

#include <string_view>
#include <utility>

#include "dem2buildings/error.hpp"
#include "write/sql.hpp"

namespace d2b {
namespace {

using Bytes = std::span<const std::byte>;

void append_hex(std::string& text, Bytes bytes) {
    static constexpr std::string_view digits = "0123456789ABCDEF";
    constexpr unsigned nibble = 4;
    constexpr unsigned low = 15;
    for (const std::byte byte : bytes) {
        text += digits[std::to_integer<unsigned>(byte) >> nibble];
        text += digits[std::to_integer<unsigned>(byte) & low];
    }
}

}  // namespace

RowInserts::RowInserts(GDALDatasetH dataset, sqlite3* handle, const WriteTarget& target, std::string head,
                       std::string doing)
    : dataset_(dataset), handle_(handle), target_(target), head_(std::move(head)), doing_(std::move(doing)) {}

void RowInserts::fail() const {
    const std::string reason = sqlite3_errmsg(handle_);
    throw OutputError("Cannot write \"" + target_.name + "\": " + doing_ + " failed (" + reason + ")" +
                      advice_for(reason) + ".");
}

void RowInserts::add(std::initializer_list<Cell> row) {
    if (handle_ != nullptr)
        bind(row);
    else
        append(row);
}

void RowInserts::bind(std::initializer_list<Cell> row) {
    if (!statement_) {
        std::string sql = head_ + " (?";
        for (std::size_t i = 1; i < row.size(); ++i)
            sql += ",?";
        sqlite3_stmt* statement = nullptr;
        if (sqlite3_prepare_v2(handle_, (sql + ")").c_str(), -1, &statement, nullptr) != SQLITE_OK)
            fail();
        statement_.reset(statement);
    }
    int place = 0;
    for (const Cell& cell : row) {
        ++place;
        const auto* integer = std::get_if<std::int64_t>(&cell);
        const Bytes bytes = integer != nullptr ? Bytes() : std::get<Bytes>(cell);
        const int bound = integer != nullptr
                              ? sqlite3_bind_int64(statement_.get(), place, *integer)
                              : sqlite3_bind_blob64(statement_.get(), place, bytes.data(), bytes.size(),
                                                    SQLITE_STATIC);  // valid until the step below
        if (bound != SQLITE_OK)
            fail();
    }
    const bool done = sqlite3_step(statement_.get()) == SQLITE_DONE;
    if (sqlite3_reset(statement_.get()) != SQLITE_OK || !done)
        fail();
}

void RowInserts::append(std::initializer_list<Cell> row) {
    constexpr std::size_t most = 1 << 16;
    sql_ += sql_.empty() ? head_ + " (" : ",(";
    bool first = true;
    for (const Cell& cell : row) {
        sql_ += std::exchange(first, false) ? "" : ",";
        if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
            sql_ += std::to_string(*integer);
        } else {
            sql_ += "X'";
            append_hex(sql_, std::get<Bytes>(cell));
            sql_ += "'";
        }
    }
    sql_ += ")";
    if (sql_.size() > most)
        finish();
}

void RowInserts::finish() {
    statement_.reset();
    if (sql_.empty())
        return;
    OgrCall call(target_);
    call.check(sql_done(dataset_, std::exchange(sql_, {})), doing_);
}

}  // namespace d2b
