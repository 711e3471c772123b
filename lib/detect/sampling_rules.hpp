#pragma once

#include <vector>

#include "detect/slope_sampling.hpp"

namespace d2b::detect {

/// Rules about sparse points and coarse cells. Each is a function of the share of cells without a pulse and
/// of the cell size, so that no other file defines sparseness.
///
/// `filled` is the share of cells without a pulse (SurfaceQuality), from which the points per cell follow as
/// -ln(filled); `side` is the cell size in m.

/// Weight of the evidence for sparse points in classify(): 0 for usual points, 1 for sparse ones.
[[nodiscard]] double sparseness(double filled);

/// True if points are sparse: classify() then uses the evidence for sparse points alone.
[[nodiscard]] bool has_sparse_points(double filled);

/// Share of cells above which points are sparse.
[[nodiscard]] double sparse_share();

/// True if points are so sparse that houses are too rough for the usual limits of smoothness: the widest
/// limits find more of them, and no share of buildings can be estimated.
[[nodiscard]] bool has_very_sparse_points(double filled);

/// True if cells hold the highest of many points, which may lie anywhere in them.
[[nodiscard]] bool is_coarse(double side);

/// True if points are so sparse, or cells so coarse, that no single limit of smoothness suits all houses.
[[nodiscard]] bool needs_multi_threshold(double side, double filled);

/// Metres added to the limits of smoothness, because the height of a cell without a pulse is wrong by a part
/// of the cell on a slope.
[[nodiscard]] double sampling_margin(double side, double filled);

/// True if points are so far apart that sloping roofs look rough: stricter limits then lose houses, and the
/// few roofs that are beyond doubt do not show it.
[[nodiscard]] bool has_sparse_slopes(const SlopeSampling& slopes);

/// Factors on the limits of smoothness that are worth a trial, in falling order. Roofs on coarse cells are a
/// few cells wide and bend in most of them, so limits that are hardly stricter lose small houses, which
/// certain roofs do not show.
[[nodiscard]] std::vector<double> stricter_scales(double side, double filled);

/// Share of the cells of all objects that stricter limits have to take away for each share of roofs that they
/// lose. It is less for very sparse points, because the widest limits find a part of these roofs again.
[[nodiscard]] double price_of_lost_roofs(double filled);

}  // namespace d2b::detect
