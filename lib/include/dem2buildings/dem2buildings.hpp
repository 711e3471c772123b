#pragma once

// All that programs see of the library.
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/extract_file.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "dem2buildings/open_sources.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/run.hpp"
#include "dem2buildings/score.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/spool.hpp"
#include "dem2buildings/surfaces.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings/wkb.hpp"
