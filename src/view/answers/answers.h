// The data that a page shows besides pictures: figures, controls, drawings, plots, files. Floor 5.
#pragma once
#include "view/answers/library.h"
#include "view/painting/panels.h"
#include "view/server/messages.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace lfdsim::view {

using Json = nlohmann::ordered_json;

/// Returns the message "problems" for the state with this number.
Json problems_message(std::int64_t id, const std::vector<Problem>&);

/// Returns the message "resolved" or, for a display that is not valid, "problems": docs/view-protocol.md.
Json resolved(const Library&, const Wanted&);

/// Returns the message "answer". It takes milliseconds, except for plots, which may take seconds and stop when `cancelled` returns
/// true. Errors are reported in the answer's "problems"; it does not throw InputError.
Json answer(const Library&, Panels&, const Wanted&, const Ask&, const std::function<bool()>& cancelled);

}  // namespace lfdsim::view
