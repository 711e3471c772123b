#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "write/commit_guard.hpp"
#include "read/config_option.hpp"
#include "write/layer_counts.hpp"
#include "write/layer_writer.hpp"
#include "write/users_objects.hpp"

namespace d2b {

/// Writes layers into one OGR dataset, new or there already. Without close() a transaction is rolled back.
class DatasetWriter {
  public:
    enum class Mode {
        create,   ///< a new dataset
        replace,  ///< one that is there and has transactions: layers of the same names go first
        extend,   ///< one that is there: features are added to layers of the same names
    };

    DatasetWriter(WriteTarget target, const VectorFormat& format, const WriteOptions& options);
    DatasetWriter(const DatasetWriter&) = delete;
    DatasetWriter& operator=(const DatasetWriter&) = delete;
    ~DatasetWriter();

    /// @param path what the driver opens or creates @throws OutputError
    void begin(const std::string& path, Mode mode, std::span<const LayerSpec> specs,
               const Provenance& provenance);
    /// @throws OutputError
    void add(std::size_t layer, const Feature& feature);
    /// Writes what is pending. The layers of a transaction that changes a database in place are complete and
    /// counted then, and nobody sees them before close(). @throws OutputError
    void complete();
    /// Completes it where it is not, commits and closes. @throws OutputError: also where only closing fails
    void close();
    /// Whether it changes a database in place, in a transaction.
    [[nodiscard]] bool changes_in_place() const { return in_transaction_ && mode_ != Mode::create; }

    /// The first number that a feature may take; known when begin() has been called.
    [[nodiscard]] std::int64_t first_id() const { return first_id_; }
    /// Of each field of a layer, as the driver calls it; none of a layer that waits for those before it.
    [[nodiscard]] std::vector<std::string> columns(std::size_t layer) const {
        return layer < layers_.size() ? layers_[layer].columns() : std::vector<std::string>();
    }
    /// Name and number of features of each layer that was written; known when close() has been called.
    [[nodiscard]] const LayerCounts& counts() const { return counts_; }

  private:
    void open(const std::string& path, Mode mode);
    /// Opens it and waits until nobody else writes to the layers.
    void open_in_turn(const std::string& path, Mode mode);
    void make_tables();
    void put_indices_off();
    void start_transaction();
    void commit();
    /// @throws OutputError where SQLite has ended it by itself
    void require_transaction() const;
    /// Notes what of the user's hangs on the layers, and removes them.
    void remove_layers();
    void remove_layer(const std::string& name);
    void open_layer(const LayerSpec& spec);
    void describe(GDALMajorObjectH object);
    void write_pending();
    /// What tells other programs how to show the new layers, and what is in them.
    void furnish();

    WriteTarget target_;
    const VectorFormat& format_;
    const WriteOptions& options_;
    std::optional<ConfigOption> no_id_field_;
    Mode mode_ = Mode::create;
    std::string path_;
    CommitGuard guard_;  ///< goes after the dataset
    DatasetOwner dataset_;
    CrsOwner srs_;
    Provenance provenance_;
    std::vector<LayerSpec> specs_;
    std::optional<UsersObjects> users_;
    std::vector<LayerWriter> layers_;            ///< the first ones of specs_, or all
    std::vector<std::vector<Feature>> pending_;  ///< of layers that must wait for those before them
    bool transactions_ = false;
    bool in_transaction_ = false;
    bool complete_ = false;
    std::int64_t uncommitted_ = 0;
    std::int64_t first_id_ = 1;
    LayerCounts counts_;
};

}  // namespace d2b
