// The data that a page shows besides pictures: figures, controls, drawings, plots, files. Floor 5.
#pragma once
#include "view/answers/library.h"
#include "view/painting/panels.h"
#include "view/server/messages.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace lfdsim::view {

using Json = nlohmann::ordered_json;

/// The message "resolved" or, for a display that is not valid, "problems": docs/view-protocol.md.
Json resolved(const Library&, const Wanted&);

/// The message "answer". Takes milliseconds, except for plots, which may take seconds and stop when `cancelled` returns true.
/// Errors in the question are reported in the answer's "problems"; never throws InputError.
Json answer(const Library&, Panels&, const Wanted&, const Ask&, const std::function<bool()>& cancelled);

}  // namespace lfdsim::view
