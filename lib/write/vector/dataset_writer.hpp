#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dem2buildings/options.hpp"
#include "dem2buildings/sinks.hpp"
#include "read/gdal_handles.hpp"
#include "write/geopackage/dependent_objects.hpp"
#include "write/sql.hpp"
#include "write/vector/layer_writer.hpp"

namespace d2b::writing {

/// Writes layers into one OGR dataset, new or existing.
///
/// A new dataset is written in batches of features, an existing database in one transaction: unless close()
/// is called, it is rolled back and the database is unchanged. Layers of an existing database are locked
/// against other writers from begin() on. Files that must appear whole or not at all are staged by the caller
/// (see StagingFolder), because few formats have transactions.
class DatasetWriter {
  public:
    enum class Mode {
        create,   ///< creates a new dataset
        replace,  ///< replaces layers of the same names in an existing database, in a transaction
        extend,   ///< appends features to layers of the same names in an existing dataset
    };

    DatasetWriter(WriteTarget target, const VectorFormat& format, const WriteOptions& options);
    DatasetWriter(const DatasetWriter&) = delete;
    DatasetWriter& operator=(const DatasetWriter&) = delete;
    ~DatasetWriter();

    /// @param path file or connection that the driver opens or creates @throws OutputError
    void begin(const std::string& path, Mode mode, std::span<const LayerSpec> specs,
               const Provenance& provenance);
    /// @throws OutputError
    void add(std::size_t layer, const Feature& feature);
    /// Writes pending features and tables. If a database is changed in place, its layers are then complete
    /// and counted, but invisible to others until close(). @throws OutputError
    void complete();
    /// Calls complete() if necessary, commits and closes. @throws OutputError, also if only closing fails
    void close();
    /// True if a database is changed in place, in a transaction.
    [[nodiscard]] bool changes_in_place() const { return in_transaction_ && mode_ != Mode::create; }

    /// Returns the first free feature id; valid after begin().
    [[nodiscard]] std::int64_t first_id() const { return first_id_; }
    /// Returns the column names of the driver, one per field of the layer; empty for a layer that is not
    /// created yet.
    [[nodiscard]] std::vector<std::string> columns(std::size_t layer) const {
        return layer < layers_.size() ? layers_[layer].columns() : std::vector<std::string>();
    }
    /// Returns name and number of features per written layer; valid after close().
    [[nodiscard]] const LayerCounts& counts() const { return counts_; }

  private:
    void open(const std::string& path, Mode mode);
    /// Opens the dataset and waits until no other program writes to the layers.
    void open_locked(const std::string& path, Mode mode);
    void create_tables();
    void defer_indices();
    void start_transaction();
    void commit();
    /// @throws OutputError if SQLite has rolled back the transaction
    void require_transaction() const;
    /// Records the objects of users that depend on the layers, then deletes the layers.
    void remove_layers();
    void remove_layer(const std::string& name);
    void open_layer(const LayerSpec& spec);
    void describe(GDALMajorObjectH object);
    void write_pending();
    /// Adds styles, metadata and indices to new layers.
    void add_layer_tables();

    WriteTarget target_;
    const VectorFormat& format_;
    const WriteOptions& options_;
    std::optional<CPLConfigOptionSetter> no_id_field_;
    Mode mode_ = Mode::create;
    std::string path_;
    CommitGuard guard_;  ///< declared before the dataset, because it must outlive it
    reading::DatasetOwner dataset_;
    reading::CrsOwner srs_;
    Provenance provenance_;
    std::vector<LayerSpec> specs_;
    std::optional<DependentObjects> dependents_;
    std::vector<LayerWriter> layers_;            ///< first layers of specs_, or all
    std::vector<std::vector<Feature>> pending_;  ///< features of layers that are not created yet
    bool transactions_ = false;
    bool in_transaction_ = false;
    bool complete_ = false;
    std::int64_t uncommitted_ = 0;
    std::int64_t first_id_ = 1;
    LayerCounts counts_;
};

}  // namespace d2b::writing
